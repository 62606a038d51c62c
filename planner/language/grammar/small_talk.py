"""Own what the robot can tell without looking: itself, the clock, a joke, and what it can't know.

A topic is a table row: how each language asks for it, and what is said. No network, no model.
"""

from __future__ import annotations

import re
from datetime import datetime
from enum import Enum

from planner.plan import Bilingual


class Topic(Enum):
    """Name what a person may ask the robot to tell."""

    WHERE = "where"
    PLACES = "places"
    HELP = "help"
    HELLO = "hello"
    THANKS = "thanks"
    NAME = "name"
    SELF = "self"
    TEAM = "team"
    MAKER = "maker"
    AGE = "age"
    MOOD = "mood"
    JOKE = "joke"
    TIME = "time"
    DAY = "day"
    MONTH_DAY = "month_day"
    WEATHER = "weather"


_EN: tuple[tuple[Topic, str], ...] = (
    (
        Topic.TEAM,
        (
            r"(?:your|the) (?:team|group|school|university)(?:'s)?(?: (?:name|affiliation|"
            r"country))?"
            r"|your (?:affiliation|country)"
        ),
    ),
    (
        Topic.NAME,
        (
            r"(?:your|the robot's) name|what (?:you are|are you) called|how are you called|"
            r"who you are|"
            r"who are you"
        ),
    ),
    (
        Topic.SELF,
        (r"something(?: about yourself)?|about yourself|what you are|what are you|anything"),
    ),
    (
        Topic.JOKE,
        (
            r"(?:me )?(?:a|another|one|some|any) (?:good |funny |short )?(?:joke|story|riddle)s?|"
            r"something funny"
        ),
    ),
    (
        Topic.TIME,
        (r"(?:the|what) (?:current )?time(?: (?:it is|is it))?(?: now)?|how late (?:it is|is it)"),
    ),
    (
        Topic.MONTH_DAY,
        (
            r"the day of the month|(?:the|what|today's) date(?: (?:is (?:it|today)|"
            r"it is))?(?: today)?"
        ),
    ),
    (
        Topic.DAY,
        (
            r"(?:the |what |which )?day (?:of the week|is (?:today|it|tomorrow)|it is(?: today)?|"
            r"today is)(?: today)?"
            r"|the day|today's day"
        ),
    ),
    (
        Topic.WEATHER,
        (
            r"(?:the |what the |how the |how is the |what is the )?(?:weather|forecast)(?: (?:is|"
            r"like|report))*(?: (?:today|"
            r"outside|tomorrow))?"
        ),
    ),
    (
        Topic.MAKER,
        r"who (?:built|made|created|programmed|designed) you|your (?:maker|creator|inventor)",
    ),
    (Topic.AGE, r"how old (?:are you|you are)|your age"),
    (Topic.MOOD, (r"how (?:are you|you are|do you feel|is it going)(?: (?:doing|today|feeling))*")),
)
_ZH: tuple[tuple[Topic, str], ...] = (
    (Topic.TEAM, (r"你们?的?(?:队伍|团队|学校|单位)(?:的?(?:名字|名称))?(?:是什么|叫什么)?")),
    (
        Topic.NAME,
        (r"你的?(?:名字|姓名)(?:是什么|叫什么)?|你(?:叫|是)(?:什么名字|什么|谁)(?:名字)?"),
    ),
    (
        Topic.SELF,
        (r"(?:介绍)?(?:一下)?你?自己|自我介绍|做?个?自我介绍|(?:点|一点|些)(?:什么|东西)?"),
    ),
    (Topic.JOKE, (r"(?:一?个|点|些)?(?:好笑的|有趣的)?(?:笑话|故事|段子|谜语)")),
    (
        Topic.TIME,
        (
            r"(?:现在|当前|目前|今天)?(?:是)?(?:几点(?:钟)?(?:了)?|什么时间|什么时候了?|"
            r"(?:的)?时间)(?:是多少)?"
        ),
    ),
    (Topic.DAY, (r"今天(?:是)?(?:星期|礼拜|周)几")),
    (
        Topic.MONTH_DAY,
        (r"今天(?:是)?(?:几号|多少号|几月几号|什么日子|(?:的)?日期)(?:是什么)?|日期"),
    ),
    (Topic.WEATHER, (r"(?:今天|明天|现在|外面)?(?:的)?天气(?:怎么样|如何|好吗|预报)?")),
    (
        Topic.MAKER,
        r"(?:是)?谁(?:造|做|创造|发明|设计|开发)(?:了|出)?(?:的)?你(?:的)?|你是谁(?:造|做|开发)的",
    ),
    (Topic.AGE, r"你?(?:今年)?(?:几岁|多大)(?:了)?"),
    (Topic.MOOD, (r"你(?:今天)?(?:还)?(?:好吗|怎么样|好不好|累吗|开心吗)")),
)

_SAID = {
    Topic.HELLO: ("Hello. Tell me where to go.", "你好！请告诉我要去哪里。"),
    Topic.THANKS: ("You are welcome.", "不客气。"),
    Topic.NAME: ("My name is Pons.", "我叫 Pons。"),
    Topic.SELF: (
        "I am Pons, a robot that drives where people ask, and stops when they say so.",
        "我是 Pons，一台按照人的要求行驶、一喊就停的机器人。",
    ),
    Topic.TEAM: (
        "Nobody told me the name of a team; I am Pons.",
        "没有人告诉我团队的名字；我是 Pons。",
    ),
    Topic.MAKER: (
        "The people of the Pons project built me.",
        "我是 Pons 项目的人做出来的。",
    ),
    Topic.AGE: (
        "I am as old as my software: young, and updated now and then.",
        "我和我的软件一样年轻，偶尔会更新。",
    ),
    Topic.MOOD: ("I have no moods, and I am ready to drive.", "我没有心情好坏，随时可以出发。"),
    Topic.JOKE: (
        "Why did the robot cross the road? The route said so, and nobody stood on it.",
        "机器人为什么过马路？因为路线是这么规划的，而且路上没有人。",
    ),
    Topic.WEATHER: (
        "I can't know the weather: I look nowhere but around me.",
        "我不知道天气：我只了解身边的情况。",
    ),
    Topic.HELP: (
        (
            "I drive to rooms and places, turn, wait, come back, and say things. Try: go to the "
            "kitchen, wait ten seconds, then come back."
        ),
        "我会去房间和地点、转身、等待、回来、说话。试试：去厨房，等十秒，然后回来。",
    ),
}
_WEEK_EN = ("Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday", "Sunday")
_WEEK_ZH = "一二三四五六日"
_NO_CLOCK = Bilingual(en="I have no clock to tell it by.", zh="我没有时钟，无法回答。")


def _whole(rows: tuple[tuple[Topic, str], ...]) -> re.Pattern[str]:
    return re.compile("|".join(f"(?P<{topic.value}>{pattern})" for topic, pattern in rows))


_EN_TOPIC, _ZH_TOPIC = _whole(_EN), _whole(_ZH)


_ASKED = re.compile(
    r"^(?:what is|what are|check|do you (?:know|have)|have you got|"
    r"(?:do you )?(?:want to )?tell me|"
    r"tell us|"
    r"i want to know|can you tell me|any|i would like to (?:know|hear)) "
)


def topic_of(words: str) -> Topic | None:
    """Return the topic that a phrase names, in either language."""
    plain = _ASKED.sub("", words)
    found = _EN_TOPIC.fullmatch(words) or _EN_TOPIC.fullmatch(plain) or _ZH_TOPIC.fullmatch(words)
    return Topic(found.lastgroup) if found and found.lastgroup else None


def told(topic: Topic, now: datetime | None) -> Bilingual | None:
    """Return what is said of a topic, or None where that takes more than a table."""
    if topic in (Topic.TIME, Topic.DAY, Topic.MONTH_DAY):
        return _NO_CLOCK if now is None else _clock(topic, now)
    if topic not in _SAID:
        return None
    en, zh = _SAID[topic]
    return Bilingual(en=en, zh=zh)


def _clock(topic: Topic, now: datetime) -> Bilingual:
    if topic is Topic.TIME:
        at = f"{now:%H:%M}"
        return Bilingual(en=f"When you asked it was {at}.", zh=f"您问的时候是 {at}。")
    day = now.weekday()
    if topic is Topic.DAY:
        return Bilingual(en=f"Today is {_WEEK_EN[day]}.", zh=f"今天是星期{_WEEK_ZH[day]}。")
    date = now.date().isoformat()
    return Bilingual(en=f"Today is {date}.", zh=f"今天是{now.year}年{now.month}月{now.day}日。")
