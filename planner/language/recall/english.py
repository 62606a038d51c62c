"""Own the English questions about before. Whole sentences, never a part of one.

Matched against normalised words whose place names are marks, without courtesy, time and question
mark; ``what`` is a thing, a person or what was told of.
"""

from __future__ import annotations

import re

from planner.language.grammar.lexicon import MARK

LEAD = re.compile(
    r"(?:(?:please|hey|hi|ok|okay|robot|pons|so|well|and)[ ,]+)*"
    r"(?:(?:can|could|would|will) you (?:please )?)?"
    r"(?:(?:please )?(?:tell|remind) (?:me|us)[ ,]+(?:again )?|do you (?:happen to )?know )?"
)
REMEMBERS = re.compile(r"(?:do|can|could) you (?:still )?(?:remember|recall) |remember (?=wh)")
TAIL = re.compile(
    r"(?:[ ,]+(?:while (?:i|we)(?: was| were|'ve been| have been|'m| am) (?:out|away|asleep|gone"
    r"|sleeping|shopping|at (?:work"
    r"|school|the shops)|in (?:bed|town|the shower|here))|in the meantime|or not(?: yet)?|yet"
    r"|anywhere|somewhere|on your (?:rounds?|patrol|way|last round|tour)"
    r"|(?:the )?last time you (?:looked|were (?:in )?there)|please|(?<!just )now|thanks"
    r"|thank you|again|at all|before|previously|robot|pons))+$"
)
SPANS = (
    (
        "hour",
        (
            r"(?:with)?in the (?:last|past) (?:half )?hour|just now"
            r"|(?:an hour|a moment|a minute) ago"
        ),
    ),
    ("morning", r"(?:earlier )?this morning|all morning|the whole morning"),
    ("afternoon", r"(?:earlier )?this afternoon|in the afternoon|all afternoon"),
    ("evening", r"(?:earlier )?this evening|tonight"),
    ("night", r"last night|yesterday (?:evening|night)|during the night"),
    ("yesterday", r"(?:since )?yesterday(?: (?:morning|afternoon))?|the day before"),
    ("today", r"(?:earlier )?today|so far today|earlier(?: on)?|all day(?: long)?|the whole day"),
    ("week", r"this week|(?:in )?the (?:last|past) (?:few days|week)|lately|recently"),
)
_THE = r"(?:the |a |an |my |our |your |any |some )?"
PLACE = re.compile(
    rf"(?: (?:right |over )?(?:(?:in )?through|in|inside|into|at|on|near|to|around|by)"
    rf" {_THE}(?P<at>{MARK})(?: room)?| (?:in )?(?P<here>here|this room))$"
)
_SEE = r"(?:see|notice|spot|find|meet|come across)"
_SEEN = r"(?:seen|noticed|spotted|found|met)"
_WHEN = r"(?:when|where|how long ago|at what time|in which room)"
_WHAT = r"(?P<what>[^,;:.!?]{1,60}?)"
_LAST = r"(?: (?:last|the last time|for the last time|most recently))?"
_SOMEBODY = r"(?:some|any)(?:one|body)(?: else)?|people|a person|persons|guests|visitors"
THING = re.compile(
    rf"(?:{_WHEN} )?did you (?:last |ever |also )*{_SEE} {_WHAT}{_LAST}"
    rf"|{_WHEN} (?:have|had) you (?:last |ever )*{_SEEN} {_WHAT.replace('what', 'b')}{_LAST}"
    rf"|{_WHEN} was the last time (?:that )?you saw {_WHAT.replace('what', 'c')}"
    rf"|where (?:was|were) {_WHAT.replace('what', 'd')}{_LAST}"
    rf"|{_WHEN} you (?:last )?saw {_WHAT.replace('what', 'e')}{_LAST}"
    rf"|(?:have|did) (?:i|we) (?:ever )?(?:tell|told|say|said)(?: you)? where"
    rf" {_WHAT.replace('what', 'k')} (?:is|are|was|were)"
    rf"|where did (?:i|we) say {_WHAT.replace('what', 'i')} (?:was|were|is|are)"
    rf"|where (?:i|we) (?:said|told you)(?: that)? {_WHAT.replace('what', 'l')} (?:was|were|is|are)"
    rf"|where (?:did (?:i|we) say|(?:i|we) (?:said|told you))(?: that)? (?:i|we)(?:'d|'ve| had"
    rf"| have)? (?:put|left|kept|hid)"
    rf" {_WHAT.replace('what', 'm')}"
    rf"|where {_WHAT.replace('what', 'f')} (?:was|were)"
    rf"|(?:have|had) you ever {_SEEN} {_WHAT.replace('what', 'g')}"
    rf"|when (?:was|were) {_WHAT.replace('what', 'h')} (?:last )?{_SEEN}"
    rf"|how many {_WHAT.replace('what', 'j')} (?:did you (?:{_SEE}|count)|have you (?:{_SEEN}"
    rf"|counted))"
)
NOW = re.compile(
    rf"where (?:is|are|can i find) {_WHAT}|where {_WHAT.replace('what', 'b')} (?:is|are)"
    rf"|where (?:did|have) (?:i|we) (?:leave|put|left) {_WHAT.replace('what', 'c')}"
    rf"|where (?:i|we) (?:left|put|have left|have put) {_WHAT.replace('what', 'd')}"
    rf"|(?:have|had) you {_SEEN} {_WHAT.replace('what', 'e')}(?: anywhere| around)?"
    rf"|where (?:does|do|did) [a-z' ]{{1,20}}? (?:keep|put|leave|store"
    rf"|park) {_WHAT.replace('what', 'f')}"
    rf"|whose (?:is|are) {_WHAT.replace('what', 'g')}"
    rf"|whose {_WHAT.replace('what', 'm')} (?:is|are) (?P<here>this|that|it|these|those)"
    rf"|who does {_WHAT.replace('what', 'h')} belong to"
    rf"|who owns {_WHAT.replace('what', 'i')}|what(?:'s| is) (?P<j>my (?:name"
    rf"|favou?rite [a-z ]{{2,30}}))"
    rf"|when(?:'s| is| does) {_WHAT.replace('what', 'k')} (?:coming|come|arriving|arrive|due)"
    rf"|when(?:'s| is) {_WHAT.replace('what', 'l')}"
)
"""Asked of now: answered from memory where it knows something, else it is offered to look."""
ANYTHING = re.compile(
    r"(?:did|has) anything (?:happen|happened)(?: interesting| odd| strange)?|"
    rf"what (?:all )?(?:did you {_SEE}|have you {_SEEN}|(?:was|were)(?: there)?|you saw|you"
    rf" have {_SEEN}"
    r"|was going on|happened)"
    rf"|(?:did you {_SEE}|have you {_SEEN}) (?:any|some)thing(?: else)?"
    r"(?: (?:interesting|odd|strange|unusual|new|special|wrong|there))?"
)
PERSON = re.compile(
    rf"(?:when|how long ago) (?:was|were|did you see) (?:there )?(?:{_SOMEBODY})(?: there)?"
    rf"|(?:was|were) (?:there )?(?:{_SOMEBODY})(?: (?:in )?there)?|(?:has"
    rf"|have) (?:{_SOMEBODY}) been(?:"
    rf" there)?"
    r"|who was the last person (?:that )?you (?:saw|met|spotted)|who did you (?:see|meet) last"
    rf"|did you (?:see|notice) (?:{_SOMEBODY})(?: (?:come|coming|go|going|walk|walking)(?: in"
    rf"| by| past"
    r"| out| through)?)?"
    rf"|did (?:{_SOMEBODY}) (?:come|go|walk|enter|stop|pass|visit)(?: in| by| past| through)?"
    rf"|(?:(?:has|have) )?(?:{_SOMEBODY}) (?:been|come|called|visited|stopped|popped)(?: in| by"
    rf"| round| over| here| there| past"
    r"| through)*|did (?:i|we) have (?:any )?(?:visitors|guests|callers)|(?:has"
    r"|have) there been (?:any )?(?:visitors|guests)"
    r"|who (?:all )?(?:was|were|came|went|walked|has been|have been)(?: there| in| by)?"
    r"|who (?:did you|have you) (?:see|seen|meet|met|find|found)|who you (?:saw|have seen|met)"
)
ENTERS = re.compile(
    rf"who entered(?: {_THE}(?P<at>{MARK}))?|did (?:{_SOMEBODY}) enter {_THE}(?P<at2>{MARK})"
)
DEEDS = re.compile(
    r"what(?:'ve| have) you been (?:doing|up to)|what did you get up to|did you do anything"
    r"|what have you (?:actually|even) (?:done|been doing)|how many [a-z ]{2,30} you (?:counted"
    r"|had counted)"
    r"|what (?:all )?(?:did you do|have you (?:done|been doing|been up to)"
    r"|were you (?:just )?(?:doing|up to)"
    r"|did you just do)"
    r"|what you (?:did|have done|were doing|have been doing)"
    r"|where (?:all )?(?:did you (?:go|drive)|have you been|were you)|where you (?:went|were"
    r"|have been)"
    r"|how (?:did you spend|was) your (?:day|time)"
    r"|(?:did|have) you (?:already |even |ever |actually )*(?:tell|told|ask(?:ed)?|remind(?:ed)?"
    r"|warn(?:ed)?"
    r"|wake|woken|greet(?:ed)?|say|said|let|follow(?:ed)?)"
    r" (?!(?:it|him|her|them|that|me|us|you|so)\b)[^,;]{2,80}"
    r"|what did you (?:say to|tell|ask) (?!(?:it|him|her|them|me|us)$)[^,;]{2,60}"
    r"|why (?:did|have) you (?:just |even )?(?:go(?:ne)?|drive|driven|come|leave|left|turn(?:ed)?"
    r"|say|said|look(?:ed)?"
    r"|bring|brought|follow(?:ed)?)(?: [^,;]{2,60})?"
)
VISITS = re.compile(
    r"(?:when did you last (?:go|drive)|have you (?:already )?(?:been|gone|driven)"
    r"|did you (?:go|drive)|were you|when were you last"
    r"|when was the last time (?:that )?you (?:were|went|drove)"
    r"|why (?:did|have) you (?:just |even )?(?:go(?:ne)?|drive|driven|come|look(?:ed)?)(?: over"
    r"| all the way)?"
    r"|(?:did|have) you (?:already |even |ever )*(?:go(?:ne)? (?:and )?)?(?:been|look(?:ed)?"
    r"|check(?:ed)?)(?: around)?)"
    rf"|(?:(?:did|have) you (?:already |even |ever )*(?:go(?:ne)? (?:and )?)?|when did you last "
    rf"|when was the last time (?:that )?you )"
    rf"(?:check(?:ed)?|visit(?:ed)?|done?|did|patrol(?:led)?) {_THE}(?P<at>{MARK})(?: already)?"
)
"""Asks whether it was at a place."""
TOLD = re.compile(
    rf"what (?:did|have) (?:i|we) (?:tell you|told you|say|said|teach you|taught you)(?: about"
    rf" {_WHAT})?"
    rf"|what (?:i|we) (?:told you|said|taught you)(?: about {_WHAT.replace('what', 'b')})?"
    rf"|what (?:do you|you) (?:still )?(?:remember|know) about {_WHAT.replace('what', 'c')}"
    rf"|what you (?:remember|know) about {_WHAT.replace('what', 'd')}"
    rf"|(?:everything|anything|all) (?:that )?you (?:remember|know|have) (?:about|on)"
    rf" {_WHAT.replace('what', 'f')}"
    rf"|what (?:do you|you) (?:still )?remember"
    rf"|(?:do you remember|remember) anything about {_WHAT.replace('what', 'e')}"
)
ARTICLE = re.compile(r"^(?:(?:the|a|an|my|our|your|his|her|their|any|some|this|that)\s+)+")
SOMEBODY = re.compile(rf"(?:{_SOMEBODY}|anybody|the people)")
NOTHING = re.compile(
    r"(?:it|that|this|them|him|her|me|you|us|there|here|one|something|anything|everything|what|who)"
    r"|.*\b(?:and|then|or|if|please|go|drive|come|find|tell)\b.*"
)
"""What is no thing to ask about, or is an order besides."""
