"""Own more English phrases of everyday speech: lost things, ways to and fro, the end of a move.

Tables as in ``everyday``: over marked sentences, in their order.
"""

from __future__ import annotations

from planner.language.grammar.everyday import table
from planner.language.grammar.lexicon import MARK
from planner.language.numbers import EN_DURATION, EN_LENGTH

_PLACE = rf"(?:(?:the|a|my|our|your|this|that) )?{MARK}"
_AT = r"(?:in|at|on|by|under|behind|near|beside|next to|inside)"
_T = r"(?P<t>(?:my|our|the) [a-z]+(?: [a-z]+)?)"
_LOST = (
    r"(?:(?:(?:i|we) (?:can ?not|can't|could not|couldn't) (?:find|see)"
    r"|(?:i|we)(?:'ve| have)? (?:just )?(?:lost|mislaid|misplaced)) {t}(?: anywhere| any more"
    r"| again)?"
    r"|{t}(?:'s| is| has)? (?:just )?(?:gone|rolled|fallen|disappeared|vanished|got lost|lost"
    r"|missing"
    r"|run|bounced|hidden|hiding|slipped|went)(?: (?:off|away|missing|down|somewhere|again))*)"
).format(t="{t}")
_ASKS = r"(?:please |so |can you |could you |would you |will you |just |go (?:and )?|and )*"
_LOOKS = rf"(?:check|look|search|try|have a look|see)(?: {_AT})?"
_NEXT = rf"(?:,? and (?:then )?|,? then |, )(?:{_LOOKS} |{_AT} )?"
_HOME = r"(?:house|home|flat|apartment|place)"

LOST_THINGS = table(
    (rf"^{_LOST.replace('{t}', _T, 1).replace('{t}', _T.replace('<t>', '<t2>'))}[,.;!]+ {_ASKS}{_LOOKS} "
     rf"(?P<a>{_PLACE})(?: first)?{_NEXT}(?P<b>{_PLACE})(?: please| for me| next"
     rf"| after that)*[.!?]*$",
     r"go to \g<a> and see if \g<t>\g<t2> is there, then go to \g<b> and see if \g<t>\g<t2> is there"),
    (rf"^{_LOST.replace('{t}', _T, 1).replace('{t}', _T.replace('<t>', '<t2>'))}[,.;!]+ {_ASKS}{_LOOKS} "
     rf"(?P<a>{_PLACE})(?: first| please| for me| will you| would you)*[.!?]*$",
     r"look for \g<t>\g<t2> at \g<a>"),
)  # fmt: skip
"""A thing that is missed, and where to look: what is looked at is that thing, and not the place."""

_OF = r"(?:(?:my|the|our|your|his|her) )[a-z]+(?: [a-z]+)??"
ONE_TURN = table(
    (r"\b(?P<t>(?:spin|rotate)(?: (?:a?round|about|right round|all the way round))+) (?:just )?once"
     r"(?! (?:you|i|we|he|she|it|they|the|my|more|again|every|a|somebody|someone|there)\b)", r"\g<t>"),
    (r"\b(?P<v>tell (?:me|us)|describe) (?:everything|all) (?:that )?you (?:can )?see\b", r"\g<v> what you see"),
    (r"\bturn to face (?:the other way|the opposite (?:way|direction)|backwards)", "turn around"),
    (rf"^(?:is|are) (?P<t>{_OF}) in (?P<a>{_OF}) or (?:in )?(?P<b>{_OF})[?.!]*$",
     r"look for \g<t> in \g<a>, and if it is not there look in \g<b>"),
)  # fmt: skip
"""Once round is round, and a thing that is in one of two rooms is looked for in both."""

LOOSER = table(
    (rf"\bfor (?:exactly|precisely|about|around|roughly|another|a good) (?={EN_DURATION})", "for "),
    (r"\blook in (?:at|on) (?=(?:the|my|our) )", "check "),
    (r"\b(?P<h>go home|go (?:and )?charge|dock) and (?:have a )?(?:rest|relax|recharge)\b", r"\g<h>"),
    (r"\bwake (?:up (?P<w>(?!me\b|us\b)(?:(?:the|my|our) )?[a-z]+)|(?P<v>(?!me\b|us\b|up\b)(?:(?:the|my|our) )?[a-z]+)(?: up)?)"
     r"(?=[.!]*$|,| and\b)", r"tell \g<w>\g<v> to wake up"),
    (r"(?P<f>\b(?:follow|come along with|come with) (?:me|us|him|her|them)\b[^,.;]*?),? (?:and |but )?(?:keep|stay)"
     r" (?:close|near|nearby|right behind|up|with me)(?: (?:to|behind)(?: me"
     r"| us)?)?(?=[.!]*$)", r"\g<f>"),
    (r"\bcome (?:here )?(?:and )?(?=tell (?:me|us) (?:what|how) (?:he|she|they)\b)", "come back and "),
    (rf"\b(?:go|drive|run|walk|shuttle|roll|move|travel)(?: (?:back and forth|to and fro|up and down))?"
     rf" between (?P<a>{_PLACE}) and (?P<b>{_PLACE}) (?P<n>twice|\w+ times)",
     r"go to \g<a> then go to \g<b>, \g<n>"),
    (rf"\b(?:do|make|drive|run) (?P<n>two|three|four|five|six|seven|eight|nine|ten|\d{{1,2}})"
     rf" (?:laps|trips|rounds|runs|times) between (?P<a>{_PLACE}) and (?P<b>{_PLACE})",
     r"go to \g<a> then go to \g<b>, \g<n> times"),
    (r"\bgo (?:back )?home (?:and|to|for a) (?:re)?charge\b", "go charge"),
    (rf"(?P<m>\b(?:go|move|drive|roll|come|back up|reverse)\b[^,.;]*?{EN_LENGTH.replace('?P<length>', '?:').replace('?P<unit>', '?:')}"
     r"(?: (?:forwards?|backwards?|back|ahead))?),? (?:and |then )+(?:stop|halt"
     r"|stay)(?: there)?(?=[.!]*$)", r"\g<m>"),
    (r"^(?:just |take )*(?:a|one) (?:small |little |tiny )?step (?P<d>back|backwards?|forwards?)(?=$|[,.])",
     r"move \g<d> 20 cm"),
    (rf"\b(?:go|move|come|drive|get) (?:a (?:bit|little|touch) )?(?:closer|nearer) to (?P<p>{_PLACE})"
     r"(?:,? and (?:stop|stay|wait)(?: there)?)?(?=$|[,.])", r"go to \g<p>"),
    (rf"\b(?:do|make|take) (?:a|one|another) (?:quick |little )*(?:lap|round|tour) (?:of|through|round) (?:the |our )?{_HOME}"
     r" (?=and (?:then )?(?:tell|let|see|look|check)\b)", "patrol the house "),
)  # fmt: skip
