"""Know names of persons: common given names, the family, and words with a capital in a sentence.

Pure words; who is who, nobody here can tell.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING

from planner.language.folding import fold

if TYPE_CHECKING:
    from collections.abc import Callable

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
    r"granny|nana|nan|gran|grand?dad|gramps|auntie|papa|mama|wife|husband|son|daughter|brother"
    r"|sister|uncle|aunt|boss|neighbou?r)"
)
NAMES_ZH = (
    r"(?:孩子|宝宝|娃)[他她]?(?:爸爸?|妈妈?|爷爷|奶奶)|(?:我的?|你的?)?(?:爸爸|妈妈|老爸|老妈|奶奶|爷爷|外公|外婆|姥姥|姥爷|哥哥|姐姐|弟弟|妹妹|"
    r"叔叔|阿姨|"
    r"阿公|阿婆|阿嬷|阿爷|囡囡|闺女|媳妇|老伴|孙子|孙女|舅舅|姑姑|大姨|小姨|姨妈|姑妈|舅妈|伯伯|伯母|婶婶|嫂子|表[哥姐弟妹]|"
    r"老公|老婆|丈夫|妻子|儿子|女儿|老板)|[我咱](?:妈|爸|哥|姐|弟|妹)(?![妈爸哥姐弟妹])"
    r"|小[宝敏明红华丽强军刚芳伟王李张刘陈杨赵周吴林美杰文峰磊燕芸萌娟玲梅兰霞涛辉勇斌鹏洁慧莉婷佳欣怡琳阳凯鑫宇浩航]"
    r"|(?<![下有])小雨|阿[杰强明伟龙芳兰珍英华辉]|大[刘王李张陈](?![家])"
    r"|乐乐|欢欢|明明(?!白)|妞妞|贝贝|佳佳|婷婷|丽丽|莉莉|娜娜|媛媛|洋洋|阳阳|涛涛|浩浩|轩轩|萌萌|朵朵|果果|糖糖|壮壮"
    r"|强强|军军|龙龙|嘟嘟|依依|琪琪|珊珊|晶晶|芳芳|燕燕|霞霞|玲玲|瑶瑶|思思|诗诗|冰冰|康康|彤彤|妮妮"
    r"|老[王李张刘陈杨赵黄周吴]|张三|李四|王五"
    r"|[王李张刘陈杨赵黄周吴徐孙马朱胡郭何高林](?:先生|女士|小姐|老师|总|医生|师傅|阿姨|奶奶|爷爷|"
    r"叔叔)"
)
"""Names and kin that Chinese sentences name people by."""
_KNOWN = re.compile(rf"(?<![a-z])(?:{_GIVEN}|{_KIN})(?![a-z])|{NAMES_ZH}")
_WORD = re.compile(r"[A-Za-z][A-Za-z'’-]*|[.!?:;\"“”]")
_NO_NAMES = frozenset({
    "i", "i'll", "i'm", "i've", "i'd", "i’ll", "i’m", "i’ve", "i’d",
    "tv", "monday", "tuesday", "wednesday", "thursday", "friday", "saturday", "sunday",
    "january", "february", "march", "april", "may", "june", "july", "august", "september",
    "october", "november", "december", "english", "chinese", "robot", "pons", "please", "tell",
    "could", "would", "can", "go", "the", "then", "and", "ok", "bring", "find", "navigate",
    "follow", "say", "come", "back", "first",
})  # fmt: skip
_ARTICLES = frozenset(("the", "a", "an", "my", "your", "some", "any", "this", "that"))


def replace_names(text: str, original: str, replace: Callable[[re.Match[str]], str]) -> str:
    """Return a text in small letters with each name of a person replaced.

    Args:
        text: what is searched.
        original: the sentence as it was written: its capitals tell of names.
        replace: gives what stands for a name.
    """
    text = _KNOWN.sub(replace, text)
    capital = _find_capitals(original)
    if capital:
        names = "|".join(sorted(map(re.escape, capital), key=len, reverse=True))
        text = re.sub(rf"(?<![a-z])(?:{names})(?![a-z])", replace, text)
    return text


def people_named(text: str) -> tuple[str, ...]:
    """Return the persons whom a text names, each once, in its order and as they are written."""
    found: list[tuple[int, str]] = []

    def note(name: re.Match[str]) -> str:
        found.append((name.start(), write_name(name[0])))
        return "_" * len(name[0])

    replace_names(fold(text), text, note)
    return tuple(dict.fromkeys(name for _, name in sorted(found)))


@lru_cache(maxsize=256)
def is_given_name(words: str) -> bool:
    """Tell whether words are a common given name or one of the family: "Anna", "my dad", 奶奶."""
    return _KNOWN.fullmatch(fold(words).strip()) is not None


def write_name(name: str) -> str:
    """Return a name as it is written: without "your", and with a capital where it has one."""
    plain = name if " " in name or not name.isascii() else name.title()
    return re.sub(r"^(?:your|my|our) ", "", plain)


def _find_capitals(original: str) -> set[str]:
    """Return words with a capital inside a sentence, but where all words have one."""
    words = _WORD.findall(original)
    plain = [word for word in words if word[0].isalpha()]
    if sum(word[0].isupper() for word in plain) * 2 > len(plain) > 3:
        return set()
    found: set[str] = set()
    before = "."
    for word in words:
        inside = before[0].isalpha() and before.casefold() not in _ARTICLES
        is_i = word[:2] in ("I'", "I’")
        if inside and word[:1].isupper() and not word.isupper() and not is_i:
            found.add(word.casefold().removesuffix("'s").removesuffix("’s"))
        before = word
    return found - _NO_NAMES
