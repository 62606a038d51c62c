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
    FACES = "faces"
    LANGUAGES = "languages"
    HANDS = "hands"


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
_THING = r"(?:you|it|this (?:thing|robot|one|machine|gadget|little (?:thing|robot|guy))|the robot)"
_EN += (
    (
        Topic.HELP,
        (
            rf"what(?: all| else)? (?:can|could|does) {_THING}(?: (?:actually|really|even"
            rf"|all))*(?: do)(?: (?:then|exactly|anyway"
            r"|for (?:me|us)|around (?:here|the house)|at home|at all|with|besides))*"
            r"|what are you (?:good|useful) (?:for|at)|what are you (?:capable of|able to do"
            r"|here for)(?: then)?"
            r"|what (?:sort|kind|kinds|sorts) of (?:things|stuff|jobs) (?:can|do) you do"
            r"|what can (?:i|we) (?:ask|tell|say to)"
            r" you(?: to do)?|how (?:do|can|should) (?:i|we) use you|how does (?:this(?: thing)?"
            r"|it) work|what you can do"
        ),
    ),
    (
        Topic.FACES,
        (
            r"(?:can|do|would|will) you (?:(?:actually|really|even) )?(?:recogni[sz]e|identify"
            r"|know|remember)"
            r" (?:(?:people's|our|my|a|different|human|peoples) )?(?:faces?|who (?:i am|we are"
            r"|people are|somebody is|someone is)"
            r"|me|us|people by (?:their )?(?:face|name)s?|individual people)(?: or (?:just"
            r"|only) .{3,60})?"
            r"|can you tell (?:us|people|the (?:kids|twins|children)|who is who|who's who"
            r"|who i am|who it is)(?: apart)?"
            r"|do you have face recognition|do you do face recognition"
        ),
    ),
    (
        Topic.LANGUAGES,
        (
            r"(?:can|do|could) you (?:(?:also|even|actually) )?(?:speak|understand|talk|know"
            r"|do) (?:any )?(?:other languages?"
            r"|english|chinese|mandarin|cantonese|spanish|french|german|polish|hindi|arabic|welsh|irish|italian|japanese|korean"
            r"|portuguese|russian|urdu|dutch|turkish)(?: (?:too|as well|at all|by any chance))?"
            r"|(?:what|which|how many) languages? (?:can|do) you (?:speak|understand|know|do)"
        ),
    ),
    (
        Topic.HANDS,
        (
            r"(?:do you have|have you got|where are your|haven't you got"
            r"|don't you have) (?:any )?(?:arms?|hands?)(?: or (?:arms?|hands?))?"
        ),
    ),
)
_ZH: tuple[tuple[Topic, str], ...] = (
    (Topic.TEAM, (r"你们?的?(?:队伍|团队|学校|单位)(?:的?(?:名字|名称))?(?:是什么|叫什么)?")),
    (
        Topic.NAME,
        (r"你的?(?:名字|姓名)(?:是什么|叫什么)?|你(?:叫|是)(?:什么名字|什么|啥|谁)(?:名字)?"),
    ),
    (
        Topic.SELF,
        (r"(?:介绍)?(?:一下)?你?自己|自我介绍|做?个?自我介绍|(?:点儿?|一点儿?|些)(?:什么|东西|啥)"),
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

_ZH += (
    (
        Topic.HELP,
        (
            r"(?:你|这(?:个)?(?:东西|机器人|玩意儿?))?(?:到底|究竟|都|平时)*(?:能|会|可以)(?:帮我们?|帮忙)?(?:干|做)(?:些|点儿?)?(?:什么|啥|嘛)(?:事情?|活)?[呀啊呢]*"
            r"|你有(?:些)?(?:什么|啥|哪些)(?:用|功能|本事|本领)[呀啊呢]*|你(?:怎么|咋)用"
        ),
    ),
    (
        Topic.FACES,
        (
            r"(?:你|您)?(?:能|会|可以)?(?:不能)?(?:认得|认识|认出|认得出|分得清|分清|分得出|识别|记得)(?:出)?(?:我们?|人脸|脸|人的脸|谁是谁|家里(?:的)?人|不同的人|我的脸|我是谁)(?:吗|不|么)?"
            r"|(?:你|您)知道我是谁(?:吗|不)?|你有人脸识别吗"
        ),
    ),
    (
        Topic.LANGUAGES,
        (
            r"(?:你|您)?(?:能|会|可以)?(?:不能)?(?:听得懂|听懂|听不听得懂|懂|会讲|会说|会|讲|说)(?:得)?(?:懂)?(?:广东话|粤语|白话|英语|英文|普通话|国语|中文|闽南语|四川话|上海话|客家话|方言|日语|法语|德语|西班牙语|韩语)(?:吗|不|么)?"
            r"|(?:你|您)(?:会|能|懂)(?:说|讲|听)?(?:什么|哪些|几种|哪几种)(?:语言|话)"
        ),
    ),
    (Topic.HANDS, r"(?:你|您)(?:有没有|有|没有)(?:手|手臂|胳膊)(?:吗|么|啊)?"),
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
        Topic.FACES,
        Topic.LANGUAGES,
        Topic.HANDS,
    }
)
_OF_ITSELF = frozenset({Topic.HELP, Topic.FACES, Topic.LANGUAGES, Topic.HANDS, Topic.NAME})
"""What may be asked beside a word about the person who asks."""
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


_CUT = re.compile(r"\s*[?.!,;:。？！，；]+\s*")
_OPENS = re.compile(r"^(?:(?:so|well|and|but|ok|okay|then|hey|oh|right|那么?|哎|诶|喂)[ ,]*)+")
_ASIDE = re.compile(
    r"(?:i(?:'m| am|'ve| have)?|we(?:'re| are|'ve| have)?|my|it's just|just) (?!.*\b(?:go|come"
    r"|find|look|tell|want you|need you)\b)"
    r"[a-z' ]{3,60}|我(?!要|想让|叫|让)[^去来找看]{1,12}"
)
"""What a person adds of themselves: "I'm just staying the weekend"."""


def topic_of(words: str) -> Topic | None:
    """Return the topic that a phrase, or all clauses of a sentence that ask, name."""
    whole = _topic_of_clause(words) or _topic_of_clause(_OPENS.sub("", words))
    if whole is not None:
        return whole
    clauses = [each for each in _CUT.split(words) if each]
    asked = [_topic_of_clause(_OPENS.sub("", each)) for each in clauses]
    topics = {topic for topic in asked if topic is not None}
    rest = [c for c, topic in zip(clauses, asked, strict=True) if topic is None]
    plain = len(topics) == 1 and len(clauses) <= 3 and all(_ASIDE.fullmatch(c) for c in rest)
    return topics.pop() if plain and topics <= _OF_ITSELF else None


def _topic_of_clause(words: str) -> Topic | None:
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
