"""Find the parts of a time in an English sentence, and its words about standing orders.

All patterns read lower case with single spaces. ``PARTS`` are tried in order where a part may begin.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.numbers import EN_DURATION, seconds
from planner.language.schedule.english_dates import DATES
from planner.language.schedule.parts import (
    EVERY_DAY,
    WEEKEND,
    WORKDAYS,
    DayPart,
    EventPart,
    Interval,
    OnceDay,
    Part,
    TimeOfDay,
    WeekDays,
    after_of,
    interval_of,
)
from planner.plan.timing import WorldEvent

if TYPE_CHECKING:
    from planner.language.schedule.parts import PartForm

GAP = re.compile(r"[ ,]*(?:and )?")
"""Between two parts."""
_NUMBERS = ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven",
            "twelve")  # fmt: skip
_HOURS = {word: number for number, word in enumerate(_NUMBERS, 1)}
_MINUTES = {"five": 5, "ten": 10, "fifteen": 15, "twenty": 20, "twenty five": 25, "twenty-five": 25,
            "thirty": 30, "forty": 40, "forty five": 45, "forty-five": 45, "fifty": 50,
            "quarter": 15, "a quarter": 15, "half": 30}  # fmt: skip
_H = rf"\d{{1,2}}|{'|'.join(_NUMBERS)}"
_M = "|".join(sorted(_MINUTES, key=len, reverse=True))


def _half(name: str) -> str:
    """Return the pattern of "pm", with a group of this name."""
    return rf"(?: ?(?P<{name}>[ap])\.?m\b\.?)"


_PART = r"morning|afternoon|evening|night|noon"
_DAYS = ["sunday", "monday", "tuesday", "wednesday", "thursday", "friday", "saturday"]
_DAY = "|".join(_DAYS)
_END = r"(?![\w'])"

_CLOCK = re.compile(
    rf"(?:at |by |(?:when|as soon as|once) it(?:'s| is) )?(?:(?:round )?about |around |roughly |exactly )?(?:(?P<h>\d{{1,2}})[:.](?P<m>\d{{2}}){_half('ap')}?(?: ?h\b)?"
    rf"|(?P<past>{_M}) (?P<way>past|to|after|before) (?P<ph>{_H}){_half('ap4')}?"
    rf"|half (?P<hh>{_H}){_half('ap5')}?(?! (?:hours?|minutes?|metres?|meters?|steps?|of|cups?))"
    rf"|(?P<oh>{_H})(?: (?P<om>{_M}))?(?: ?o'clock{_half('ap2')}?"
    rf"|{_half('ap3')})"
    rf"|(?P<noon>noon|midday|midnight))(?: sharp| or so)?{_END}"
)
_ABOUT = r"(?:(?:round )?about|around|roughly|approximately)"
_ORDERS = (
    r"(?:please|can|could|would|go|have|check|look|see|do|drive|come|remind|say|tell|ask|count|find"
    r"|patrol|make|take|give|you)"
)
_AT = re.compile(
    rf"(?:at (?:{_ABOUT} |exactly )?|{_ABOUT} (?=(?:{_H})(?: (?:{_M}))?(?: or so|[,.;!]|$| {_ORDERS}\b| (?:tomorrow|today|tonight|in the)\b)))"
    rf"(?P<h>{_H})(?: (?P<m>{_M}))?(?: sharp| or so|ish)?{_END}(?! (?:past|to) (?:{_H})\b)"
)
_IN_THE = re.compile(rf"(?:in the (?P<a>{_PART})|at (?P<b>night|noon)){_END}")
_AT_NOON = re.compile(rf"at noon{_END}")
_EVERY = re.compile(
    rf"(?:(?:every|each)(?: single)? (?P<what>(?:day|weekday|workday|working day|weekend)(?= (?P<part>{_PART})\b)?|{_PART})(?(part) (?:{_PART}))"
    rf"|(?P<daily>daily|nightly)|(?:on )?(?P<plural>weekdays|workdays|weekends)|at (?:the )?weekends?)"
    rf"{_END}"
)
_WEEKDAYS = re.compile(
    rf"(?:(?P<every>every|each) |on )(?P<days>(?:{_DAY})s?(?:(?:, ?| and |, and )(?:on )?(?:{_DAY})s?)*)"
    rf"(?: (?P<part>{_PART})s?)?{_END}"
)
_HOURLY = re.compile(
    rf"(?:(?:every|each) (?:(?P<half>half )|(?P<quarter>quarter of ))?(?:an )?hour|hourly){_END}"
)
_EVERY_SO = re.compile(rf"every {EN_DURATION}{_END}")
_EVERY_ONE = re.compile(
    r"(?:every|each)(?: single)? (?:(?P<minute>minute)|second(?=,|[.!]?$| (?:go|say|drive|look|come|turn)\b))"
    rf"{_END}"
)
"""Without a number; "every second day" is another thing."""
_ONE_DAY = re.compile(
    rf"(?:(?P<today>today|this)|(?P<tonight>tonight)|(?P<after>the day after tomorrow)"
    rf"|(?P<tomorrow>tomorrow)|(?:on |next |this |coming )?(?P<day>{_DAY}))(?: (?P<part>{_PART}))?{_END}"
)
_LASTS = (
    rf"(?:(?P<and>an|{_H}) (?:hours? and (?:a half|30 minutes)|and a half hours)|half an hour(?P<halfhour>)"
    rf"|(?:a )?quarter of an hour(?P<quarter>)|{EN_DURATION})"
)
_IN = re.compile(
    rf"(?:in|after) (?:about |around |roughly |just )?{_LASTS}(?:'s? time\b| time\b)?{_END}|{_LASTS.replace('?P<', '?P<x')} from now{_END}"
)

_SOMEBODY = r"(?:somebody|someone|anybody|anyone|a person|people|a visitor|a guest|a human)"
_COMES = (
    r"(?:comes?(?: (?:in|home|inside|by|over|here|back|near|along|up))?"
    r"(?: (?:through |to |at |by |in )?the (?:front |main )?door| (?:in|into|to|inside) the (?:house|flat|apartment|home|building))?"
    r"|enters?(?: the (?:house|home|room|flat))?|arrives?(?: home)?|(?:shows?|turns?) up|appears?|walks? in"
    r"|walks? (?:by|past)|(?:is|'s) (?:here|there|(?:at|outside|in front of) the (?:front )?door)|(?:gets?|is) home)"
    r"(?! (?:(?:in|into|to|from|through|near|by|at|out of|over to) )?(?:the|my|our|your|a|an) )"
)
"""With a place behind it, it is another event: "when somebody comes in the kitchen"."""
_WHEN = r"(?:when(?:ever)?|every time|each time|as soon as|once)"
_EVENTS: tuple[tuple[str, WorldEvent], ...] = (
    (rf"{_WHEN} {_SOMEBODY}(?: |(?=')){_COMES}", WorldEvent.PERSON_SEEN),
    (rf"{_WHEN} you (?:see|spot|notice|meet|detect) {_SOMEBODY}", WorldEvent.PERSON_SEEN),
    (rf"{_WHEN} (?:something|anything) moves|{_WHEN} (?:there is|you (?:see|notice)) (?:any )?"
     r"(?:movement|motion)", WorldEvent.MOVEMENT),
    (rf"{_WHEN} (?:the|your) battery (?:is|gets|runs|becomes) (?:low|(?:almost |nearly )?empty)"
     rf"|{_WHEN} you(?:'re| are)? (?:run(?:ning)? )?(?:low on|out of) (?:battery|power)",
     WorldEvent.BATTERY_LOW),
    (rf"{_WHEN} (?:an?|any|the|your|my) (?:goal|task|drive|order|mission) fails|{_WHEN} something goes "
     r"wrong", WorldEvent.GOAL_FAILED),
    (rf"{_WHEN} (?:an?|any|the|your|my) (?:goal|task|drive|order|mission) (?:is (?:done|finished|over)"
     r"|ends|finishes)", WorldEvent.GOAL_DONE),
    (rf"{_WHEN} you(?:'re| are| get| come| arrive| return)(?: back)? (?:at )?home(?: again)?",
     WorldEvent.ARRIVED_HOME),
)  # fmt: skip


POLITE = re.compile(
    r"(?:(?:please|pls|hey|hi|ok|okay|so|well|you know what|listen|robot|pons|kindly|now|and|then|(?:can|could|would|will)"
    r" you|i(?:'d| would) like you to|i want you to|i need you to|you (?:should|must|have to)"
    r"|make sure (?:to|that you)|from now on|add another(?: one)?|another one|one more(?: thing)?"
    r"|also)[ ,:]+)+"
)
POLITE_END = re.compile(
    r"(?:[ ,]+(?:please|thanks|thank you|robot|for me|from now on|from today|though|mind you"
    r"|will you|would you|can you|if you don't mind|love|mate|dear))+$"
)
ASKS = re.compile(
    r"(?:what|who|whom|whose|where|why|how|which|is|are|was|were|did|does|do (?:you|i|we|they)"
    r"|have (?:you|i|we)|has|had|when (?:did|do|does|is|was|will|are))\b|(?:if|unless|whether)\b"
)
"""A question, or a condition that is no event."""
QUESTION = re.compile(
    rf"{ASKS.pattern}|(?:will|shall|should|could|can|would|may|must|am|have|any\w*)\b(?! you\b)"
)
"""What asks about a day that stands beside it: no deed is put off to that day."""
TELL = re.compile(
    r"(?:tell|show|read|let) (?:me|us)(?: know)? (?:(?:what|who|where|why|how|which|when|if|whether)\b|.* for$)"
)
"""What asks about the day that stands behind it."""
REMARK = re.compile(
    r"(?:not (?:the|my|our|at|in)|see (?:you|ya)|(?:talk|speak|chat) to you"
    r"|it(?:'s| is| was| looks| feels| smells)|is|was|were|i(?:'m| am| was| feel| had)"
    r"|there(?:'s| is| are| was| were)|(?:my|our|the|his|her) [a-z]+ (?:is|are|was|were|has|had))\b"
)
"""How what is no order begins, beside a time: "it's cold tonight", "tomorrow is my birthday"."""
REMIND = re.compile(
    r"(?:(?:remember to )?remind (?:me|us)(?: again)?|don't let me forget|do not let me forget|(?:set|make)(?: me)? an? (?:reminder|alarm|timer)(?: for me)?"
    r"|give (?:me|us) a (?:reminder|nudge|shout|call)|(?:nudge|ping|alert) (?:me|us)|(?P<wake>wake (?:me|us)(?: up)?))(?![\w'])"
)
TIMER = re.compile(
    rf"\b(?P<a>(?:set|start|make)(?: me)? an? (?:timer|alarm)) for (?={EN_DURATION}\b|(?:an? |half an )hour\b)"
    rf"|\b(?P<c>(?:set|make)(?: me)? an? alarm) for (?=(?:{_H})\b)"
    rf"|\b(?P<b>(?:set|start|make)(?: me)? an? )(?P<lasts>(?:{_H}|[a-z]+)[ -](?:minute|hour|second)s?) (?:timer|alarm)(?: for)?\b",
    re.IGNORECASE,
)
"""A timer is "for ten minutes", which come after them."""
TIMELESS = re.compile(
    r"(?:remind me|set a reminder(?: for me)?|give me a reminder)[ ,:]+(?:to|about|of|for)\b"
    r"|(?:don't|do not) let me forget\b"
)
OF = re.compile(r"[ ,:]*(?:(?:to|about|of|that|for|with|saying)(?![\w'])[ ,:]*)?")
WAKE_UP = "time to get up"
LEAD = re.compile(
    r"[ ,:;.-]*(?:(?:then|please|to|and|you (?:should|must|shall)|it is time to)[ ,]+)*"
)


def _clock(found: re.Match[str]) -> Part | None:
    if found["noon"]:
        return TimeOfDay(0 if found["noon"] == "midnight" else 12, 0, sure=True)
    hour_word = found["h"] or found["ph"] or found["oh"] or found["hh"]
    hour, minute = _number(hour_word), 0
    if found["m"]:
        minute = int(found["m"])
    elif found["hh"]:  # "half seven" is 7:30 in English
        minute = 30
    elif found["om"]:
        minute = _MINUTES[found["om"]]
    elif found["past"]:
        minute = _MINUTES[found["past"]]
        if found["way"] in ("to", "before"):
            hour, minute = (hour - 1) or 12, 60 - minute
    half = found["ap"] or found["ap2"] or found["ap3"] or found["ap4"] or found["ap5"]
    if half:
        if not 1 <= hour <= 12:  # "15 pm"
            return None
        hour = hour % 12 + (12 if half == "p" else 0)
    sure = bool(half) or hour > 12 or hour == 0 or (found["m"] and len(hour_word) > 1)
    return TimeOfDay(hour, minute, bool(sure)) if hour < 24 and minute < 60 else None


def _bare(found: re.Match[str]) -> Part | None:
    hour, minute = _number(found["h"]), _MINUTES[found["m"]] if found["m"] else 0
    return TimeOfDay(hour, minute, hour > 12 or hour == 0) if hour < 24 else None


def _number(word: str) -> int:
    return 1 if word == "an" else _HOURS[word] if word in _HOURS else int(word)


def _every(found: re.Match[str]) -> tuple[Part, ...]:
    what = found["what"] or found["daily"] or found["plural"] or "weekend"
    part = (DayPart(found["part"]),) if found["part"] else ()
    if what.startswith(("weekday", "work")):
        return (WeekDays(WORKDAYS), *part)
    if what.startswith("weekend"):
        return (WeekDays(WEEKEND), *part)
    days = WeekDays(EVERY_DAY)
    if part:
        return (days, *part)
    if what in ("day", "daily"):
        return (days,)
    return (days, DayPart("night" if what == "nightly" else what))


def _weekdays(found: re.Match[str]) -> tuple[Part, ...]:
    named = [day for day in _DAYS if day in found["days"]]
    part = (DayPart(found["part"]),) if found["part"] else ()
    nightly = found["part"] and found[0].endswith("s")  # "on Thursday nights"
    if not (found["every"] or nightly or found["days"].endswith("s")):
        if len(named) > 1:
            return ()
        return (OnceDay(weekday=(_DAYS.index(named[0]) - 1) % 7), *part)
    return (WeekDays(frozenset(map(_DAYS.index, named))), *part)


def _one_day(found: re.Match[str]) -> tuple[Part, ...]:
    part: tuple[Part, ...] = (DayPart(found["part"]),) if found["part"] else ()
    if found["today"]:
        return () if found["today"] == "this" and not part else (OnceDay(ahead=0), *part)
    if found["tonight"]:
        return (OnceDay(ahead=0), DayPart.EVENING)
    if found["day"]:
        return (OnceDay(weekday=(_DAYS.index(found["day"]) - 1) % 7), *part)
    return (OnceDay(ahead=1 if found["tomorrow"] else 2), *part)


PARTS: tuple[PartForm, ...] = (
    *((re.compile(rf"(?:{pattern}){_END}"), EventPart(event)) for pattern, event in _EVENTS),
    *DATES,
    (
        _HOURLY,
        lambda found: Interval(60.0 * (15 if found["quarter"] else 30 if found["half"] else 60)),
    ),
    (_EVERY_SO, lambda found: interval_of(seconds(found["number"], found["unit"]))),
    (_EVERY_ONE, lambda found: Interval(60.0 if found["minute"] else 1.0)),
    (_EVERY, _every),
    (_WEEKDAYS, _weekdays),
    (_AT_NOON, TimeOfDay(12, 0, sure=True)),
    (_IN_THE, lambda found: DayPart(found["a"] or found["b"])),
    (_IN, lambda found: after_of(found, _number)),
    (_CLOCK, _clock),
    (_AT, _bare),
    (_ONE_DAY, _one_day),
)
"""What begins a part, and the parts that it makes; none: it is none after all."""
