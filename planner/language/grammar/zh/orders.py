"""Read Chinese orders: the vetoes, the ends of clauses, and the meanings of a clause.

A clause is read whole or not at all; the rules name every character that they pass over.
"""

from __future__ import annotations

import re
from re import Match

from planner.language.grammar import unsupported
from planner.language.grammar.checks import EXCEPTIONS_ZH
from planner.language.grammar.clauses import Grammar
from planner.language.grammar.lexicon import MARK
from planner.language.grammar.parse_result import (
    TALK,
    Meaning,
    Reading,
    Steps,
    lacks,
    rule,
    unread,
)
from planner.language.grammar.unsupported import lacks_arm
from planner.language.grammar.zh import ALL_ROOMS, GO, IN, SEE, VERB
from planner.language.templates.reader import TemplateStage
from planner.plan import Code, Language

_ARM = (
    r"(?:拿|取(?!消)|(?<!快)递|抓|放(?!映)|搬|端(?!口)|捡|拾|夹|提起|提着|抬|打开|关闭|关掉|关上|"
    r"关门|"
    r"关灯|关|开门|开灯|开窗|"
    r"倒水|倒茶|倒掉|倒杯|推|拉|扔|丢|洗(?!衣|手|碗)|洗衣服|洗碗|擦|扫|拖地|做饭|做晚饭|做早饭|"
    r"做午饭|做菜|烧(?:水|饭|菜|茶)|煮|炒|整理|收拾|叠|按下|"
    r"按一下|摆|装(?!货|卸)|盛|喂|浇|带(?!我|路|大家|他|她|着|领)|交给|给我(?!讲|说|唱|介绍|带)|"
    r"送(?!我|客|他|她|大家)(?=.*(?:给|去|到|来))|敲门|修|举|举起|打扫|清洁|做.{0,3}饭|泡茶|泡.*茶|"
    r"削)"
)
_NO_ARM = (
    r"放[松心慢假学弃]|开放|关[于心注系键节]|[相有机无]关|推[荐迟测理]|拉近|拿[手定]|端[正午]|送[行达]|带头|"
    r"举[例办行动]|装[修作]|[假安服包西]装|修[正改养]|取[决名得]|[争采]取|搬家|抓紧|提起|擦肩|扫[一视]|摆脱|拖延|盛大"
)
_WITH_ARM = rf"(?:{_NO_ARM}|(?!{_ARM}|{_NO_ARM}).)*(?!{_NO_ARM}){_ARM}"
"""A verb of an arm that is no part of another word: 放松 and 关于 grasp nothing."""
_NO_LOOK = rf"(?!(?:{SEE}).*[着了]没有?$)"
"""看看门关了没 closes no door."""
_TALKING = r"(?:说|讲|告诉|回答|提醒|叫|读|念|介绍|聊天|查询|发[现出生动]).*"
_LACKS = r"(?:唱|跳舞|播放|放.*音乐|订|搜索网|翻译|计算|写|发).*"

_NEGATION = (
    r"别(?!的)|(?<!能)(?<!可)(?<!好)(?<!行)(?<!要)(?!(?<=是)不是)不(?!锈钢|错|过|见了)|勿|莫|禁止|"
    r"(?<!有)没(?!有问题|电了|事(?:儿|了|啦|$))|无法|无需|非(?!常)|除了|除开|除|取消|停止|"
    r"避免|避开|绕开|拒绝|忘了|算了|而是|代替|免得|省得|千万|\bnot\b|\bnever\b|\bdon\b"
)
_CONDITION = (
    r"如果|要是|假如|假若|倘若|若|除非|的话|只要|只有|一旦|当.+(?:时|的时候)|时候(?!了)|直到|等到|"
    r"等(?!着[,。]|[待候]?(?:我|上)?(?:\d|[一二三四五六七八九十两半]+个?(?:秒|分|小时))).+(?:再|后|了)|"
    r"万一|是否|是不是|要不要|否则|不然|明天|后天|今晚|今天晚上|待会儿?|过一会儿?|稍后|晚点|"
    r"[\d一二三四五六七八九十]+点(?!钟?了?吗?$)|每(?:隔|天|小时|分钟|次)|半小时后|分钟后|小时后|"
    r"随时|(?<![此里儿])为止|(?:[我他她]们?|妈|爸|奶奶|爷爷)[^,.;!?。停]{1,10}再停"
    r"|(?:看到|看见|见到|瞧见|碰到|遇到|发现)[^,.;!?。]{1,8}就"
    r"|(?:看看|看一下|看下|瞧瞧|检查)[^,.;!?。]{1,10}?(?:着|[关开锁亮灭熄停]了|[有没][^,.;!?。]{1,6}|在)就"
)
_SCOPE = (
    r"坐标|米每秒|米/秒|m/s|每秒|速度|全速|快速|慢慢|慢速|缓慢|高速|低速|匀速|公里|经度|纬度|"
    r"[xy] ?= ?-?\d"
    r"|[(\[] ?-?\d+(?:\.\d+)? ?, ?-?\d"
    r"|(?:前|(?<![然之以])后|走|退|转|开)[^,。等停留待]{0,4}[\d一二三四五六七八九十两半]+(?:秒|"
    r"分钟)"
)
_COURTESY = (
    r"请问|请(?!(?:他|她|大家|客人|\ue900|所有人))|麻烦|劳驾|拜托|帮我(?:们)?|帮忙|(?:让|叫|"
    r"命令)(?:机器人|小车|它|你|xlerobot|pons)|"
    r"我(?:想|要|希望|需要)(?:让|叫|请)?你|(?:你)?能不能|可不可以|能否|可以|能|你(?!们?的|叫|是|"
    r"好)|您(?!好)|机器人|小车|pons|robot|xlerobot|现在|"
    r"马上|立刻|立即|快点|赶快|赶紧|快(?!递)|直接|"
    r"就|那么|那(?![里儿边个位些])|好的|好了|好(?!吗|不好)|嗨(?=.)|喂(?!食|猫|狗|养)|嘿|"
    r"你好(?=[请去到,])|然后|接着|随后|再(?!见)|并且|并|也|还要?|继续|please|hey|嗯|"
    r"咱们(?=[去到回])|后(?=[去到])|依次(?=看|检查|巡|查)|接下来|紧接着|顺便|顺路|替我|给我(?=[去找数查])|一下|"
    rf"(?:去|来|过去|过来|上前|前去)(?={VERB})"
)
_THANKS = (
    r"吧|呀|啊|哦|喔|噢|哈|嘛|呗|(?<![说声句讲喊道])谢谢(?:你|您)?|多谢|拜托了?|好吗|好不好|可以吗|行吗|行不行|"
    r"哟|please|即可|就行|就好|就可以了?"
)


def _tell_nothing(found: Match[str], reading: Reading) -> Meaning | None:
    """Understand nothing where there is nothing that could be told.

    Who comes back tells what came of the order by itself.
    """
    if reading.scene.kind == "come_back":
        return Steps(())
    return None if reading.scene.seen else unread(found, reading)


CHINESE = Grammar(
    asked=re.compile(r"(?:能|可以)([^,;.!?。]*)吗(?=[,;.!?。]|$)"),
    vetoes=(
        (Code.NEGATED, re.compile(f"{_NEGATION}|{EXCEPTIONS_ZH}")),
        (Code.CONDITIONAL, re.compile(_CONDITION)),
        (Code.AMBIGUOUS, re.compile(r"或者|或|还是|要么|任意|随便|\bor\b")),
        (Code.OUT_OF_SCOPE, re.compile(_SCOPE)),
    ),
    joint=re.compile(
        rf"((?:{GO})(?:{MARK}的)?{MARK}(?:(?:和|与|及|以及|、){MARK})*{IN}(?:去|来)?(?={VERB})"
        rf"|{ALL_ROOMS}(?:去|来)?(?={VERB}|有没有|是否有|有(?:几|多少)))(?!(?:{_ARM}))"
    ),
    clause_end=re.compile(
        r"[,;.!?。、~\s]+(?:[问叫喊说讲]|告诉|通知)完了?[他她]?们?(?:之?后|以后|再|就)?(?=[回去到过来])"
        r"|[,;.!?。、~\s]+(?!\d)|然后|接着|随后|紧接着|之后|以后|而后|并且|并|同时|顺便|(?<=回来)(?=告诉|报告|汇报|[跟向和给]我)|(?<=转身|掉头|调头|[左右]转)(?=告诉我|看看|看一下)|就(?=回来|"
        r"回去|返回)"
        r"|(?<![写吃做洗喝穿换玩睡][完好])(?<![写吃做洗喝穿换玩睡][完好了].)(?<![写吃做洗喝穿换玩睡][完好了]..)"
        r"再(?=[去到回走开前返看等说移驶进停找数巡告带跟问向往左右掉转])|(?<=[秒钟米度])后|"
        r"(?=最后|最终)"
        rf"|(?<={MARK})(?:和|与|跟(?!前)|及|以及|还有(?![^,。;]*吗)|后(?=[去到回再等说返找看数])|(?=然后))"
        rf"|(?<={MARK})(?:那里|那儿|里)?(?=(?:等待?|停留)[\d零一二三四五六七八九十两半]|说|打招呼)"
    ),
    courtesy=re.compile(rf"^(?:{_COURTESY})++"),
    thanks=re.compile(rf"(?:{_THANKS})$"),
    opening=re.compile(r"^(?:首先|先)"),
    closing=re.compile(r"^(?:最后|最终)"),
    rules=(
        *TALK,
        TemplateStage(Language.ZH, (0,)),
        *unsupported.PAST_CHINESE,
        TemplateStage(Language.ZH, (1,)),
        rule(rf"{_NO_LOOK}(?!{_WITH_ARM}).*{_ARM}.*", unread),
        rule(rf"{_NO_LOOK}.*{_ARM}.*", lacks_arm),
        *unsupported.ASIDE_CHINESE,
        rule(r"(?:看|瞧|找|查|检查|转|去)(?:过|完)?了", unread),
        rule(
            rf".*(?:{SEE}|守|陪|跟)(?:着|住)?到(?:[^,]{{0,3}}[\d一二两三四五六七八九十半]+点|天[亮黑]|半夜).*",
            unread,
        ),
        rule(
            r"(?:告诉我|[跟和向给对]我(?:说|讲|报告|汇报))(?:一声|一下|一遍|下|声)?",
            _tell_nothing,
        ),
        TemplateStage(Language.ZH, (2,)),
        rule(r"(?:往上|向上)?(?:跳|爬|飞起来).*", lacks(Code.NO_CAPABILITY)),
        rule(
            r"(?:往|向|朝|沿)(?:着)?[^\ue000-\ue7ff]*(?:走|移动|前进|转|开|退|行驶|旋转|挪).*"
            r"|(?:旋转|转|绕).*|走\d.*",
            unread,
        ),
        TemplateStage(Language.ZH, (3,)),
        rule(_TALKING, unread),
        rule(_LACKS, lacks(Code.NO_CAPABILITY)),
        TemplateStage(Language.ZH, (9,)),
    ),
)
