"""Find the standing orders that a person means: "the evening check", 吃药, "o3". Pure.

Law: words that fit several orders are asked about, unless all of them were meant; words that fit
none change nothing.
"""

from __future__ import annotations

import re
from datetime import datetime, tzinfo
from typing import TYPE_CHECKING

from planner.language.folding import fold, fold_words, has_chinese
from planner.language.schedule import split_time
from planner.language.schedule.parts import DayPart
from planner.orders.retiming import HOURS_CALLED, fits_time
from planner.orders.rule import next_due
from planner.plan.timing import CronRule

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planner.orders.order import StandingOrder

_WORD = re.compile(r"[a-z0-9:']+")
_LITTLE = frozenset((
    "the", "a", "an", "my", "your", "our", "to", "at", "in", "on", "of", "for", "about", "every",
    "each", "day", "and", "me", "i", "you", "it", "one", "ones", "please", "any", "more",
    "again", "now", "check", "checks", "order", "orders", "reminder", "reminders", "checking",
    "do", "doing", "run", "runs", "trip", "trips", "visit", "visits", "patrol", "patrols",
    "round", "rounds", "task", "tasks", "job", "saying", "when", "if"
))  # fmt: skip
"""Words that name none by themselves; what they name besides is weighed."""
_KIND = frozenset(["check", "checks", "checking", "patrol", "patrols", "round", "rounds"])
_CALLED = re.compile(r"\bwake[- ]?up (?:calls?|alarms?|service)\b")
"""What people call the order to wake them."""
_WAKES = frozenset(("time to get up", "该起床了"))
_LITTLE_ZH = re.compile(r"[的了我你把去来在每天一下个次提醒任务定时,、。]")
_PARTS = {
    DayPart.MORNING: "morning 早上 早晨 上午 每早",
    DayPart.NOON: "noon 中午",
    DayPart.AFTERNOON: "afternoon 下午",
    DayPart.EVENING: "evening 晚上 每晚 傍晚 今晚",
    DayPart.NIGHT: "night nightly 夜里 凌晨",
}
_DAYS = (
    "sunday 周日 星期天 周末 weekend", "monday 周一", "tuesday 周二", "wednesday 周三",
    "thursday 周四", "friday 周五", "saturday 周六 周末 weekend",
)  # fmt: skip


def select(
    orders: Iterable[StandingOrder],
    which: str,
    zone: tzinfo,
    *,
    reminders: bool,
    now_unix_s: float | None = None,
) -> tuple[StandingOrder, ...]:
    """Return the orders that these words may mean, oldest first; all where no words were said."""
    kept = [o for o in orders if not o.ended and (o.reminder is not None or not reminders)]
    words = _CALLED.sub("wake up", fold_words(which))
    if not words:
        return tuple(kept)
    by_id = [order for order in kept if order.id == words]
    if by_id:
        return tuple(by_id)
    parts, rest = split_time(words)

    def fits(order: StandingOrder) -> bool:
        """Return whether words name an order, or a time at which it is due and words beside it."""
        due_s = next_due(order.rule, order.handled_unix_s, zone)
        if _fits(order, words, zone):
            return True
        is_then = fits_time(order.rule, parts, due_s, zone, now_unix_s)
        return is_then and (not _weigh_words(rest) or _fits(order, rest, zone))

    return tuple(filter(fits, kept))


_FIRSTS = (
    ("first", "1st", "第一"), ("second", "2nd", "第二"), ("third", "3rd", "第三"),
    ("fourth", "4th", "第四"), ("fifth", "5th", "第五"),
)  # fmt: skip
_ALL = re.compile(
    r"(?:(?:both|all)(?: of (?:them|these|those))?|every one|全部|所有的?|都|两个都).{0,4}"
)


def pick(found: tuple[StandingOrder, ...], answer: str) -> tuple[StandingOrder, ...]:
    """Return those that an answer to "which one?" picks: by its place in the list, or all."""
    words = fold_words(answer)
    if is_all(answer):
        return found
    for place, names in enumerate(_FIRSTS):
        said = re.fullmatch(rf"(?:the )?(?:{'|'.join(names)})(?: one)?|{names[2]}[个条]?", words)
        if said is not None:
            return found[place : place + 1]
    return found[-1:] if words in ("the last one", "the last", "最后一个") else ()


def is_all(answer: str | None) -> bool:
    """Tell whether an answer means all that were asked about."""
    return answer is not None and _ALL.fullmatch(fold_words(answer)) is not None


def _weigh_words(words: str) -> list[str]:
    if has_chinese(words):
        return [bare] if (bare := _LITTLE_ZH.sub("", words)) else []
    return [word for word in _WORD.findall(words) if word not in _LITTLE]


def _fits(order: StandingOrder, words: str, zone: tzinfo) -> bool:
    hay = f"{fold(order.text)} {fold(order.order)} {_time_words(order, zone)}"
    if order.reminder in _WAKES:  # a changed order has lost the sentence that it was given in
        hay = f"{hay} wake me up alarm 叫醒起床闹钟"
    if has_chinese(words):
        return _fits_chinese(words, hay)
    stems = {_stem(word) for word in _WORD.findall(hay)}
    weighed = _weigh_words(words)
    kinds = [word for word in _WORD.findall(words) if word in _KIND]
    if not weighed:
        return any(_stem(word) in stems for word in kinds)
    return all(_stem(word) in stems for word in weighed)


def _fits_chinese(words: str, hay: str) -> bool:
    """Return whether most of the telling characters stand in the order, two by two."""
    parts = [part for part in words.split("的") if part]
    telling = [(part, _LITTLE_ZH.sub("", part)) for part in parts]
    if not any(bare for _, bare in telling):
        return all(part in hay for part in parts)
    return all(part in hay or _overlaps(bare, hay) for part, bare in telling if bare)


def _overlaps(bare: str, hay: str) -> bool:
    pairs = [bare[at : at + 2] for at in range(len(bare) - 1)]
    most = bool(pairs) and sum(pair in hay for pair in pairs) >= 0.6 * len(pairs)
    return bare in hay or most  # one character alone is no proof


def _stem(word: str) -> str:
    for end in ("ing", "es", "s"):
        if word.endswith(end) and len(word) > len(end) + 1:
            word = word.removesuffix(end)
            break
    if len(word) > 3 and word[-1] == word[-2]:  # "patrolling"
        word = word[:-1]
    return word.removesuffix("e") if len(word) > 3 else word


def _time_words(order: StandingOrder, zone: tzinfo) -> str:
    """Return what people call the time of an order."""
    due_s = next_due(order.rule, order.handled_unix_s, zone)
    if due_s is None:
        return order.rule.kind
    due = datetime.fromtimestamp(due_s, zone)
    words = [f"{due.hour}:{due.minute:02}", f"{due.hour:02}:{due.minute:02}"]
    words += [names for part, names in _PARTS.items() if due.hour in HOURS_CALLED[part]]
    if isinstance(order.rule, CronRule):
        _, hour, _, _, week = order.rule.cron.split()
        words.append("daily 每天 每日" if week == "*" else "weekly 每周 工作日 weekday")
        words += [names for day, names in enumerate(_DAYS) if str(day) in week]
        words += ["hourly hour 每小时"] if hour == "*" else []
    return " ".join(words)
