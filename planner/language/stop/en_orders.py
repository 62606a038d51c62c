"""Own the English clauses that order a stop by themselves, and how stop words are misspelt.

Patterns and words alone, for stop.py. ``ORDER`` and ``QUIT`` are matched against one whole clause
in lower case, words and single spaces.
"""

from __future__ import annotations

import re

_STOP = r"s+t+o+p+|sotp|stpo|tsop|h+a+l+t+|f+r+e+z+e+"
_COURTESY = (
    r"please|pls|plz|kindly|just|now|right now|right away|immediately|instantly|at once|asap"
    r"|robot|pons|car|you|hey|hi|ok|okay|oh|no|wait|whoa|quick|quickly|fast|thanks|thank you"
    r"|(?:that is )?(?:far |quite )?enough|(?:can|could|would|will) you"
    r"|you (?:can|may|must|should|need to|have to)"
    r"|i said|i want you to|i need you to|i would like you to|i told you to|let us|for me|all"
)
_PHRASE = (
    rf"(?:{_STOP})(?: (?:it|that|this|there|here|right there|right here|where you are"
    r"|everything|all motion|the (?:robot|car|cart|vehicle|mission|task|goal|job|drive)"
    r"|(?:all |your |the )*motors?"
    r"|(?:moving|driving|going|running|rolling|turning|spinning|navigating|following)(?: me)?"
    r"|what you are doing))?"
    r"|come to a (?:stop|halt)|(?:emergency|protective) (?:stop|brake|halt)|e ?stop|brakes?"
    r"|(?:hold|stand|stay|keep) still|stay (?:put|where you are)|hold it|do not move(?: any ?more)?"
    r"|abort|cancel|pause|(?:quit|give up)(?: (?:it|that|this))?|give it up"
    r"|(?:abort|cancel|pause) (?:it|that|everything|the (?:goal|mission|task))"
)
ORDER = re.compile(
    rf"(?:(?:{_COURTESY}) )*(?:{_PHRASE})(?: (?:{_PHRASE}|{_COURTESY}))*"
    r"(?: (?:and|then|but|because)\b.*)?"
)
"""A whole clause that orders a stop, whatever follows it."""
_SOMEBODYS = ("the", "a", "my", "our", "your")
CALL = re.compile(
    "".join(rf"(?<!\b{word} )" for word in _SOMEBODYS) + r"(?<![a-z0-9])(?:robot|pons)(?![a-z0-9'])"
)
"""The robot's name where it is called, in the middle of anything that is said."""
ONLY_COURTESY = re.compile(rf"(?:{_COURTESY}|quick)(?: (?:{_COURTESY}))*")

# Quitting is said of searching, counting, following, patrolling and driving, never of waiting:
# "stop waiting" begins something. What is quitted may be named in any words, but for a condition or
# a place that says when or where to stop ("stop looking when you see it"). Behind a denial nothing
# is left to a brain: "don't follow me if …" stops, as the safe side.
_SEARCHING = (
    r"looking|searching|hunting|seeking|finding|locating|counting|tracking|trailing|following"
    r"|chasing|watching|scanning|observing|monitoring|exploring|inspecting|checking|patroll?ing"
    r"|wandering|roaming|touring|visiting|guiding|leading|escorting|accompanying"
)
_DRIVING = (
    r"moving|driving|going|coming|running|rolling|turning|spinning|navigating|walking|heading"
)
_TO = (
    r"(?:to|towards?|into|after|behind|around|about|through|back|forwards?|backwards?|away|home"
    r"|here|there|left|right|with|along|in circles?)"
)
_NO_FOLLOWER = r"after(?! (?:me|us|him|her|them|it)\b)"
_WHEN = (
    r"when|whenever|if|once|unless|as|while|before|in front|next to|near|beside"
    rf"|{_NO_FOLLOWER}"
)
_GOES_ON = r"(?: (?:and|then|but|because|until|till)\b.*)?"
_REST = rf"(?: (?!(?:and|then|but|because|until|till|{_WHEN})\b)[a-z0-9]+)*{_GOES_ON}"
_ENDING = r"(?:s+t+o+p+|quit|cease|leave off|give up|(?:no more|enough)(?: of| with)?)"
_SEARCH = (
    r"(?:search|hunt|count|patrol|tour|chase|pursuit|exploration|inspection"
    rf"|{_SEARCHING})"
)
_BASE = (
    r"look|search|hunt|seek|find|locate|count|track|trail|follow|chase|watch|scan|observe|monitor"
    r"|explore|inspect|check|patrol|wander|roam|guide|lead|escort|accompany"
    r"|(?:come|go|run|walk) (?:after|behind|with)|keep (?:looking|searching|counting|following)"
)
_DENYING = r"(?:i do not want you to|(?:you )?(?:should|must) not|do not(?: ever)?|never|no longer)"
_NEARER = (
    r"(?:drive|turn|spin|rotate|roll|come|approach)(?: (?:any|closer|nearer|near|further|on|here|to"
    r"|towards?|up|at|me|us|around|now|again|more|anymore))*"
)
_IT = r"(?:(?:the |this |that )?(?:robot|car|it|thing) (?:from )?)?"
QUIT = re.compile(
    rf"(?:(?:{_COURTESY}) )*(?:"
    rf"{_ENDING} {_IT}(?:{_SEARCHING}){_REST}"
    rf"|{_ENDING} (?:{_DRIVING}) {_TO}\b{_REST}"
    rf"|(?:{_ENDING}|cancel|abort|end|pause|abandon|call off|suspend)"
    rf" (?:(?:the|this|that|your|my|all|current|whole) )*{_SEARCH}{_REST}"
    rf"|{_DENYING} (?:{_BASE})(?: .*)?|{_DENYING} {_NEARER}"
    rf"|leave (?:me|us|him|her|them|it) alone{_GOES_ON})"
)

_CRY = (
    r"(?:no+|nope|nah|nuh|uh|oh|hey|oi+|robot|please|my|god|ow+|ouch|help(?: me)?|ar+g+h+|a+h+"
    r"|ee+k|na|whoops|oops|pons)"
)
REFUSES = re.compile(
    rf"(?:{_CRY}[ ,]*)*(?:no+|nope|nah|ow+|ouch|help(?: me)?|ar+g+h+|ee+k)(?:[ ,]*{_CRY})*[ ,]*"
)
"""A sentence of nothing but "no", or a cry."""

# Misspellings ----------------------------------------------------------------------------------

MENDED = ("stop", "freeze", "halt", "brake", "abort", "whoa", "cease", "pause", "cancel")
"""Words of which every spelling with one letter wrong is taken for the word itself."""
OTHER_WORDS = frozenset(
    {
        *(
            "stops",
            "stoop",
            "strop",
            "stomp",
            "stow",
            "atop",
            "shop",
            "slop",
            "step",
            "top",
            "stope",
        ),
        *("stoup", "sop", "sto", "op", "freezer", "freezes", "frieze", "breeze", "freed", "half"),
        *("hall", "salt", "malt", "hat", "halo", "shalt", "haft", "halts", "hilt", "alt", "brakes"),
        *("brave", "bake", "bra", "brae", "brace", "break", "broke", "braked", "braker", "drake"),
        *("rake", "about", "aborts", "abbot", "who", "whop", "cases", "ceased", "crease", "lease"),
        *("tease", "ease", "chase", "paused", "pauses", "cause", "causes", "cancels", "cancer"),
    }
)
"""English words one letter away from a stop word; each may mean itself."""
ALONE = {
    **dict.fromkeys(("top", "step", "shop", "slop", "stow", "strop", "stoop", "atop"), "stop"),
    **dict.fromkeys(("stomp", "sto", "sop"), "stop"),
    **dict.fromkeys(("half", "hall", "salt", "hat", "malt"), "halt"),
    **dict.fromkeys(("breeze", "freezer"), "freeze"),
    **dict.fromkeys(("break", "breaks"), "brake"),
}
"""Taken for the stop word where nothing but courtesy stands beside it: nobody orders "step"."""
