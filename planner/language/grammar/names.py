"""Read the names in a sentence: places, whole or with what adds nothing to them, and persons."""

from __future__ import annotations

import re

from planner.language.grammar.lexicon import FIRST_NAME, MARK, NAMES, Marked
from planner.language.grammar.parse_result import Meaning, Problem, Reading, Steps
from planner.plan import Code, GoTo

_THE = r"(?:(?:the|a|my|our|your|this|that) )?"
_PLACE_EN = re.compile(
    rf"(?:(?P<near>next to|near|by|beside|close to|up to) |at |over to )?{_THE}(?P<a>{MARK})"
    rf"(?: room| area)?(?: (?:in|of|inside) {_THE}(?P<room>{MARK}))?"
)
_PLACE_ZH = re.compile(
    rf"(?:这个|那个|那边的|我的|我们的)?(?:(?P<room>{MARK})(?:里面?)?的?)?(?P<a>{MARK})"
    r"(?:(?P<near>的?(?:旁边|边上|附近|跟前|边|旁))|里面?|内|那边|那里|那儿|这边|这里|处)?"
)
_DETERMINER = re.compile(r"^(?:(?:the|a|an|my|our|your) )+")
_ZH_TAIL = re.compile(r"(?:里面?|内|那边|那里|那儿|这边|这里|旁边|附近|跟前)$")


def go_to(phrase: str, reading: Reading) -> Meaning:
    """Return the go-to step of a place phrase, or why there is none."""
    phrase = phrase.strip(" \"'")
    found = _PLACE_EN.fullmatch(phrase) or _PLACE_ZH.fullmatch(phrase)
    if found:
        return _named(found, phrase, reading)
    if re.search(MARK, phrase):
        return reading.problem(Code.NOT_UNDERSTOOD, phrase)
    return _unnamed(phrase, reading)


def _named(found: re.Match[str], phrase: str, reading: Reading) -> Meaning:
    mention = reading.marked.mention(found["a"])
    room = found["room"]
    if len(mention.ids) > 1:
        ids = mention.ids
        return Problem(Code.AMBIGUOUS, reading.marked.restore(phrase), places=ids)
    entry = reading.vocabulary.by_id[mention.ids[0]]
    about_a_room = entry.kind == "room" and found["near"] is not None
    in_its_room = room is None or entry.room in reading.marked.mention(room).ids
    if about_a_room or not in_its_room:  # "near the kitchen" is not in it; the sofa is elsewhere
        return reading.problem(Code.NOT_UNDERSTOOD, phrase)
    return Steps((GoTo(place=entry.id),))


def _unnamed(phrase: str, reading: Reading) -> Meaning:
    name = _ZH_TAIL.sub("", _DETERMINER.sub("", phrase)).strip()
    if not any(char.isalnum() for char in name):
        return reading.problem(Code.NOT_UNDERSTOOD, phrase)
    meant = reading.lexicon.typo(name)
    if meant is not None:
        return Steps((GoTo(place=meant),))
    name = reading.marked.restore(name)
    return Problem(Code.UNKNOWN_PLACE, name, places=reading.lexicon.near(name), name=name)


_GIVEN = (
    "adam|alan|albert|alex|alexander|alice|amanda|amy|andrea|andrew|angela|anna|anne|anthony|"
    "arthur|ashley|barbara|ben|benjamin|betty|brandon|brian|carl|carol|caroline|catherine|charles|"
    "charlie|charlotte|chris|christina|christopher|claire|cynthia|daniel|david|deborah|dennis|"
    "diana|"
    "donald|donna|dorothy|douglas|edward|elena|elizabeth|ella|emily|emma|eric|ethan|eva|evelyn|"
    "florian|francis|frank|gary|george|gloria|gregory|hannah|harold|harry|heather|helen|henry|"
    "isabella|jack|jacob|james|jane|janet|jason|jean|jeffrey|jennifer|jeremy|jerry|jessica|jim|"
    "joan|"
    "joe|john|jonathan|jose|joseph|joshua|juan|judith|julia|julie|justin|karen|kate|katherine|"
    "keith|"
    "kelly|kenneth|kevin|kim|kyle|larry|laura|lauren|leo|linda|lisa|louis|lucas|lucy|luis|madison|"
    "margaret|maria|marie|marilyn|martha|martin|mary|matthew|megan|mia|michael|michelle|mike|nancy|"
    "natalie|nathan|nicholas|nicole|noah|nora|oliver|olivia|pamela|patricia|patrick|paul|peter|"
    "philip|rachel|ralph|raymond|rebecca|richard|robert|robin|roger|ronald|roy|russell|ruth|ryan|"
    "samantha|samuel|sandra|sara|sarah|scott|sean|sharon|shirley|simon|skyler|sofia|sophia|stefan|"
    "stephanie|stephen|steve|steven|susan|teresa|theresa|thomas|timothy|tom|tyler|victoria|vincent|"
    "virginia|walter|wayne|william|zachary"
)
_KIN = (
    r"(?:(?:my|our|your) )?(?:mom|mum|mommy|mummy|mother|dad|daddy|father|grand(?:ma|pa|mother|"
    r"father)|"
    r"granny|wife|husband|son|daughter|brother|sister|uncle|aunt|boss|neighbou?r)"
)
_ZH = (
    r"(?:我的?|你的?)?(?:爸爸|妈妈|老爸|老妈|奶奶|爷爷|外公|外婆|姥姥|姥爷|哥哥|姐姐|弟弟|妹妹|"
    r"叔叔|阿姨|"
    r"老公|老婆|丈夫|妻子|儿子|女儿|老板)"
    r"|小[明红华丽强军刚芳伟王李张刘陈杨赵周吴林美]|老[王李张刘陈杨赵黄周吴]|张三|李四|王五"
    r"|[王李张刘陈杨赵黄周吴徐孙马朱胡郭何高林](?:先生|女士|小姐|老师|总|医生|师傅|阿姨|奶奶|爷爷|"
    r"叔叔)"
)
_KNOWN = re.compile(rf"(?<![a-z])(?:{_GIVEN}|{_KIN})(?![a-z])|{_ZH}")
_WORD = re.compile(r"[A-Za-z][A-Za-z'’-]*|[.!?:;\"“”]")
_NO_NAMES = frozenset(
    (
        "i",
        "tv",
        "monday",
        "tuesday",
        "wednesday",
        "thursday",
        "friday",
        "saturday",
        "sunday",
        "january",
        "february",
        "march",
        "april",
        "may",
        "june",
        "july",
        "august",
        "september",
        "october",
        "november",
        "december",
        "english",
        "chinese",
        "robot",
        "pons",
        "please",
        "tell",
        "could",
        "would",
        "can",
        "go",
        "the",
        "then",
        "and",
        "ok",
        "bring",
        "find",
        "navigate",
        "follow",
        "say",
        "come",
        "back",
        "first",
    )
)
_ARTICLES = frozenset(("the", "a", "an", "my", "your", "some", "any", "this", "that"))


def mark_people(marked: Marked, original: str) -> Marked:
    """Replace each name of a person by one private character; places are marked already."""
    written: list[str] = []

    def aside(found: re.Match[str]) -> str:
        if len(written) >= NAMES:
            return found[0]
        written.append(_title(found[0]))
        return chr(FIRST_NAME + len(written) - 1)

    text = _KNOWN.sub(aside, marked.text)
    capital = _capitalised(original)
    if capital:
        names = "|".join(sorted(map(re.escape, capital), key=len, reverse=True))
        text = re.sub(rf"(?<![a-z])(?:{names})(?![a-z])", aside, text)
    return Marked(text, marked.mentions, tuple(written))


def _title(name: str) -> str:
    plain = name if " " in name or not name.isascii() else name.title()
    return re.sub(r"^(?:your|my|our) ", "", plain)


def _capitalised(original: str) -> set[str]:
    """Return words with a capital inside a sentence, but where all words have one."""
    words = _WORD.findall(original)
    plain = [word for word in words if word[0].isalpha()]
    if sum(word[0].isupper() for word in plain) * 2 > len(plain) > 3:
        return set()
    found: set[str] = set()
    before = "."
    for word in words:
        inside = before[0].isalpha() and before.casefold() not in _ARTICLES
        if inside and word[:1].isupper() and not word.isupper():
            found.add(word.casefold())
        before = word
    return found - _NO_NAMES
