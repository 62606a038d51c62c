"""Own the robot's answers without looking: itself, the clock, a joke, and its limits.

A topic is a table row: how each language asks for it, and what is said. No network, no model.
"""

from __future__ import annotations

import re
from datetime import datetime
from enum import Enum

from planner.language.catalogue import say
from planner.plan import Bilingual


class Topic(Enum):
    """Name what a person may ask the robot to tell."""

    WHERE = "where"
    PLACES = "places"
    HELP = "help"
    HELLO = "hello"
    THANKS = "thanks"
    BYE = "bye"
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
        (r"你的?(?:名字|姓名)(?:是什么|叫什么)?|你(?:叫|是)(?:什么名字|什么|啥|谁)(?:名字)?"),
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
    (
        Topic.MOOD,
        (
            r"(?:(?:机器人|小车)?[,，]?你好[,，]?)?(?:你)?(?:今天|最近)?(?:过得|感觉)?(?:还)?(?:好吗|怎么样|如何|好不好|累吗|开心吗)"
        ),
    ),
)

_SAID = frozenset(
    {
        Topic.HELLO,
        Topic.THANKS,
        Topic.BYE,
        Topic.NAME,
        Topic.SELF,
        Topic.TEAM,
        Topic.MAKER,
        Topic.AGE,
        Topic.MOOD,
        Topic.JOKE,
        Topic.WEATHER,
        Topic.HELP,
    }
)
_NO_CLOCK = say("talk.no_clock")


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


def answer_topic(topic: Topic, now: datetime | None) -> Bilingual | None:
    """Return the text on a topic, or None where that takes more than a table."""
    if topic in (Topic.TIME, Topic.DAY, Topic.MONTH_DAY):
        return _NO_CLOCK if now is None else _clock(topic, now)
    if topic not in _SAID:
        return None
    return say(f"talk.{topic.value}")


def _clock(topic: Topic, now: datetime) -> Bilingual:
    if topic is Topic.TIME:
        at = f"{now:%H:%M}"
        return say("talk.time", at=at)
    if topic is Topic.DAY:
        return say(f"talk.day_{now.weekday()}")
    return say("talk.month_day", year=now.year, month=now.month, day=now.day)
