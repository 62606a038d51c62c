"""Own the Chinese questions about before. Whole sentences, never a part of one.

Matched against normalised text whose place names are marks, without courtesy, time and question
mark; ``what`` is a thing, a person or what was told of.
"""

from __future__ import annotations

import re

from planner.language.grammar.lexicon import MARK

LEAD = re.compile(
    r"(?:请问|请|麻烦|喂|嘿|机器人|小车|,|那|那么)*(?:(?:你)?(?:能不能|能|可以)?(?:告诉|跟|和"
    r"|给)我(?:说说|讲讲|说|讲)?(?:一下)?[,:]?)?"
)
REMEMBERS = re.compile(r"(?:你|您)?(?:还)?(?:记不记得|记得)")
TAIL = re.compile(
    r"(?:(?:,(?:你|您)?还?(?:知道|记得|晓得)(?:吗|么|不|没)?)|[吗呢啊呀吧,]|(?<!什)么|谢谢)+$"
)
SPANS = (
    (
        "hour",
        (
            r"(?:在)?(?:最近|过去|刚才)?(?:的)?(?:这)?(?:一|1)个?(?:多)?小时(?:内|里|以内|之内)?"
            r"|刚才|刚刚|方才"
        ),
    ),
    ("morning", r"今天(?:早上|上午|早晨)|今早|(?:今天)?一早|早上|上午"),
    ("afternoon", r"今天(?:下午|中午)|下午"),
    ("night", r"昨天?(?:晚上?|夜里?)|昨夜"),
    ("evening", r"今天?(?:晚上?|夜里?)|晚上"),
    ("yesterday", r"昨天(?:早上|上午|下午)?"),
    ("today", r"今天"),
    ("week", r"(?:这|本)(?:一?周|个?星期)|(?:最近|这)几天|最近"),
)
_IN = r"(?:里面|里边|里头|里|内|上面|上|那里|那边|那儿|旁边)?"
_AT = rf"(?:在|到|去|往|进)?(?P<at>{MARK}){_IN}"
_HERE = r"(?:在)?(?P<here>这里|这儿|这个房间)"
_WHERE = rf"(?:(?:{_AT}|{_HERE})(?:里)?)?"
_YOU = r"(?:你|您)?(?:都|曾经?|有)?"
_SEE = r"(?:看到|看见|见到|碰到|遇到|发现|瞧见|见)"
_ASK = r"(?:在)?(?:什么时候|啥时候|几时|何时|哪里|哪儿|什么地方|哪个房间|哪个屋|几点)"
_WHAT = r"(?P<what>[^,;:.!?谁]{1,24}?)"
_LAST = r"(?:最后一?[次回]|最后|上一?次|最近一次)"
THING = re.compile(
    rf"{_YOU}(?:是)?{_LAST}(?:是)?(?:{_ASK})?{_WHERE}{_SEE}(?:过|了"
    rf"|到)?{_WHAT}(?:是)?(?:{_ASK})?的?"
    rf"|{_YOU}(?:是)?{_ASK}{_LAST}?{_SEE}(?:过|了|到)?{_WHAT.replace('what', 'b')}的?"
    rf"|{_WHAT.replace('what', 'f')}(?:之前|原来|本来|刚才|当时)(?:是)?(?:放)?在(?:哪里|哪儿|哪"
    rf"|什么地方)"
)
SEEN = re.compile(
    rf"(?:我们?的|那个?)?{_WHAT.replace('what', 'b')},?(?:你|您)(?:有没有|{_ASK})?{_SEE}(?:过"
    rf"|到)了?(?:没有?)?"
    rf"|(?:你|您){_SEE}(?!什么|啥|些|谁|了|过|我(?:了|没)){_WHAT.replace('what', 'c')}(?:了)?"
    r"(?:没有|没)"
    rf"|{_YOU}{_WHERE}(?:有没有)?{_SEE}(?:过|了)(?!什么|啥|些|谁){_WHAT}(?:没有|没)?"
)
"""Whether it was seen at all: answered from memory."""
NOW = re.compile(
    rf"{_WHAT}(?:现在|一般|平时|通常)?(?:是|都|我|我们|咱们?)*(?:(?:放)?在|[放搁丢落][在到]?)(?:哪里|哪儿|哪|什么地方)(?:了)?"
    rf"|我把{_WHAT.replace('what', 'b')}(?:放|丢|落|搁)(?:在|到)?(?:哪里|哪儿|哪|什么地方)"
    r"(?:了)?(?:不|没)?"
    rf"|(?P<here>[这那](?:里|儿|边|个)?)(?:是|归)谁的{_WHAT.replace('what', 'g')}"
    rf"|{_WHAT.replace('what', 'c')}(?:是|归)谁的|(?:你|您)?(?:知道|晓得)?(?P<d>我(?:叫|的名字叫?"
    rf"|最喜欢的?))(?:是)?(?:什么|啥)"
    r"(?:名字|颜色|东西)?"
    rf"|{_WHAT.replace('what', 'e')}(?:的)?(?:哪天|什么时候|啥时候|几点|几号|星期几"
    r"|周几)(?:会)?(?:来|到)"
)
"""Asked of now: answered from memory where it knows something, else it is offered to look."""
ANYTHING = re.compile(
    rf"{_YOU}{_WHERE}{_SEE}(?:过|了)?(?:些)?(?:什么|啥)(?:东西)?(?:了)?"
    rf"|{_AT.replace('at', 'at2')}(?:都)?(?:有|有过|放着)(?:些)?(?:什么|啥)(?:东西)?(?:来着)?"
    r"|发生(?:了|过)(?:些)?什么(?:事)?"
    rf"|{_YOU.replace('有', '')}{_WHERE.replace('at', 'at3').replace('here', 'here3')}"
    rf"(?P<asks>有没有|有){_SEE}(?:过|了)?(?:些)?(?:什么|啥)(?:东西|异常|情况|新的?)?(?:没有|没)?"
)
_SOMEBODY = r"(?:有谁|谁|有没有人|是否有人|有人|什么人|哪些人|有没有谁|有客人)"
_COME = r"(?:来|去|到|进|进来|进入|经过|路过|待|呆)"
PERSON = re.compile(
    rf"(?:(?:是)?(?:什么时候|何时|几点)(?:还)?)?(?:都)?(?P<who>{_SOMEBODY})(?:曾经?|都)?"
    rf"(?:(?P<past>{_COME}(?:过|了|到过)?|在过|在|待过)(?:了)?)?{_WHERE}(?P<past2>过|了|来着)?"
    rf"|{_AT.replace('at', 'at2')}(?P<who2>{_SOMEBODY})(?P<past3>{_COME}?过|{_COME}了|在)"
    rf"|{_YOU}{_WHERE.replace('at', 'at3').replace('here', 'here3')}{_SEE}(?:过|了)(?P<who3>谁"
    rf"|哪些人|什么人)"
)
PAST = re.compile(r"过|了|什么时候|何时|几点|来着")
"""What makes a question about people one about before; else it is about now."""
DEEDS = re.compile(
    r"(?:你|您)?(?:都|在)?(?:做|干|忙)(?:了|过|的)?(?:些)?(?:什么|啥|哪些)(?:事情?|工作"
    r"|活儿?)?(?:了|来着)?"
    r"|(?:你|您)?(?:都)?(?:干|做)(?:嘛|什么|啥)(?:去)(?:了|啦)"
    r"|(?:你|您)?(?:都)?(?:去|到)(?:了|过)(?:些|哪些)?(?:哪里|哪儿|哪些地方|什么地方|哪)"
    r"|(?:你|您)(?:今天)?(?:怎么)?过得怎么样"
)
VISITS = re.compile(rf"(?:(?:你|您)(?:有没有)?|有没有)(?:去|到)(?:过|了){_AT}(?:没有?)?")
"""Asks whether it was at a place."""
TOLD = re.compile(
    rf"我(?:都)?(?:跟|对|和|向)?(?:你|您)?(?:说|讲|告诉|教)(?:过|了)?(?:你|您)?(?:些|有关"
    rf"|关于)?(?:过)?{_WHAT}的?(?:什么|哪些|啥)(?:事|话)?"
    r"|我(?:都)?(?:跟|对|和|向)?(?:你|您)?(?:说|讲|告诉|教)(?:过|了)(?:你|您)?(?:些)?(?:什么"
    r"|哪些|啥)(?:事|话)?"
    rf"|(?:关于|对于|有关){_WHAT.replace('what', 'b')}(?:的事)?,?(?:你|您)(?:还)?(?:都)?(?:知道"
    rf"|记得)(?:些)?(?:什么|啥)"
    rf"|(?:你|您)(?:还)?(?:都)?(?:知道|记得)(?:关于"
    rf"|有关){_WHAT.replace('what', 'c')}(?:的)?(?:什么|哪些|啥)?(?:事)?"
    r"|(?:你|您)?(?:还)?(?:都)?记得(?:些)?(?:什么|啥|哪些事?)"
    rf"|(?:你|您)(?:还)?记得{_WHAT.replace('what', 'd')}(?:的事情?|的话)"
)
KEPT = re.compile(
    rf"(?:你|您)?(?:还)?(?:记不记得|记得){_WHAT}(?:放|是)?(?:在)?(?:哪里|哪儿|哪|什么地方)(?:了)?"
    rf"|我(?:跟|和|对|给)?(?:你|您)?(?:说|讲|提)过{_WHAT.replace('what', 'b')}(?:放|是)?在"
    r"(?:哪里|哪儿|哪|什么地方)(?:了)?(?:没有|没)?"
)
"""Asks what it remembers of where a thing is."""
ARTICLE = re.compile(r"^(?:我们?的?|你的|那个?|这个?|一个|一只|一把)(?=.)|的$")
SOMEBODY = re.compile(r"(?:有人|人|谁|别人|什么人)")
NOTHING = re.compile(
    r"(?:它|他|她|你|我|这|那|什么|哪里|东西)(?:们|个|里|儿)?|.*(?:然后|如果|请|去|来|再).*"
)
