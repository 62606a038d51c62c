"""Put a Chinese reminder at a place in words that the grammar reads: 到客厅提醒我吃药 says 吃药 there.

Pure, on folded text. Law: only the going and the one thing to say are taken; behind them stand at
most how often it is said and why, and anything else leaves the whole as it was said, so that the
brain asks about it.
"""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.numbers import chinese_number
from planner.language.schedule.command import ScheduleCommand

if TYPE_CHECKING:
    from planner.language.schedule.command import OrderCommand

KIN = (
    r"(?:和|跟|与|家|爸|妈|爹|娘|爷|奶|姥|外[公婆]|阿[公婆姨爷嬷]|儿子|女儿|闺女|孩子|小孩|宝|囡|孙|老[公婆爸妈]|丈夫|妻子"
    r"|哥|姐|弟|妹|叔|姑|舅|婶|姨|室友|同学|朋友|的|们的|们家)"
)
"""Behind 我 these are who is meant: 叫我儿子起床 wakes the son, 叫我起床 the one who speaks."""
_GO = r"(?:你)?(?:先|再)?(?:过?来|去|到|上|回|进|开到|跑到|走到)到?"
_PLACE = r"(?P<place>[^来去到,;。“”\"说讲提叫喊唤跟告对和问看瞧找数等催把给让叮嘱]{1,10}?)"
_COME = r"(?:这里|这边|这儿|那里|那边|那儿)?(?:来|去)?"
_ME = rf"我们?(?!{KIN})"
_TELLS = rf"[跟和对给]{_ME}(?:说|讲)(?:一声|一下|一句|句|声)?|告诉{_ME}(?:一声|一下)?"
_REMINDS = (
    rf"提醒(?:一下)?{_ME}(?:一声|一下|一次)?|(?:叫|喊|催)(?P<wake>醒)?(?:一下)?{_ME}(?:一声|一下)?"
)
_DEED = re.compile(
    rf"{_GO}{_PLACE}{_COME},?(?:再|就|然后|并且?|顺便)?(?:(?P<tells>{_TELLS})|{_REMINDS})(?P<what>.*)"
)
_TIMES = re.compile(
    r"(?:(?:要|连|一共)?(?:叫|喊|说|讲|提醒|念|催|重复)(?:我)?)(?:上|个)?(?P<n>[两二三四五六七八九十]|\d{1,2})[遍次声回]"
)
_TIMES_BEHIND = re.compile(r"(?P<what>.+?)(?P<n>[两二三四五六七八九十]|\d{1,2})[遍声]")
_CUT = re.compile(r"[,;。!]+")
_LEADS = re.compile(r"^(?:说|要|该去)?[:]?")
_MORE = re.compile(
    r"如果|要是|假如|的话|除非|不然|否则|直到|然后|接着|之后再|完再|再去|再来|再到|顺便|并且|同时|或者?|还是|等.+再"
)
"""With these more is ordered, or it hangs on something."""
_ASKS = re.compile(
    r"[吗呢?]|什么|谁|几|哪|怎么|多少|有没有|是不是|(?P<verb>[^不]{1,2})不(?P=verb)|没有$"
)
"""With these it is found out, and no words to say: 告诉我谁在."""
_LEFT_OUT = re.compile(
    r"(?:就|都|也|先|那)*(?:不用|不要|不必|不需要|别(?!忘)|甭|免了?$|跳过|算了|休息一[天次]|停一?[天次])"
)
_TO_AN_HOUR = re.compile(
    r"(?:(?<=[看瞧守待陪跟巡逻转走站盯玩坐着])|一直|直)到(?:了)?(?:今天|今晚|明天|明早)?(?:早上|上午|中午|下午|傍晚|晚上|夜里|半夜|凌晨)?"
    r"(?:[零一二三四五六七八九十两\d]{1,3}(?:点|:\d)|中午|半夜|天亮|天黑)"
)
"""No plan goes on until an hour; 等到九点 waits for it, and is none of these."""
_SAID_OFTEN = re.compile(
    r"(?P<say>[说喊](?:一[句声])?[“\"「][^“”\"「」]+[”\"」])[,，]?(?:一共|连着?)?[说喊叫讲念]?(?P<n>[两二三四五六七八九十]|\d{1,2})[遍次声](?=[,，。;]|$)"
)
_ENOUGH = re.compile(r"(?:就行|就好|就可以|就够)了?$")
_URGES = re.compile(r"(?:(?<=^)|(?<=[,，;]))催(?=[^我,，“”]{1,4}(?:快点)?[^,，]+)")
"""Who is urged is told."""
_MOST_SAID = 5
_WHY = re.compile(
    r"(?:因为)?(?:我们?|[他她]们?|今天|已经|太)(?!.*(?:就|再|你|如果|要是|的话|别|不要|去(?:看|找|说|问))).{1,12}"
    r"|(?:免得|省得|不然|否则|怕)(?:我|又|会|老|都)*(?:忘|迟到|睡过|误|来不及|不记得).{0,5}"
)
"""Why it is said."""
_QUOTED = re.compile('[“"「](?P<said>[^“”"「」]+)[”"」]')
_TIME_IS_OVER, _GET_UP = "时间到了", "该起床了"


def settle_deed(command: OrderCommand | None) -> OrderCommand | None:
    """Return an order whose deed says in plain words where and how often something is said."""
    if not isinstance(command, ScheduleCommand) or not has_chinese(command.order):
        return command
    if command.problem == "order_time_missing" and _LEFT_OUT.match(command.order):
        return None  # 明天不用叫了 is no order that lacks its hour
    if command.reminder is not None:
        often = repeat_reminder(command.reminder)
        if often is not None:
            return replace(command, order=often, reminder=None)
        bare = _ENOUGH.sub("", command.reminder)
        return replace(command, order=bare, reminder=bare)
    if command.problem is None and _TO_AN_HOUR.search(_QUOTED.sub("", command.order)):
        return replace(command, when=None, problem="order_nested")
    deed = place_reminder(command.order) or say_so_often(_URGES.sub("提醒", command.order))
    return replace(command, order=deed)


def say_so_often(deed: str) -> str:
    """Return a deed in which what is said several times stands so often, or once with how often."""
    found = _SAID_OFTEN.search(deed)
    if found is None:
        return deed
    times, before, behind = _number(found["n"]), deed[: found.start()], deed[found.end() :]
    if not behind.strip(" ,.。!"):
        return f"{before}{found['say']}{times}遍"
    return f"{before}{','.join([found['say']] * times)}{behind}" if times <= _MOST_SAID else deed


def place_reminder(deed: str) -> str | None:
    """Return the deed of a reminder that is said at a place; None of any other deed."""
    found = _DEED.fullmatch(deed.strip(" ,"))
    if found is None:
        return None
    said = found["what"]
    if found["tells"]:
        said = said.lstrip(" ,:")
        if not said or _ASKS.search(said):
            return None
    spoken = _read_words(said, _GET_UP if found["wake"] else _TIME_IS_OVER)
    return None if spoken is None else f"去{found['place']}，{spoken}"


def repeat_reminder(what: str) -> str | None:
    """Return the deed of a reminder whose words end in how often it is said: 起床,叫三遍."""
    often = any(_TIMES.fullmatch(each) for each in _CUT.split(what)[1:])
    return _read_words(what, _TIME_IS_OVER) if often else None


def _read_words(said: str, nothing: str) -> str | None:
    """Return the words as they are to be said, with how often; None where more is ordered.

    Args:
        said: the words, with what stands behind them.
        nothing: what is said where there are no words.
    """
    quoted = _QUOTED.match(said)
    words, *others = _CUT.split(said[quoted.end() :] if quoted is not None else said)
    if quoted is None:
        words = _LEADS.sub("", words)
        if _TIMES.fullmatch(words):
            words, others = "", [words, *others]
        if _MORE.search(words) or _QUOTED.search(words):
            return None
    elif words:
        words, others = "", [words, *others]
    times = 1
    for each in filter(None, others):
        counted = _TIMES.fullmatch(each)
        if counted is None and _WHY.fullmatch(each) is None:
            return None
        times = _number(counted["n"]) if counted is not None else times
    behind = _TIMES_BEHIND.fullmatch(words) if times == 1 else None
    if behind is not None:
        words, times = behind["what"], _number(behind["n"])
    words = quoted["said"] if quoted is not None else words or nothing
    return f"说“{words}”{times}遍" if times > 1 else f"说“{words}”"


def _number(word: str) -> int:
    value = float(word) if word.isdigit() else chinese_number(word)
    return 0 if value is None else int(value)
