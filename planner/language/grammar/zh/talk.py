"""Own the Chinese words that only talk: questions to the robot, greetings, thanks."""

from __future__ import annotations

from planner.language.grammar.parse_result import Rule, about, on_topic, rule
from planner.language.grammar.small_talk import Topic

_WHO = r"(?:你|您|机器人|小车|我们|我)?(?:现在|目前)?"
_WHERE = (
    rf"{_WHO}(?:在|位于|到)(?:了)?(?:哪里|哪儿|哪|什么地方|哪个房间|什么位置|哪个位置|哪个地方)了?"
    r"|(?:你的|当前|现在的|目前的|你现在的|报告|的)?位置(?:是|在)?(?:哪里|哪儿|哪|什么)?|"
    r"这是(?:哪里|哪儿|哪)"
)
_PLACES = (
    r"(?:你)?(?:都)?(?:知道|认识|能去|可以去|会去)(?:哪些|什么)(?:地方|房间|位置)?"
    r"|有(?:哪些|什么)(?:地方|房间)|去哪(?:里|儿)?"
)
_HELP = (
    r"会?做(?:些)?(?:什么|啥)|帮助|有什么(?:功能|本事|本领)|会(?:干|做)?(?:些)?(?:什么|啥)|"
    r"干(?:什么|啥)"
)
TALK: tuple[Rule, ...] = (
    rule(_WHERE, about(Topic.WHERE)),
    rule(_PLACES, about(Topic.PLACES)),
    rule(_HELP, about(Topic.HELP)),
    rule(
        r"(?:(?:机器人|小车|嗨|嘿|喂|哈喽)[,，]?)?(?:你好|您好|嗨|哈喽|早上好|早安|早|上午好|中午好|下午好|晚上好|大家好)"
        r"[呀啊哦]?[,，]?(?:机器人|小车)?",
        about(Topic.HELLO),
    ),
    rule(r"(?:晚安|再见|拜拜)[呀啊哦啦了]*[,，]?(?:机器人|小车)?", about(Topic.BYE)),
    rule(
        r"(?:谢谢|多谢|感谢|谢啦|谢了)(?:你|您|啦|了|啊|呀|哈|哦|噢|喔)*|(?:你|您)?辛苦(?:你|您|啦|了)*"
        r"|(?:你|您)?(?:干|做|表现)得(?:好|不错|很好|真好|太好了)|(?:你|您)?(?:真|太|好|很)(?:的)?"
        r"(?:棒|聪明|厉害|能干|乖|不错|好|可爱|贴心)(?:了|啦|啊|呀)?|好样的|不错(?:嘛|啊|哦)?"
        r"|没(?:别的)?事(?:儿)?(?:了|啦)|就这些(?:了|吧)?|没有?别的(?:事)?了",
        about(Topic.THANKS),
    ),
    rule(r"(?P<topic>.+)", on_topic),
)
