"""Own the Chinese rules about driving: places, home, waiting, turns, moves, patrols."""

from __future__ import annotations

from re import Match

from planner.language.grammar.clauses import QUOTE
from planner.language.grammar.driving_steps import (
    at_stops,
    come_back,
    drive_to,
    home,
    in_all,
    map_alone,
    move,
    patrol,
    patrol_all,
    route,
    say,
    set_out,
    stand,
    stand_at,
    turn,
    turn_and_move,
    wait,
    wander,
)
from planner.language.grammar.lexicon import MARK
from planner.language.grammar.noun_phrases import go_to
from planner.language.grammar.parse_result import (
    Meaning,
    Reading,
    Rule,
    Steps,
    about,
    lacks,
    on_topic,
    rule,
    unread,
)
from planner.language.grammar.small_talk import Topic
from planner.language.grammar.step_builders import HOW_LONG, WHERE_ARE_YOU, WHERE_TO, missing
from planner.language.grammar.zh import ALL_ROOMS, GO, IN, SPOT
from planner.language.numbers import ZH_ANGLE, ZH_DURATION, ZH_LENGTH, ZH_TURNS
from planner.plan import Code, Say

_STAY = r"(?:等着|待着|呆着|守着|候着|站着)"
_AFTER = r"(?:去一下|去一趟|去|来|过去|待命|停下来?|等我|一下|一趟|走一趟|转转|转一圈)?"
_LEAD = r"(?:(?:带|领|引导|陪|护送|送)(?:着)?(?:我们|我))?"
_ORIGIN = (
    r"(?:原地|原位|原处|原来的?(?:地方|位置)|起点|出发点|出发的?地方|起始(?:点|位置)|这里|这儿|"
    r"我这里|我这儿|我这|刚才的?(?:地方|位置))"
)
_HELLO = (
    r"你好|您好|大家好|早上好|下午好|晚上好|晚安|再见|拜拜|谢谢|欢迎光临|欢迎|我来了|我到了|"
    r"我回来了"
)
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
_SIDE = r"(?P<side>左|右|顺时针|逆时针)"
_FACE = r"(?:往|向|朝|原地)?(?:着)?"
_TURN = r"(?:方向)?(?:转动?|旋转|拐|转弯|转身|转过去|转向|偏)"
_RUN = r"(?:走|移动|前进|行进|行驶|开|挪|直行|移)"
_AHEAD = r"(?P<way>前|后|前方|后方|正前方|正后方|前面|后面)"
_WHOLE = (
    r"(?:(?:整个|全部|所有|这个|这间|剩下的?|未知的?|没去过的?)?的?"
    rf"(?:房子|屋子|房间|房屋|公寓|全屋|家里?|环境|区域|地方|周围|四周|这里|这儿|(?P<place>{MARK})(?:里)?))"
)


_HALT = r"停下来?|停住|停|站着|站住|等着|等我"
_PLACE_SELF = r"(?:停在|站在|站到|停到|停靠在|待在|等在)"
_STAND = r"(?:停|站|待|等|开|走|去|移动)"
_WHAT = rf"(?:{MARK}的)?(?:{MARK}|[^,。\ue000-\ue8ff]{{1,10}}?)"
_SIDE_OF = r"的?(?:正?前面|正?前方|跟前|对面|旁边?|边上|后面|背后|后方|前)"


def _greet(_found: Match[str], _reading: Reading) -> Meaning:
    return Steps((Say(text="你好"),))


def _come_here(found: Match[str], reading: Reading) -> Meaning:
    return missing(WHERE_ARE_YOU, found[0], reading)


def _stay_at(found: Match[str], reading: Reading) -> Meaning:
    """Go where it is to wait, without a time: arriving does that."""
    return go_to(found["place"] or found["at"], reading)


def _how_long(found: Match[str], reading: Reading) -> Meaning:
    return missing(HOW_LONG, found[0], reading)


def _leave(found: Match[str], reading: Reading) -> Meaning:
    return missing(WHERE_TO, reading.marked.restore(found[0]), reading)


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

RULES: tuple[Rule, ...] = (
    *TALK,
    rule(
        r"回家(?:去|吧)?|(?:回去|去|回)?充电(?:去)?|回充|返航|回桩|"
        r"(?:回到?|返回|去|到)(?:充电(?:桩|座|站|器)|基地|家里?)",
        home,
    ),
    rule(
        r"(?:回来|返回来|开回来|走回来|回去|返回|折返|原路返回)(?:吧|这里|这儿|我这里)?|(?:回到?|"
        rf"返回|回去){_ORIGIN}(?:来)?",
        come_back,
    ),
    rule(
        r"(?:在?(?:那里|那儿|这里|这儿|原地))?(?:等待|等候|等上?|停留|待|休息|停)(?:我|"
        rf"上)?{ZH_DURATION}",
        wait,
    ),
    rule(rf"(?:在那[里儿边])?{_STAY}|(?:就)?(?:待|呆|守|等|留|站)在那[里儿边]", stand),
    rule(
        r"(?:在?(?:这里|这儿|那里|那儿))?(?:等一下|等一等|等等|等一会儿?|稍等|等我|等着|等待|等)",
        _how_long,
    ),
    rule(
        rf"{_STAND}(?:在|到)?(?P<place>{_WHAT})(?P<side>{_SIDE_OF})(?:的地方|处)?"
        rf"(?:大约|大概|约)?{ZH_LENGTH}(?:的地方|处|远)?(?:{_HALT})?",
        stand_at,
    ),
    rule(
        rf"{_STAND}(?:在|到)?(?P<side>离|距离?)(?P<place>{_WHAT}?)(?:大约|大概|约|还有)?{ZH_LENGTH}"
        rf"(?:的地方|处|远)?(?:{_HALT})?",
        stand_at,
    ),
    rule(rf"{_PLACE_SELF}(?P<place>{_WHAT})(?P<side>{_SIDE_OF}|旁边?|边上)(?:{_HALT})?", stand_at),
    rule(
        rf"(?:去|到|开到|走到|移动到)(?P<place>{_WHAT})(?P<side>的?(?:正?前面|正?前方|后面|背后))"
        rf"(?:去)?(?:{_HALT})?",
        stand_at,
    ),
    rule(
        rf"(?:转身|转过去|转)?(?P<side>面[向朝]|面对着?|朝向|正对着?|对着|转向|转过去对着)(?P<place>{_WHAT})",
        stand_at,
    ),
    rule(rf"在(?P<place>{SPOT}{IN}){_STAY}|(?:待|呆|守|等|留|站)在(?P<at>{SPOT}{IN})", _stay_at),
    rule(rf"离开{MARK}(?:里)?", _leave),
    rule(rf"{GO}完(?P<place>{MARK})(?:以后|之后|后)?", drive_to),
    rule(r"(?:在那里|在那儿)(?:停下来?|停住|停|待命|等着|等待)|待命", stand),
    rule(rf"(?:说|喊|播报|讲)(?:一声|一句|一下|出)?[:]?(?P<quote>{QUOTE})", say),
    rule(rf"(?:(?:和|跟|向|对)(?:我|大家))?(?:说|喊|讲)(?:一声|一句)?(?P<words>{_HELLO})", say),
    rule(r"打(?:个|一?声)?招呼", _greet),
    rule(rf"从(?P<start>.+?)(?:出发)?{GO}(?P<place>{MARK}.*)", route),
    rule(r"从(?P<place>.+?)(?:出发|开始|起步)", set_out),
    rule(
        r"(?:快)?过来|来这里|来我这里?|到我这(?:里|儿)?来?|来我(?:身边|面前|旁边)|来找我",
        _come_here,
    ),
    rule(rf"{_FACE}{_SIDE}(?:边|侧|手边)?{_TURN}(?:个|了)?(?:{ZH_ANGLE})?(?:个?弯)?", turn),
    rule(rf"{_TURN}(?:{ZH_ANGLE})", turn),
    rule(rf"(?:原地)?(?:转|旋转){ZH_TURNS}(?:圈|周)", turn),
    rule(r"(?P<about>掉头|调头|转身|向后转|转过身(?:来|去)?|掉个头)", turn),
    rule(r"(?:原地)?(?:转|旋转)(?P<whole>一?圈|一周|1圈)", turn),
    rule(
        rf"(?:朝|向|往|沿)(?:着)?{_SIDE}前方(?:偏)?{ZH_ANGLE}(?:的)?(?:方向|"
        rf"角度)?(?:向前)?{_RUN}{ZH_LENGTH}",
        turn_and_move,
    ),
    rule(rf"{_FACE}{_AHEAD}{_RUN}(?:了|大约|大概|约)?(?:{ZH_LENGTH})?", move),
    rule(
        rf"(?:{_FACE})(?P<way>前进|后退|倒退|倒车|直行|直走|往后退|退后|退)(?:了|大约|大概|"
        rf"约)?(?:{ZH_LENGTH})?",
        move,
    ),
    rule(rf"(?:走|移动|行驶){ZH_LENGTH}", move),
    rule(
        rf"(?:去|到)?(?:巡逻|巡检|巡视|巡查)(?:一下|一遍|一圈)?(?P<place>{MARK})(?:一圈|一遍)?",
        patrol,
    ),
    rule(
        rf"(?:去)?(?:巡逻|巡检|巡视|巡查|检查|看看|走遍|逛遍|去到|走到|去|到)(?:一下|一遍)?{ALL_ROOMS}"
        r"|全屋巡逻|巡逻全屋",
        patrol_all,
    ),
    rule(rf"把{ALL_ROOMS}(?:都|挨个)?(?:巡逻|巡检|巡视|巡查|检查)(?:一下|一遍|一圈)?", patrol_all),
    rule(rf"在?{ALL_ROOMS}", in_all),
    rule(
        rf"(?:在|到)?(?:{ALL_ROOMS}|每到一?(?:处|个地方|站)|每一?站)?(?:都)?"
        r"(?:停下来)?(?:看看|看一下|看一看|瞧瞧|拍个?照片?|拍一?张照片?)"
        r"|(?:回来)?(?:告诉我|向我报告|报告|汇报|跟我说)(?:一下)?(?:你)?(?:在哪里?)?(?:都)?"
        r"(?:看到|看见|发现|见到)了?(?:些)?(?:什么|啥)(?:东西)?",
        at_stops,
    ),
    rule(rf"在?{ALL_ROOMS}", at_stops),
    rule(
        rf"(?:自己|自动|自主)?(?:去|来|开始|继续)?(?:探索|探查|勘探)(?:一下|一遍|下)?{_WHOLE}?"
        r"|(?:自己|自动|自主)(?:去|来|开始|继续)?(?:把)?(?:地图)?"
        r"(?:建图|建(?:个|张|一张|一个)?地图|绘制地图|画(?:个|张|一张)?地图|扫图|建好|画好)",
        map_alone,
    ),
    rule(
        r"(?:巡逻|巡检|巡视|巡查|到处走走|随处走走|转转|转一转|逛逛|遛遛|溜达)[^\ue000-\ue7ff]*",
        wander,
    ),
    rule(r"(?:往上|向上)?(?:跳|爬|飞起来).*", lacks(Code.NO_CAPABILITY)),
    rule(
        r"(?:往|向|朝|沿)(?:着)?[^\ue000-\ue7ff]*(?:走|移动|前进|转|开|退|行驶|旋转|挪).*"
        r"|(?:旋转|转|绕).*|走\d.*",
        unread,
    ),
    rule(rf"{_LEAD}{GO}(?P<place>.+?){_AFTER}", drive_to),
)
