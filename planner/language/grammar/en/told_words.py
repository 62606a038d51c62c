"""Set in quotes the words for somebody that deny or have a time of their own.

"Tell Dad I won't be home for dinner" denies nothing of the order: what is told are words. Pure text
to text. Laws: the order itself is not denied; the words begin with somebody or something and say
how things stand; they hold no condition, no choice and no order, for those may be the robot's.
"""

from __future__ import annotations

import re

from planner.language.grammar.en.direct_questions import ask_directly
from planner.language.numbers import EN_DURATION

_LASTS = EN_DURATION.replace("?P<number>", "?:").replace("?P<unit>", "?:")
_LEAD = (
    r"(?:(?:please|pls|robot|pons|hey|hi|ok|okay|well|and|just|so|now|go|come|(?:can|could|would"
    r"|will)"
    r" you)[ ,]+(?:to )?)*"
)
_BEFORE = (
    r"(?:(?P<before>(?:(?!\b(?:tell|say|ask|remind|know|inform|warn|announce|shout)\b)[^\"“”])+?"
    r"(?:, (?:and )?(?:then )?| and (?:then )?| then )))??"
)
"""Orders before it, which are left as they are."""
_IN = r"(?: (?:in|at|on|by|near) (?:the |my |our )?[a-z]+(?: (?:room|table|door))?)?"
_HEARER = (
    r"(?:(?:my|our|the|your) (?!(?:robot|way|time)\b)[a-z]+(?: (?!(?:is|are|was|were)\b)[a-z]+)??"
    r"|(?!(?:me|us|nobody|no one|noone|the|my|our|your|a|i|we|it|he|she|they|you|to|not|no|that"
    r"|what|whether|if|about|how|where|when|why|who|which)\b)[a-z]+(?: (?:and|or) [a-z]+)??)"
)
_VERB = rf"(?:(?:tell|inform|warn|remind) (?P<who>{_HEARER}{_IN})|let (?P<let>{_HEARER}{_IN}) know)"
_SUBJECT = (
    r"(?:i|we|he|she|it|they|you|there|that|this|nobody|nothing|no one|none|somebody|someone"
    r"|everybody|everyone|(?:the|my|our|his|her|their|a|an|no) [a-z]+(?: [a-z]+)?(?: of [a-z]+)?"
    r"|mum|mom|dad|granny|grandma|grandpa|nan|dinner|lunch|breakfast|supper|tea|school"
    r"|(?-i:[A-Z][a-z]+))"
)
_DENIAL = (
    r"(?:[a-z]+n't|[a-z]+n’t|(?:is|are|am|was|were|do|does|did|has|have|had|will|would|can|could"
    r"|should|must|need|'s|'re|'m|’s|’re|’m) (?:\w+ )?(?:not|no|never|nothing|nobody)|cannot"
    r"|will not|never|no longer|nothing|nobody|no)"
)
_TIME = (
    rf"(?:in (?:about |around |just )?(?:{_LASTS}"
    r"|half an hour|(?:a )?quarter of an hour|a (?:bit|while|moment|second|sec|minute))"
    r"|(?:at|by|around) (?:about |around |half |quarter |twenty |ten |five |past |to )*"
    r"(?:[a-z]+|\d{1,2}(?:[:.]\d\d)?)(?: ?[ap]\.?m\.?| o'clock)?"
    r"|tomorrow|tonight|today|later|soon|on (?:mon|tues|wednes|thurs|fri|satur|sun)day)"
)
"""When the words are true; with it they are quoted as well."""
_OPEN = re.compile(
    r"\b(?:if|unless|until|till|when|whenever|while|before|after|once|or|otherwise|else|except"
    r"|instead|then|whether)\b|[;:.!?\"“”]",
    re.IGNORECASE,
)
_ORDER = (
    r"(?:go|come|drive|head|return|wait|stop|find|look|check|search|count|follow|turn|patrol|tell"
    r"|ask|say|don't|do not|don’t|not|never)"
)
_REST = (
    rf"(?P<rest>(?:,? (?:and )?then |,? and (?:then )?|[.,;] (?:then )?(?:please )?){_ORDER}\b.*)?"
)
_THANKS = r"(?P<thanks>[ ,]+(?:please|pls|thanks|thank you|ok|okay|will you|would you)[.!?]*)?"
_WORDS = (
    rf"(?:that )?(?P<words>(?:{_SUBJECT})(?:'[a-z]+|’[a-z]+|n't)?\b"
    rf"(?=[^.;]*?(?:\b|'|’)(?:{_DENIAL}|{_TIME})\b)[^.;]+?"
    r"|(?:no one|nobody|nothing|none)\b[^.;]+?)"
)
_TOLD = re.compile(
    rf"{_BEFORE}{_LEAD}{_VERB},? {_WORDS}{_THANKS}[.!? ]*{_REST}", re.IGNORECASE | re.DOTALL
)
_SAID = re.compile(
    rf"{_BEFORE}{_LEAD}say(?: out loud)? {_WORDS}{_THANKS}[.!? ]*{_REST}", re.IGNORECASE | re.DOTALL
)
_ASKS = re.compile(
    rf"{_BEFORE}{_LEAD}ask (?P<who>{_HEARER}{_IN}),? "
    r"(?P<words>(?:if|whether|what|when|where|which|how|who|why) [^.;\"“”]+?)"
    rf"{_THANKS}[.!? ]*{_REST}",
    re.IGNORECASE | re.DOTALL,
)
_ASKED_OPEN = re.compile(
    r"\b(?:unless|until|till|while|before|after|once|otherwise|else|except|instead|then|but)\b"
    rf"|\b(?:or|and) (?:please |just |else )?{_ORDER}\b"
    r"|(?<=.)\b(?:if|whether|when(?:ever)?)\b|^when(?:ever)? (?:he|she|they|it|i|we|you|there)\b"
    r"|[;:.!?\"“”,]",
    re.IGNORECASE,
)
_NOT_TO = re.compile(
    rf"{_BEFORE}{_LEAD}(?:tell|ask|remind|warn) (?P<who>{_HEARER}{_IN}),? (?:please )?"
    rf"(?:not to|never to) (?P<words>[a-z][^.;,]+?){_THANKS}[.!? ]*{_REST}",
    re.IGNORECASE | re.DOTALL,
)


_WITH_ANSWER = re.compile(
    r"(?:come|report) (?:straight |right )?back (?:to me )?with (?:the|his|her|their"
    r"|an) (?:answer|reply)"
)


def quote_told_words(text: str) -> str | None:
    """Return a sentence with the words that somebody is told in quotes; None where it has none."""
    said = " ".join(text.split())
    for pattern in (_TOLD, _SAID, _NOT_TO, _ASKS):
        found = pattern.fullmatch(said)
        asks = pattern is _ASKS
        if found is None or (asks and _ASKED_OPEN.search(found["words"]) is not None):
            continue
        if not asks and _is_open(found["words"]):
            continue
        groups = found.groupdict()
        words = found["words"].strip(" ,")
        if pattern is _NOT_TO:
            words = f"please don't {words}"
        who = groups.get("who") or groups.get("let")
        told = f'tell {who} "{words}"' if who else f'say "{words}"'
        if asks:
            told = f'ask {who} "{ask_directly(words)}"'
        rest = _WITH_ANSWER.sub("come back", found["rest"] or "")
        return f"{found['before'] or ''}{told}{rest}"
    return None


def _is_open(words: str) -> bool:
    """Tell whether words hold what may be the robot's own: a condition, a choice, an order."""
    joined = re.search(rf"(?:,|\band) (?:please )?{_ORDER}\b", words, re.IGNORECASE)
    return _OPEN.search(words) is not None or joined is not None
