"""Read Chinese orders: what vetoes a sentence, where clauses end, and what a clause can mean.

A clause is read whole or not at all; the rules name every character that they pass over.
"""

from __future__ import annotations

import re
from re import Match

from planner.brain.offline.grammar import (
    QUOTE,
    Build,
    Grammar,
    about,
    come_back,
    drive_to,
    home,
    lacks,
    next_place,
    route,
    say,
    set_out,
    stand,
    wait,
)
from planner.brain.offline.lexicon import MARK
from planner.brain.offline.meaning import Meaning, Reading, Rule, Steps, Topic
from planner.brain.offline.numbers import ZH_DURATION
from planner.plan import Code, Say

_GO = (
    r"(?:去往|前往|去到|到达|到|开往|开到|开去|驶向|驶往|驶到|走到|走去|走向|跑到|移动到|移动至|移到|移至|"
    r"导航到|导航至|导航去|行驶到|行驶至|返回到|返回|回到|回去|回|进入|进到|进|来到|来|依次访问|访问|参观|抵达|"
    r"依次去|依次到|过去|去)(?:一下|下|一趟|趟|一次)?"
)
_AFTER = r"(?:去|来|过去|待命|停下来?|等我|一下|一趟|走一趟)?"
_LEAD = r"(?:(?:带|领|引导|陪|护送|送)(?:我们|我|大家|他们|他|她))?"
_ORIGIN = (
    r"(?:原地|原位|原处|原来的?(?:地方|位置)|起点|出发点|出发的?地方|起始(?:点|位置)|这里|这儿|"
    r"我这里|我这儿|我这)"
)
_LOOK = (
    r"(?:看|找|寻|查|检查|观察|数|识别|搜|拍|跟着|跟随|跟上|跟我|确认|巡视|描述|瞧|瞅|有没有|有几|有多少|几个|"
    r"问候|迎接|介绍|打量|监控|探索)"
)
_ARM = (
    r"(?:拿|取|递|抓|放(?!映)|搬|送|端(?!口)|捡|拾|夹|提起|抬|打开|关闭|关掉|关上|关门|关灯|关|开门|开灯|开窗|倒水|倒茶|倒掉|"
    r"推|拉|扔|丢|洗(?!衣|手|碗)|擦|扫|拖地|做饭|做晚饭|做早饭|做午饭|做菜|煮|炒|整理|收拾|叠|按下|摆|装(?!货|卸)|盛|喂|浇|"
    r"带(?!我|路|大家|他|她)|交给|给我)"
)
_RELATIVE = (
    r"(?:往|向|朝|沿)(?:着)?.*(?:走|移动|前进|转|开|退|行驶|旋转|挪).*|(?:前进|后退|倒退|倒车|左转|右转|旋转|转|掉头|调头|"
    r"转身|转圈|巡逻|巡检|巡视|绕).*|走\d.*"
)
_TALK = r"(?:说|讲|告诉|回答|问|唱|跳舞|播放|提醒|叫|读|念|介绍).*"
_HELLO = (
    r"你好|您好|大家好|早上好|下午好|晚上好|晚安|再见|拜拜|谢谢|欢迎光临|欢迎|我来了|我到了|"
    r"我回来了"
)
_WHO = r"(?:你|您|机器人|小车|我们)?(?:现在|目前)?"
_WHERE = (
    rf"{_WHO}(?:在|位于|到)(?:了)?(?:哪里|哪儿|哪|什么地方|哪个房间|什么位置|哪个位置|哪个地方)了?"
    r"|(?:你的|当前|现在的|目前的|你现在的|报告|的)?位置(?:是|在)?(?:哪里|哪儿|哪|什么)?|这是(?:哪里|哪儿|哪)"
)
_PLACES = (
    r"(?:你)?(?:都)?(?:知道|认识|能去|可以去|会去)(?:哪些|什么)(?:地方|房间|位置)?"
    r"|有(?:哪些|什么)(?:地方|房间)|会?做(?:些)?什么|帮助|去哪(?:里|儿)?"
)


def greet(_found: Match[str], _reading: Reading) -> Meaning:
    """Read a greeting in no particular words."""
    return Steps((Say(text="你好"),))


def _rule(pattern: str, build: Build) -> Rule:
    return Rule(re.compile(pattern), build)


_RULES = (
    _rule(_WHERE, about(Topic.WHERE)),
    _rule(_PLACES, about(Topic.PLACES)),
    _rule(
        r"回家(?:去|吧)?|(?:回去|去|回)?充电(?:去)?|回充|返航|回桩|"
        r"(?:回到?|返回|去|到)(?:充电(?:桩|座|站|器)|基地|家里?)",
        home,
    ),
    _rule(
        rf"(?:回来|返回来|开回来|走回来|回去|返回|折返|原路返回)(?:吧)?|(?:回到?|返回|回去){_ORIGIN}(?:来)?",
        come_back,
    ),
    _rule(
        rf"(?:在?(?:那里|那儿|这里|这儿|原地))?(?:等待|等候|等|停留|待|休息)(?:我|上)?{ZH_DURATION}",
        wait,
    ),
    _rule(r"(?:在那里|在那儿)(?:停下来?|停住|停|待命|等着|等待)|待命", stand),
    _rule(rf"(?:说|喊|播报|讲)(?:一声|一句|一下|出)?[:]?(?P<quote>{QUOTE})", say),
    _rule(rf"(?:(?:和|跟|向|对)(?:我|大家))?(?:说|喊|讲)(?:一声|一句)?(?P<words>{_HELLO})", say),
    _rule(r"打(?:个|一?声)?招呼", greet),
    _rule(rf"从(?P<start>.+?)(?:出发)?{_GO}(?P<place>{MARK}.*)", route),
    _rule(r"从(?P<place>.+?)(?:出发|开始|起步)", set_out),
    _rule(
        rf"{_LEAD}{_GO}(?P<go>{MARK})(?:里面?)?[把将]?[^{MARK[1:-1]}]*{_ARM}.*",
        lacks(Code.NO_CAPABILITY),
    ),
    _rule(rf".*{_ARM}.*", lacks(Code.NO_CAPABILITY)),
    _rule(rf"{_LEAD}{_GO}(?P<go>{MARK}[里边]?){_LOOK}.*", lacks(Code.NO_CAMERA)),
    _rule(
        rf"(?:去|来|过去|帮忙)?{_LOOK}.*|过来|来这里|来我这里?|到我这(?:里|儿)?来?|来我(?:身边|面前)",
        lacks(Code.NO_CAMERA),
    ),
    _rule(_RELATIVE, lacks(Code.NO_CAPABILITY)),
    _rule(rf"{_LEAD}{_GO}(?P<place>.+?){_AFTER}", drive_to),
    _rule(_TALK, lacks(Code.NO_CAPABILITY)),
    _rule(r"(?P<place>.+)", next_place),
)

_NEGATION = (
    r"别|(?<!能)(?<!可)(?<!好)(?<!行)(?<!要)不(?!锈钢|错)|勿|莫|禁止|(?<!有)没|无法|无需|非(?!常)|除了|除开|除|取消|停止|"
    r"避免|避开|绕开|拒绝|忘了|算了|而是|代替|not|never|don"
)
_HARM = r"撞|碾|轧|压过|踢|打人|打他|打她|追赶|追着|追上|吓|伤害|攻击|杀|冲向|冲撞|堵住"
_CONDITION = (
    r"如果|要是|假如|假若|倘若|若|除非|的话|只要|只有|一旦|当.+(?:时|的时候)|时候|直到|等到|等(?!待?(?:\d|[一二三四五六七八九十两半]+个?(?:秒|分|小时))).+(?:再|后|了)|"
    r"万一|是否|是不是|要不要|否则|不然"
)
_SCOPE = (
    r"坐标|米每秒|米/秒|m/s|每秒|速度|全速|快速|慢慢|慢速|缓慢|高速|低速|匀速|公里|[xy] ?= ?-?\d"
    r"|[(\[] ?-?\d+(?:\.\d+)? ?, ?-?\d"
)
_COURTESY = (
    r"请问|请|麻烦|劳驾|拜托|帮我|帮忙|(?:让|叫|命令)(?:机器人|小车|它|你)|我(?:想|要|希望|需要)(?:让|叫|请)?你|"
    r"能不能|可不可以|能否|可以|能|你|您|机器人|小车|pons|robot|现在|马上|立刻|立即|快点|赶快|赶紧|快|直接|"
    r"就|那么|那(?![里儿边个])|好的|好了|好|嗨|喂|嘿|你好|然后|接着|随后|再|并且|并|也|还要?|继续|please|hey|嗯"
)
_THANKS = (
    r"吧|呀|啊|哦|喔|噢|哈|嘛|谢谢(?:你|您)?|多谢|拜托了?|好吗|好不好|可以吗|行吗|行不行|"
    r"一下|一趟|哟|please"
)

CHINESE = Grammar(
    asked=re.compile(r"(?:能|可以)([^,;.!?。]*)吗(?=[,;.!?。]|$)"),
    vetoes=(
        (Code.NEGATED, re.compile(_NEGATION)),
        (Code.UNSAFE, re.compile(_HARM)),
        (Code.CONDITIONAL, re.compile(_CONDITION)),
        (Code.AMBIGUOUS, re.compile(r"或者|或|还是|要么|任意|随便|\bor\b")),
        (Code.OUT_OF_SCOPE, re.compile(_SCOPE)),
    ),
    clause_end=re.compile(
        r"[,;.!?。、~\s]+(?!\d)|然后|接着|随后|紧接着|之后|以后|而后|并且|并"
        r"|再(?=[去到回走开前返看等说移驶进停])|(?<=[秒钟])后|(?=最后|最终)"
        rf"|(?<={MARK})(?:和|与|跟|及|以及|还有|后(?=[去到回再等说返]))"
        rf"|(?<={MARK})(?:那里|那儿|里)?(?=(?:等待?|停留)[\d零一二三四五六七八九十两半]|说|打招呼)"
    ),
    courtesy=re.compile(rf"^(?:{_COURTESY})+"),
    thanks=re.compile(rf"(?:{_THANKS})$"),
    opening=re.compile(r"^(?:首先|先)"),
    closing=re.compile(r"^(?:最后|最终)"),
    rules=_RULES,
)
