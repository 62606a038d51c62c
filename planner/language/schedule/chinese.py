"""Find the parts of a time in a Chinese sentence, and its words about standing orders.

All patterns read simplified characters without spaces.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.numbers import ZH_DURATION, chinese_number, seconds
from planner.language.schedule.parts import (
    EVERY_DAY,
    WEEKEND,
    WORKDAYS,
    After,
    DayPart,
    EventPart,
    Interval,
    MonthDay,
    OnceDay,
    Part,
    TimeOfDay,
    WeekDays,
    after_of,
    hour_in,
    interval_of,
)
from planner.plan.timing import WorldEvent

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.language.schedule.parts import PartForm

KIN = (
    r"(?:和|跟|与|家|爸|妈|爹|娘|爷|奶|姥|外[公婆]|阿[公婆姨爷嬷]|儿子|女儿|闺女|孩子|小孩|宝|囡|孙|老[公婆爸妈]|丈夫|妻子"
    r"|哥|姐|弟|妹|叔|姑|舅|婶|姨|室友|同学|朋友|的|们的|们家)"
)
"""Behind 我 these are who is meant: 叫我儿子起床 wakes the son, 叫我起床 the one who speaks."""
GAP = re.compile(r"[,、]*(?:的时候|的)?[,、]*")
_PARTS = {
    "清晨": DayPart.MORNING, "早上": DayPart.MORNING, "早晨": DayPart.MORNING, "早": DayPart.MORNING,
    "上午": DayPart.MORNING, "中午": DayPart.NOON, "正午": DayPart.NOON, "下午": DayPart.AFTERNOON,
    "傍晚": DayPart.EVENING, "晚上": DayPart.EVENING, "晚": DayPart.EVENING, "夜里": DayPart.NIGHT,
    "夜间": DayPart.NIGHT, "夜晚": DayPart.NIGHT, "深夜": DayPart.NIGHT, "半夜": DayPart.NIGHT,
    "凌晨": DayPart.NIGHT,
}  # fmt: skip
_P = "|".join(sorted(_PARTS, key=len, reverse=True))
_N = r"\d{1,2}|[零一二三四五六七八九十两]{1,3}"
_MINUTES = r"零[一二三四五六七八九]|[一二三四五]?十[一二三四五六七八九]?|\d\d|(?:\d|[一二三四五六七八九])(?=分)"
"""七点一定去 is no minute past seven."""
_DAY = r"[一二三四五六日天](?![点时:])"
"""Of 周二和周四五点 the five is an hour."""
_WEEK = r"(?:周|星期|礼拜)"
_WEEKDAYS = "日一二三四五六"

_ABOUT = r"(?:大概|大约|约莫|约|差不多)?(?:是|在|到)?"
_CLOCK = re.compile(
    rf"(?:在|到)?(?P<part>{_P})?{_ABOUT}(?:(?P<h>\d{{1,2}})[:](?P<m>\d{{2}})"
    rf"|(?P<oh>{_N})(?:点(?:来?钟)?|时)(?:整|(?P<half>半)|(?P<q>一刻|三刻)|(?P<om>{_MINUTES})分?)?)(?:左右|前后|的样子)?"
    rf"|(?P<noon>(?:中午|正午)(?:十二点)?)|(?P<midnight>午夜|半夜十二点)"
)
_BEDTIME = re.compile(
    r"(?:在)?(?:(?P<once>今晚|今天晚上)|(?P<again>每天(?:晚上)?|每晚|天天(?:晚上)?)|晚上|夜里)?(?:我们?|大家|全家)?(?:上床)?睡(?:觉)?(?:之|以)?前(?!的|故事)"
)
"""Told as the usual hour of the night."""
_DAYPART = re.compile(rf"(?:在)?(?P<part>{_P})")
_EVERY = re.compile(
    rf"(?:每一?天|每日|天天|日日)(?P<part>{_P})?(?![一二两三四五六七八九十\d]?个)|每个?(?P<eve>{_P})"
    r"|每?个?(?P<work>工作日)|每?个?(?P<end>周末)"
)
_WEEKLY = re.compile(
    rf"(?:每个?{_WEEK}|逢{_WEEK})(?P<days>{_DAY}(?:(?:、|,|和|及|跟|与)?(?:每个?)?(?:{_WEEK})?{_DAY})*)"
)
_WEEK_SPAN = re.compile(
    rf"(?:每个?)?{_WEEK}(?P<first>{_DAY})(?:到|至){_WEEK}?(?P<last>{_DAY})(?:的?每天)?"
)
_HOURLY = re.compile(
    r"每(?:隔|过)?(?:一)?(?:(?P<half>半)?个?(?:小时|钟头)|(?P<quarter>刻钟))(?:一次)?|每个?(?:到)?整点(?:的时候)?|(?:一)?到整点"
)
_EVERY_SO = re.compile(rf"每(?:隔|过)?{ZH_DURATION}(?:一次)?")
_EVERY_ONE = re.compile(r"每(?:(?P<minute>分)钟?|秒钟?)")
_ONE_DAY = re.compile(
    rf"(?P<day>今天|今日|明天|明日|后天|今晚|今夜|明晚|今早|明早)|(?:下个?|这个?|本)?{_WEEK}(?P<week>{_DAY})"
)
_AHEAD = {"今": 0, "明": 1, "后": 2}
_LASTS = rf"(?:(?P<and>{_N})个半(?:小时|钟头)|半个?(?P<halfhour>小时|钟头)|(?P<quarter>一刻钟)|{ZH_DURATION})"
_IN = re.compile(
    rf"{_LASTS}(?:之后|以后|过后|后)|(?:过|再过){_LASTS.replace('?P<', '?P<x')}(?:之后|以后|后)?"
)

# Days by the calendar: a number alone (五号) is one only where a time follows it: 三号房间 is a room.
_NUM = r"\d{1,2}|[一二三四五六七八九十]{1,3}"
_COUNT = r"\d{1,3}|[一二三四五六七八九十两]{1,3}"
_BEFORE_TIME = r"(?=,|的?(?:清晨|早|上午|中午|正午|下午|傍晚|晚|夜|凌晨|半夜|午夜)|[零一二三四五六七八九十两\d]{1,3}[点:时]|提醒|叫我)"

_DATE = re.compile(
    rf"在?(?:(?P<year>20\d\d)年|(?P<nextyear>明年)|今年)?的?(?P<month>{_NUM})月(?P<day>{_NUM})[号日]"
)
_ISO = re.compile(r"在?(?P<year>20\d\d)-(?P<month>\d\d)-(?P<day>\d\d)")
_OF_MONTH = re.compile(rf"在?(?:(?P<next>下个?月)|这个?月|本月)的?(?P<day>{_NUM})[号日]")
_DAY_NUMBER = re.compile(rf"在?(?P<day>{_NUM})[号日]{_BEFORE_TIME}")
_FEASTS = {"平安夜": (12, 24), "圣诞节": (12, 25), "圣诞": (12, 25), "元旦": (1, 1),
           "情人节": (2, 14), "劳动节": (5, 1), "儿童节": (6, 1), "国庆节": (10, 1),
           "国庆": (10, 1)}  # fmt: skip
"""Those that lie on the same date each year."""
_FEAST = re.compile(
    rf"在?(?P<nextyear>明年)?的?(?P<feast>{'|'.join(_FEASTS)})(?:那天|当天)?{_BEFORE_TIME}"
)
_WEEKDAY = re.compile(rf"在?(?P<which>下下个?|下个?|这个?|本){_WEEK}(?P<day>[一二三四五六日天])")
_LATER = re.compile(
    rf"(?P<n>{_COUNT})(?:(?P<week>个?(?:星期|礼拜)|周)|天)(?:之后|以后|过后|后)"
    rf"|(?:再?过)(?P<n2>{_COUNT})(?:(?P<week2>个?(?:星期|礼拜)|周)|天)(?:之后|以后|后)?"
    r"|(?P<after>大后天)"
)

_OPENS = r"(?:当|只要|一旦|每当|每次|一|要是一)?(?:你)?"
_CLOSES = r"(?:了)?(?P<end>的时候|之后|以后|时|后)?,?(?:你?就|都|请)?"
_SOMEBODY = r"(?:有人|有客人|客人|来人|谁|人)"
_DOOR = r"(?:大门口?|门口|正门|前门|家门|门外|外面|外边|外头)"
_EVENTS: tuple[tuple[str, WorldEvent], ...] = (
    (rf"{_SOMEBODY}(?:一)?从{_DOOR}(?:走)?(?:进来|进门|进屋|回来|过来)", WorldEvent.PERSON_SEEN),
    (rf"(?:家里|家中|{_DOOR})(?:一)?(?:有(?:人|客人)(?:来|进来|进门|上门|敲门进来)|来(?:了)?(?:人|客人))", WorldEvent.PERSON_SEEN),
    (r"(?:有人|有客人|客人)(?:一)?上门|来(?:了)?客人", WorldEvent.PERSON_SEEN),
    (rf"{_SOMEBODY}(?:一)?(?:走)?(?:进来|进门|进屋|回家|回来|到家|来访|来|过来|出现|经过|路过|到|在门口)|(?:屋里|家里)(?:一)?有人", WorldEvent.PERSON_SEEN),
    (r"(?:看到|看见|发现|遇到|见到)(?:有)?人", WorldEvent.PERSON_SEEN),
    (r"(?:有|发现|看到)(?:任何|什么)?(?:动静|东西在?动|移动)", WorldEvent.MOVEMENT),
    (r"(?:电量|电池|电)(?:过|太|很|变|一)?(?:低|不足|不够|快没)|(?:快)?没电|电快(?:用完|没)", WorldEvent.BATTERY_LOW),
    (r"(?:任务|目标)(?:失败|没完成|出错)", WorldEvent.GOAL_FAILED),
    (r"(?:任务|目标)(?:完成|结束|做完)", WorldEvent.GOAL_DONE),
    (r"(?:回到|到)(?:了)?(?:家|充电[座桩])", WorldEvent.ARRIVED_HOME),
)  # fmt: skip


POLITE = re.compile(
    r"(?:请问?|麻烦|劳驾|拜托|机器人|小车|喂|嗨|你好|帮我|我要你|我想让你|我想要你|我希望你|你要|你得|你"
    r"|记得|记住|以后|往后|今后|从今天起|从现在起|那|(?:再|另外|还)要?(?:加|来|设|定|添)(?:上)?一?个(?:提醒|闹钟)?|,)+"
)
POLITE_END = re.compile(r"(?:吧|啊|呀|哦|哈|呗|嘛|哟|喽|好吗|行吗|可以吗|谢谢你?|,|一下)+$")
ASKS = re.compile(
    r".*(?:吗|(?<![里上下中着儿边])呢)$|(?![^说]*说).*(?:什么|[干做忙]啥|干嘛了|看[到见]谁|几次|多少次|哪里|哪儿|怎么|为何|是不是|哪些|哪个)"
    r"|.*(?:有没有.*过|(?:去|来|到|看|见|做|干|找|数)到?过.*没有?$|来着$)|(?:如果|要是|假如|除非)"
)
QUESTION = TELL = re.compile(
    r"(?:我们?|你们?|[他她]们?|咱们?|大家|家[里人]|还|都|会|也|有)*(?:[有是]没有?|(?P<a>[\u4e00-\u9fff])不(?P=a)|谁|几[点个时]|多少|何时)"
)
"""How what asks about a day begins: 今天几点开会, 明天要不要带伞."""
REMARK = re.compile(
    r".{0,4}天气|是|真|很|太|有[点些]|挺|非常|好(?:热|冷|累|忙|美|开心|高兴|漂亮)|会?下[了着]?[雨雪]"
    r"|我们?(?:好|很|真|太|有[点些]|挺|非常|不|是|在|刚)|(?:星期|周|礼拜)几|几[号月]|放假|休息"
    r"|再?见[了吧啦]?$|再(?:说|聊)"
)
"""How what is no order begins, beside a time: 今天天气真好, 今晚有点冷."""
REMIND = re.compile(
    rf"(?:再)?来?(?:提醒(?:一下)?我(?:一下|一声)?|(?P<wake>叫醒我们?)|(?:叫|喊)我们?(?!{KIN}|们)(?:一声|一下|一次)?)"
)
TIMELESS = re.compile(r"(?:再)?提醒(?:一下)?我(?:一下|一声)?(?!.?$)(?!了|过|的|说)")
OF = re.compile(r"[,:]*(?:要|该|说)?[,:]*")
WAKE_UP = "该起床了"
LEAD = re.compile(r"[,:、]*(?:就|都|要(?!是)|再|请|帮我|你|给我)*")


_EVENING_FROM = 5
"""An evening's hour before it lies on the next day, which the part of the day tells."""


def _clock(found: re.Match[str]) -> tuple[Part, ...]:
    if found["noon"]:
        return (TimeOfDay(12, 0, sure=True),)
    if found["midnight"]:
        return (TimeOfDay(0, 0, sure=True),)
    hour = _number(found["h"] or found["oh"])
    minute = _minute(found)
    if hour is None or minute is None or not (hour < 24 and minute < 60):
        return ()
    if found["part"]:
        part = _PARTS[found["part"]]
        at = TimeOfDay(hour_in(hour, part) % 24, minute, sure=True)
        return (at, part) if part is DayPart.EVENING and at.hour < _EVENING_FROM else (at,)
    return (TimeOfDay(hour, minute, hour > 12 or hour == 0),)


def _minute(found: re.Match[str]) -> int | None:
    if found["m"]:
        return int(found["m"])
    if found["half"]:
        return 30
    if found["q"]:
        return 15 if found["q"] == "一刻" else 45
    return _number(found["om"].removeprefix("零")) if found["om"] else 0


def _number(word: str) -> int | None:
    value = float(word) if word.isdigit() else chinese_number(word)
    return None if value is None else int(value)


def _every(found: re.Match[str]) -> tuple[Part, ...]:
    if found["work"]:
        return (WeekDays(WORKDAYS),)
    if found["end"]:
        return (WeekDays(WEEKEND),)
    part = found["part"] or found["eve"]
    return (WeekDays(EVERY_DAY), _PARTS[part]) if part else (WeekDays(EVERY_DAY),)


def _weekly(found: re.Match[str]) -> tuple[Part, ...]:
    named = re.findall(_DAY, found["days"])
    return (WeekDays(frozenset(_WEEKDAYS.index(day.replace("天", "日")) for day in named)),)


def _bedtime(found: re.Match[str]) -> tuple[Part, ...]:
    """Take it for tonight's where no day stands before it."""
    if found["again"]:
        return (WeekDays(EVERY_DAY), DayPart.NIGHT)
    before = found.string[: found.start()]
    bare = not before or before.endswith((",", ":"))
    return (OnceDay(ahead=0), DayPart.NIGHT) if found["once"] or bare else (DayPart.NIGHT,)


def _week_span(found: re.Match[str]) -> tuple[Part, ...]:
    first, last = (_WEEKDAYS.index(found[n].replace("天", "日")) for n in ("first", "last"))
    days = [(first + i) % 7 for i in range((last - first) % 7 + 1)]
    return (WeekDays(frozenset(days)),) if first != last else ()


def _one_day(found: re.Match[str]) -> tuple[Part, ...]:
    if found["week"]:
        sunday_first = _WEEKDAYS.index(found["week"].replace("天", "日"))
        return (OnceDay(weekday=(sunday_first - 1) % 7),)
    day = found["day"]
    part: tuple[Part, ...] = ()
    if day[1] in "晚夜":
        part = (DayPart.EVENING,)
    elif day[1] == "早":
        part = (DayPart.MORNING,)
    return (OnceDay(ahead=_AHEAD[day[0]]), *part)


def _event(event: WorldEvent) -> Callable[[re.Match[str]], Part | None]:
    def make(found: re.Match[str]) -> Part | None:
        """Take it where a word says "when" or "then": 有人来 alone tells a fact."""
        ends = found.group().endswith((",", "就", "都"))
        return (
            EventPart(event) if found["open"].removesuffix("你") or found["end"] or ends else None
        )

    return make


def _whole(word: str) -> int:
    return _number(word) or 0


def _read_date(found: re.Match[str]) -> tuple[Part, ...]:
    group = found.groupdict()
    year = int(group["year"]) if group["year"] else None
    ahead = 1 if group.get("nextyear") else None
    return (MonthDay(_whole(found["day"]), _whole(found["month"]), year, years_ahead=ahead),)


def _of_month(found: re.Match[str]) -> tuple[Part, ...]:
    return (MonthDay(_whole(found["day"]), months_ahead=1 if found["next"] else 0),)


def _read_day_number(found: re.Match[str]) -> tuple[Part, ...]:
    return (MonthDay(_whole(found["day"])),)


def _feast(found: re.Match[str]) -> tuple[Part, ...]:
    month, day = _FEASTS[found["feast"]]
    ahead = 1 if found["nextyear"] else None
    return (MonthDay(day, month, years_ahead=ahead, coming=True),)


def _that_weekday(found: re.Match[str]) -> tuple[Part, ...]:
    weekday = (_WEEKDAYS.index(found["day"].replace("天", "日")) - 1) % 7
    return (OnceDay(weekday=weekday, week=found["which"].count("下")),)


def _days_on(found: re.Match[str]) -> tuple[Part, ...]:
    if found["after"]:
        return (OnceDay(ahead=3),)
    week = found["week"] or found["week2"]
    days = _whole(found["n"] or found["n2"]) * (7 if week else 1)
    return (After(days * 86_400.0, days),) if days > 0 else ()


PARTS: tuple[PartForm, ...] = (
    *(
        (re.compile(rf"(?P<open>{_OPENS})(?:{pattern}){_CLOSES}"), _event(event))
        for pattern, event in _EVENTS
    ),
    (_BEDTIME, _bedtime),
    (_DATE, _read_date),
    (_ISO, _read_date),
    (_OF_MONTH, _of_month),
    (_DAY_NUMBER, _read_day_number),
    (_FEAST, _feast),
    (_WEEKDAY, _that_weekday),
    (_LATER, _days_on),
    (_IN, lambda found: after_of(found, _number)),
    (
        _HOURLY,
        lambda found: Interval(60.0 * (15 if found["quarter"] else 30 if found["half"] else 60)),
    ),
    (_EVERY_SO, lambda found: interval_of(seconds(found["number"], found["unit"]))),
    (_EVERY_ONE, lambda found: Interval(60.0 if found["minute"] else 1.0)),
    (_WEEK_SPAN, _week_span),
    (_WEEKLY, _weekly),
    (_EVERY, _every),
    (_ONE_DAY, _one_day),
    (_CLOCK, _clock),
    (_DAYPART, lambda found: _PARTS[found["part"]]),
)
"""What begins a part, and the parts that it makes; none: it is none after all."""
