"""Hold the English patterns of the grammar; here the phrases that many of its rules share."""

from __future__ import annotations

from planner.language.folding import CHINESE
from planner.language.grammar.lexicon import MARK, NAME

THE = r"(?:the |a |an |my |our |your |this |that )?"
PREP = (
    r"(?:in|inside|at|on|on top of|near|by|next to|beside|around|within|within|of|from|inside of)"
)
_SPOT = rf"{THE}{MARK}(?: room| area)?(?: (?:in|of) {THE}{MARK})?"
# Words that no description of a person or thing goes past: another phrase begins there.
WORD = r"(?!(?:to|in|at|on|from|for|and|into|onto|with|near|by|back|then|you|me)\b)[a-z0-9'/-]+"
_DESCRIBES = (
    rf"(?!(?:into|from)\b|to (?!(?:the|their|his|her) (?:left|right)))[a-z0-9'/{CHINESE}-]+"
)
DESCRIPTION = rf"(?:{_DESCRIBES} )*?{_DESCRIBES}(?<! in)(?<! at)(?<! on)(?<! near)(?<! by)"
_WHO = (
    r"(?:person|people|man|men|woman|women|boy|girl|child|children|kid|elder|guest|lady|ladies|"
    r"gentleman|gentlemen|guy|visitor|patient|customer|human|stranger|baby|host|friend|operator|"
    r"little one|user|owner|colleague|student|teacher|doctor|nurse|adult|male|female|family)s?"
)
PERSON = (
    rf"(?:{NAME}|him|her|them|"
    r"whoever(?: is|'s)(?= (?:in|at|on|by|near)\b)|"
    rf"(?:every|any|some)(?:one|body)(?: {DESCRIPTION})??"
    r"|(?:all (?:of )?(?:the )?|every |each |the |a |an |any |some |my |our |your |that |this |"
    r"another )?"
    rf"(?:{WORD} ){{0,3}}?{_WHO}(?: {DESCRIPTION})??)"
)


def loc(name: str) -> str:
    """Return an optional place phrase as a named group: " in the kitchen", " there"."""
    return (
        rf"(?: (?:right |over )?{PREP} (?P<{name}>{_SPOT})| (?:over )?(?P<{name}_there>there|"
        r"here))?"
    )
