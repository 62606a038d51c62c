"""Read words about the standing orders that are kept: list them, remove, pause, resume some.

Which orders are meant is for their keeper to find (``planner.orders.selection``); here their words
are cut out. Only what names a standing order, a reminder or a time that comes again is one of these
sentences: "cancel the drive" is the goal's. Pure.
"""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING, Literal

from planner.language.schedule.asked import KINDS, MY, ZH_ALL, ZH_KINDS, read_asked
from planner.language.schedule.chinese_skips import read_chinese_skip
from planner.language.schedule.command import ChangeOrders
from planner.language.schedule.parts import (
    EVERY_DAY,
    DayPart,
    MonthDay,
    OnceDay,
    TimeOfDay,
    WeekDays,
    combine,
)
from planner.language.schedule.removals import read_removal
from planner.language.schedule.skips import read_skip
from planner.plan.timing import DayTime, InRule

if TYPE_CHECKING:
    from planner.language.schedule.command import OrderCommand
    from planner.language.schedule.parts import Part, ReadsTiming, ReadsWhole

    Act = Literal["remove", "pause", "resume", "skip"]

TODAY = OnceDay(ahead=0)

_OFTEN = (
    r"(?:evening|morning|afternoon|night|nightly|daily|hourly|weekly|weekday|weekend|noon|monday"
    r"|tuesday|wednesday|thursday|friday|saturday|sunday|recurring|scheduled|standing)"
)
_ACTS: tuple[tuple[Act, str], ...] = (
    ("remove", r"(?:i|we) (?:don't|do not|no longer) need|cancel|delete|remove|drop|stop|end|forget|clear|get rid of|no more|turn off"
     r"|switch off|call off|don't do|do not do|quit|abolish"),
    ("pause", r"pause|suspend|put on hold|mute|skip"),
    ("resume", r"resume|continue|restart|unpause|re-?enable|turn on|switch on|start|carry on with"),
)  # fmt: skip
_ON_HOLD = re.compile(r"^put (.+?) on hold\b")
_TAIL = r"(?: (?:any ?more|any longer|again|for now|for good|from now on|now|please))*"
_NAMED = re.compile(
    rf"(?:{MY}(?P<kind>{KINDS})(?: (?:for(?! now)|about|to|of|at|with|that says?) (?P<of>.+?))?"
    rf"|{MY}(?P<what>.+?) (?P<kind2>{KINDS})"
    rf"|(?:the |my |your )?(?P<often>{_OFTEN}(?: (?!again\b)[\w'-]+){{1,3}})"
    r"|(?:standing )?(?:order|reminder|number)? ?(?P<id>o\d{1,6})"
    rf"|the one(?:s)? (?P<one>.+?)|(?:the|my|that|this) (?P<called>.+?) ones?){_TAIL}"
)
_UNTIL = re.compile(r"(?P<rest>.+?) (?P<words>(?:until|till|up to) (?P<t>.+)|for (?P<for>.+))")
_THIS_DAY = re.compile(
    r"(?P<rest>.+?)(?: (?:for )?(?:only )?(?:tonight|today|this (?:morning|afternoon|evening)))"
)
_IN_A_PART = re.compile(
    r".+ (?:in the (?:morning|afternoon|evening)s?|at (?:night|noon)|at weekends?|on weekends?)"
)
_REMINDING = re.compile(
    rf"(?:(?:stop|quit|cease) reminding me|(?:don't|do not|never) remind me)"
    rf"(?: (?:to|about|of|that) (?P<of>.+?))?{_TAIL}"
)
_NOT_ANY_MORE = re.compile(
    rf"(?:don't|do not|never|stop|quit|no more) (?!let me forget)(?P<what>.+?){_TAIL}"
)

_ZH_OFTEN = r"(?:每天|每日|每晚|每早|每周|每星期|每个?工作日|每个?小时|每隔|每半|天天|周末|晚上的|早上的|每次)"
_ZH_NOT = r"(?:不要|不用|不必|不需要|别|甭|停止|不)(?:再)?"
_ZH_REMIND = re.compile(rf"{_ZH_NOT}提醒(?:我)?(?P<of>.*?)(?:了)?")
_ZH_ACTS: tuple[tuple[Act, str, str], ...] = (
    ("remove", r"取消|删除|删掉|去掉|清除|停止|停掉|关掉|结束|撤销", r"取消|删除|删掉|删了|去掉|关掉|停掉|停了|撤销"),
    ("pause", r"暂停|先停掉", r"暂停|停一停"),
    ("resume", r"恢复|继续|重新开始|启用|重新启用|开始", r"恢复|打开|启用"),
)  # fmt: skip


def read_about(
    folded: str, reads: ReadsTiming, whole: ReadsWhole, *, chinese: bool
) -> OrderCommand | None:
    """Return what a sentence says about the orders that are kept; None where it says nothing."""
    asked = read_asked(folded, whole, chinese=chinese)
    if asked is not None:
        return asked
    if chinese and (skipped := read_chinese_skip(folded, whole)) is not None:
        return skipped
    said = (_read_chinese if chinese else _read_english)(folded, reads, whole)
    if not chinese and (said is None or said.act == "remove"):  # one day drops nothing for good
        said = read_skip(folded, whole) or said
    return said or read_removal(folded, reads, whole, chinese=chinese)


def _read_english(folded: str, reads: ReadsTiming, whole: ReadsWhole) -> ChangeOrders | None:
    folded = _ON_HOLD.sub(r"pause \1", folded)
    reminding = _REMINDING.fullmatch(folded)
    if reminding is not None:
        return ChangeOrders("remove", reminding["of"] or "", reminders=True)
    for act, verbs in _ACTS:
        verb = re.match(rf"(?:{verbs}) ", folded)
        if verb is not None:
            rest = folded[verb.end() :]
            timed = _read_until(rest, whole, reads) if act == "pause" else None
            found = timed or _read_named(act, rest, reads)
            if found is not None:
                return found
    missed = re.fullmatch(r"no (?!more\b)(.+ (?:tonight|today))", folded)
    if missed is not None and (skipped := _read_until(missed[1], whole, reads)) is not None:
        return replace(skipped, is_sure=False)
    tonight = re.fullmatch(rf"(?:don't|do not) {_THIS_DAY.pattern}", folded)
    if tonight is not None:
        return ChangeOrders("skip", tonight["rest"], day=TODAY, until_words="today", is_sure=False)
    denied = _NOT_ANY_MORE.fullmatch(folded)
    if denied is not None and reads(denied["what"], in_chinese=False):
        return ChangeOrders("remove", denied["what"])
    if denied is not None and _IN_A_PART.fullmatch(denied["what"]):
        return ChangeOrders("remove", denied["what"], is_sure=False)
    return None


def _read_until(rest: str, whole: ReadsWhole, reads: ReadsTiming) -> ChangeOrders | None:
    """Read "the evening check until Monday", "my reminders for a week", "the check tonight"."""
    this_day, found = _THIS_DAY.fullmatch(rest), _UNTIL.fullmatch(rest)
    if this_day is not None:
        named = _read_named("skip", this_day["rest"], reads)
        return None if named is None else replace(named, day=TODAY, until_words="today")
    if found is not None:
        named = _read_named("pause", found["rest"], reads)
        until = _end_of(whole, found["t"], found["for"])
        words = found["words"]
    else:
        return None
    if named is None or until is None:
        return None
    return replace(named, until=until, until_words=words)


def _end_of(whole: ReadsWhole, until: str | None, lasts: str | None) -> DayTime | InRule | None:
    """Return when a pause ends: a day alone is its beginning."""
    leads = ("", "on ", "at ") if until is not None else ("in ",)
    words = until if until is not None else lasts or ""
    return next((t for lead in leads if (t := _instant_of(whole(lead + words, in_chinese=False)))),
                None)  # fmt: skip


def _instant_of(parts: tuple[Part, ...]) -> DayTime | InRule | None:
    days_alone = parts and all(isinstance(part, (OnceDay, MonthDay)) for part in parts)
    timing = combine((*parts, TimeOfDay(0, 0, sure=True)) if days_alone else parts)
    when = timing.when if timing is not None else None
    return when if isinstance(when, (DayTime, InRule)) else None


_ONE = re.compile(r"reminder|alarm|timer|(?:standing|recurring|scheduled|daily) (?:order|task|job)")


def _read_named(act: Act, rest: str, reads: ReadsTiming) -> ChangeOrders | None:
    found = _NAMED.fullmatch(rest)
    if found is None:
        return None
    kind = found["kind"] or found["kind2"] or ""
    names = ("of", "what", "often", "id", "one", "called")
    which = next((found[name] for name in names if found[name]), "")
    if re.search(r"\bor\b", which) is not None:
        return None  # a choice
    if found["one"] and not reads(found["one"], in_chinese=False):
        return None
    alone = bool(found["kind"]) and not which and _ONE.fullmatch(kind) is not None
    return ChangeOrders(
        act, which.strip(), reminders="reminder" in kind, is_single=alone and not rest.startswith(("all", "every", "each")),
        is_sure=not found["called"],
    )  # fmt: skip


def _read_chinese(folded: str, reads: ReadsTiming, whole: ReadsWhole) -> ChangeOrders | None:
    reminding = _ZH_REMIND.fullmatch(folded)
    if reminding is not None:
        return ChangeOrders("remove", reminding["of"] or "", reminders=True)
    timed = _zh_until(folded, reads, whole)
    if timed is not None:
        return timed
    for act, before, behind in _ZH_ACTS:
        found = re.fullmatch(
            rf"(?:{before})(?P<a>.+)|把(?P<b>.+?)(?:都)?(?:{behind})(?:了|吧)?", folded
        )
        named = _zh_named(act, found["a"] or found["b"], reads) if found is not None else None
        if named is not None:
            return named
    unwanted = re.fullmatch(
        r"(?P<of>.{1,20}?)的?(?:那|这)一?[个条项](?:就)?(?:不要|不用|不需要|取消|删掉|去掉)了?",
        folded,
    )
    if unwanted is not None:
        return ChangeOrders(
            "remove", unwanted["of"], is_sure=reads(unwanted["of"], in_chinese=True)
        )
    denied = re.fullmatch(rf"{_ZH_NOT}(?P<what>.+?)了", folded)
    if denied is not None and reads(denied["what"], in_chinese=True):
        return ChangeOrders("remove", denied["what"])
    return _zh_denied(folded, whole)


_ZH_ANYTHING = re.compile(r"(?:说|做|弄|去|来|动|跑|走|吵|闹|出声|说话|乱跑|到处跑|乱动)")
"""What no order is called by: 晚上就别说了 is about talk, not about an order of the evening."""
_ZH_GENERAL = re.compile(r"(?:提醒|叫|喊|做|去|来|说|弄)(?:我们?)?")


def _zh_denied(folded: str, whole: ReadsWhole) -> ChangeOrders | None:
    """Read 晚上别再检查门了: not "tonight", which is one day's."""
    found = re.fullmatch(rf"(?:以后|今后)?(?P<t>.+?)(?:以后|今后)?(?:都|就)?{_ZH_NOT}(?P<what>[^别不了用要必需].*?)了?",
                         folded)  # fmt: skip
    if found is None or not re.search(r"再|以后|今后|了$", folded):
        return None
    parts = whole(found["t"], in_chinese=True)
    clocked = any(isinstance(part, TimeOfDay) for part in parts)
    if clocked and re.match(rf"{re.escape(found['t'])}(?:以后|今后)", folded):
        return None  # 晚上十点以后别说了: an hour from which it is not done
    days = [part for part in parts if isinstance(part, WeekDays) and part.days != EVERY_DAY]
    if days and len(days) == len(parts) and _ZH_GENERAL.fullmatch(found["what"]):
        return None  # 周末就别提醒了: days that the order of a moment ago leaves out
    if _ZH_ANYTHING.fullmatch(found["what"]) and all(isinstance(p, DayPart) for p in parts):
        return None
    one_day = any(isinstance(part, (OnceDay, MonthDay)) for part in parts)
    if not parts or one_day:
        return None
    again = not all(isinstance(part, (DayPart, TimeOfDay)) for part in parts)
    return ChangeOrders("remove", f"{found['t']}{found['what']}", is_sure=again)


_ZH_LASTS = r"[半一二三四五六七八九十两\d]{1,3}个?(?:分钟|小时|钟头|天|周|星期|礼拜)"
_ZH_UNTIL = re.compile(
    rf"(?:把)?(?P<a>.+?)暂停(?:到(?P<t>.+?)(?:为止)?|(?P<for>{_ZH_LASTS}))"
    rf"|暂停(?P<b>.+?)(?:(?:直到|到)(?P<t2>.+?)(?:为止)?|(?P<for2>{_ZH_LASTS}))"
)
_ZH_TODAY = re.compile(
    r"(?:把)?(?:今晚|今天|今早)的?(?P<a>.{1,20}?)(?:跳过|免了)(?:一次)?|跳过(?:今晚|今天|今早)的?(?P<b>.{1,20})"
    r"|(?:今晚|今天|今早)(?:就|先)?(?:不用|不要|不必|别)再?(?:提醒我)?(?P<c>.{1,20}?)了?"
)


def _zh_until(folded: str, reads: ReadsTiming, whole: ReadsWhole) -> ChangeOrders | None:
    """Read 把每晚的检查暂停到周一, 暂停提醒一周, 今晚不用检查门了."""
    today = _ZH_TODAY.fullmatch(folded)
    if today is not None:
        which = today["a"] or today["b"] or today["c"]
        return ChangeOrders("skip", which, day=TODAY, until_words="今天", is_sure=False)
    found = _ZH_UNTIL.fullmatch(folded)
    if found is None:
        return None
    until, lasts = found["t"] or found["t2"], found["for"] or found["for2"]
    words = until if until is not None else f"{lasts}后"
    end = _instant_of(whole(words, in_chinese=True))
    named = _zh_named("pause", found["a"] or found["b"], reads)
    if named is None or end is None:
        return None
    said = f"到{until}" if until is not None else lasts
    return replace(named, until=end, until_words=said)


def _zh_named(act: Act, words: str, reads: ReadsTiming) -> ChangeOrders | None:
    named = _zh_which(words, reads)
    if named is not None:
        is_one = act == "remove" and not named[0] and re.match(_ZH_EVERY, words) is None
        return ChangeOrders(act, named[0], reminders=named[1], is_single=is_one)
    called = re.fullmatch(r"(?P<of>.{1,20}?)的?(?:那|这)一?[个条项]", words)
    return None if called is None else ChangeOrders(act, called["of"], is_sure=False)


_ZH_EVERY = r"所有|全部|一切|这些"


def _zh_which(words: str, reads: ReadsTiming) -> tuple[str, bool] | None:
    """Return which orders are meant, and whether only reminders; None where none is named."""
    kind = re.fullmatch(rf"{ZH_ALL}(?P<of>.*?)的?(?P<kind>{ZH_KINDS})", words)
    if kind is not None:
        return kind["of"].strip("的"), kind["kind"] == "提醒"
    by_id = re.fullmatch(r"(?:任务|提醒)?(o\d{1,6})", words)
    if by_id is not None:
        return by_id[1], False
    often = re.match(_ZH_OFTEN, words)
    return (words, False) if often is not None or reads(words, in_chinese=True) else None
