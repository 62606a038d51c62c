"""Own the Chinese ways of ordering short moves, turns, stays, ways, lists and rounds.

Rows over the clauses of a marked text, for ``plain_words.in_order_words``: what stands on the left
orders the same as the grammar's own words on the right. No row takes a place, a denial or a
condition away.
"""

from __future__ import annotations

from planner.language.grammar.everyday import table
from planner.language.grammar.lexicon import MARK
from planner.language.numbers import ZH_LENGTH

BEGIN = r"(?:^|(?<=[,.!?;。])|(?<=然后)|(?<=[再先]))"
"""Where a clause begins."""
LEAD = r"(?:请|麻烦你?|帮我|帮忙|给我|你|您|就|也|快|赶紧|顺便|稍微|稍稍|略微)*"
"""What may stand before its verb and adds nothing."""
END = (
    r"[吧啊呀哦嘛呗咯啦喔噢哈呢哟]*"
    r"(?=$|[,.!?;。]|然后|再(?=[去到回走开前返看等移进停找数巡跟向往左右掉转退后]))"
)
"""Particles, and the end of a clause."""
PLACE = rf"(?:{MARK}的?)?{MARK}"
SIDE = r"(?:那边|这边|那儿|这儿|那里|这里|那头|这头|里头|里面|那|这|里|上)?"
LOOKS = (
    r"(?:看一看|看一眼|看一遍|看一下|看下|看看|瞧一瞧|瞧一眼|瞧一下|瞧瞧|瞄一眼|瞅一眼|瞅瞅|查看一下|查看"
    r"|检查一下|检查一遍|检查|确认一下|确认|查一下|看|瞧)"
)
"""Verbs of looking, the longest first."""

_BIT = r"(?:一?点点|一?点儿?|一些|一?下|一小?步|半步|一丢丢|一小段)"
_BACK = r"(?:(?:往|向|朝)?后面?(?:退|倒|挪|走|开|撤|移|靠)?|退后|倒退|退)"
_AHEAD = r"(?:(?:往|向|朝)前面?(?:走|进|开|挪|来|动|移)?|前进|上前)"
_SHOWN = r"(?:给[^,。]{1,6}?(?:看一看|看一下|看一眼|看看|看下|瞧瞧|瞧一下|看))?"
_FACE = r"(?:面对着?|面向|面朝|朝着?|对着?|看着|看向|盯着)"
_WAITED_FOR = r"(?:快递员?|外卖|客人|朋友|师傅|送货的?|送快递的|人|我)"

_HOUSE = (
    r"(?:全屋|全家|家里面?|家中|屋里|屋子里|房子里|整个(?:家|屋子|房子)|整间屋子"
    r"|(?:每一?个|所有|全部|各个?|挨个儿?|逐个)的?(?:房间|屋子?|地方)|每间(?:屋子?|房间?)?"
    r"|一个(?:房间|屋子?)(?:接)?一个(?:房间|屋子?)|一间(?:屋子?|房间?)?(?:接)?一间(?:屋子?|房间?)?)"
)
_WIDELY = r"(?:都|全|也|帮我|给我|挨个|到处|四处|来回|地|去|里里外外|各|里面?)*"
_TOURS = (
    r"(?:走走|转转|看看|瞧瞧|逛逛|溜达|巡逻|巡视|巡查|检查|走|转|看|巡|跑|逛|绕|查)"
    r"(?:一?[遍圈下趟眼轮]|一?个遍|过去)?"
)
_LOOKED_IN = r"[去在]?(?:每|所有|全部|各)[^,。;]{0,8}?看看[吧啊呀哦嘛呗咯啦]*(?:$|[,.!?;。])"
"""The grammar itself looks in every room for it."""
_AND = r"(?:,|、|和|跟|与|还有)?"
_EACH = r"(?:都|各|全|分别|挨个儿?|依次|轮流)"

_TO_AND_FRO = (
    rf"{BEGIN}{LEAD}(?:从|就?在)?(?P<a>{PLACE}){SIDE}(?:和|跟|与|到|、)(?P<b>{PLACE}){SIDE}(?:之间|中间)?"
    r"(?:来来回回|来回|往返)(?:地|不停地)?(?:走动|走走|走|跑|开|移动|转|逛)?"
)

DRIVE_PHRASES = table(
    (rf"(?P<p>{MARK})那(?=[看找数瞧待呆等站停守]|帮我|有)", r"\g<p>那里"),
    (r"(?P<d>[前后左右里外上下旁])边儿", r"\g<d>边"),
    (r"(?<!往)(?<!向)(?<!朝)前(?:边|头)", "前面"),
    (rf"{BEGIN}{LEAD}自己(?=[回去充])", ""),
    # short moves and turns
    (rf"{BEGIN}{LEAD}{_BACK}{_BIT}{END}", "后退20厘米"),
    (rf"{BEGIN}{LEAD}{_AHEAD}{_BIT}{END}", "前进20厘米"),
    (rf"{BEGIN}{LEAD}(?:在?原地)?转(?:个|一|一个)?圈[儿圈]?{_SHOWN}{END}", "转一圈"),
    (rf"{BEGIN}{LEAD}(?:在?原地)?转(?P<n>[两二三四五])圈儿?(?:{_SHOWN}|看看){END}", r"转\g<n>圈"),
    (
        rf"{BEGIN}{LEAD}转(?:过?身)?(?:过[去来])?[,]?{_FACE}(?P<p>{PLACE}){SIDE}{END}",
        r"面对\g<p>",
    ),
    (rf"{BEGIN}{LEAD}(?:看着|看向|盯着)(?P<p>{PLACE})转过[去来]{END}", r"面对\g<p>"),
    (rf"{BEGIN}{LEAD}{_FACE}(?P<p>{PLACE})转(?:过[去来]|身){END}", r"面对\g<p>"),
    (rf"{BEGIN}{LEAD}转(?:过身|身)?过[去来]{END}|{BEGIN}{LEAD}转个身{END}", "转身"),
    (rf"{BEGIN}{LEAD}转(?:过身|身)?过[去来](?={LOOKS}(?!着)|告诉我)", "转身,"),
    (rf"{BEGIN}{LEAD}(?:[向往朝]后转(?:一下|过去|身)?|转(?:个|了)?半圈){END}", "转身"),
    (rf"(?P<t>[左右]转|\d度|[一二三四五六七八九十百]度)(?={LOOKS})", r"\g<t>,"),
    (rf"(?P<w>[往向朝][前后])面?(?P<l>{ZH_LENGTH})", r"\g<w>走\g<l>"),
    (
        rf"(?P<m>(?:[往向朝]?[前后](?:走|退|进|开|移动)|后退|前进|退){ZH_LENGTH})[,]?(?:就|再|然后)*(?:停下来?|停住|停){END}",
        r"\g<m>",
    ),
    (
        rf"(?P<f>跟着?我们?)(?:走|来)?[,](?:你|等)*(?:走|开)?到了?(?P<p>{PLACE}){SIDE}(?:你|就|再)*(?:停下来?|停住|停){END}",
        r"\g<f>去\g<p>",
    ),
    (r"(?<=[,。])(?:对|好|嗯|行|哎)[,。](?=[就再看去先数找]|然后)", ""),
    (rf"{BEGIN}{LEAD}(?:过来|来|到)我(?:这边|这里|这儿|这|身边)(?:来|一下)*{END}", "过来"),
    (rf"{BEGIN}{LEAD}(?:过来|来)一下{END}", "过来"),
    (rf"{BEGIN}{LEAD}跟(?:着)?(?P<w>我们?)(?:过来|过去|走){END}", r"跟着\g<w>"),
    # ways and stays
    (
        rf"{BEGIN}{LEAD}(?:一直)?往前(?:走|开)[,]?(?:一直)?(?:走|开)到(?P<p>{PLACE}){SIDE}"
        rf"(?:(?:就|再)?(?:停下来?|停住|停))?{END}",
        r"去\g<p>",
    ),
    (
        rf"{BEGIN}{LEAD}(?:一直)?(?:走|开|跑)到(?P<p>{PLACE}){SIDE}(?:就|再|那里)?(?:停下来?|停住|停一下|停){END}",
        r"去\g<p>",
    ),
    (rf"(?P<a>从{PLACE}){SIDE}(?:走过去|开过去|过去|过来|走|穿过去)[到去进](?={MARK})", r"\g<a>去"),
    (
        rf"{BEGIN}{LEAD}(?:经过|路过|穿过|途经|经)(?P<a>{PLACE}){SIDE}[,]?(?:再|然后)?(?:走|开)?[去到进回](?={MARK})",
        r"从\g<a>去",
    ),
    (rf"{BEGIN}{LEAD}(?P<p>{PLACE})(?:旁边|边上|边|那里|那儿|那边)?停(?:一下|下来?|一停){END}", r"去\g<p>"),
    (
        rf"(?P<g>[去到回上])(?P<p>{PLACE}){SIDE}(?:旁边|边上|边|附近)?(?:停(?:着|一下|下)|(?:待|呆|站|守|歇|趴)着){END}",
        r"\g<g>\g<p>",
    ),
    (
        rf"(?P<g>[去到回上])(?P<p>{PLACE}){SIDE}(?:旁边|边上|边|附近)?(?:待|呆|歇|坐|玩|休息|等)(?:一?会儿?|一下|一阵)"
        r"[吧啊呀哦嘛呗咯啦]*(?=[.!。]*$)",
        r"\g<g>\g<p>",
    ),
    (
        rf"(?P<p>{PLACE}){SIDE}(?:去|来)?[,。](?:然后|再|你|就)*在那(?:里|儿|边)?(?:等|待|呆|站|守|停)着"
        r"[吧啊呀哦嘛呗]*(?=[.!。]*$)",
        r"\g<p>",
    ),
    (
        rf"[去到在](?P<p>{PLACE}){SIDE}(?:旁边|边上|边)?去?(?:等|候)(?:一下|着)?{_WAITED_FOR}(?:来|上门|回来|过来|一下|一?会儿?)?{END}",
        r"去\g<p>等人",
    ),
    (rf"{BEGIN}{LEAD}上(?P<p>{PLACE}){SIDE}去?(?:一趟|一下|一次)?(?={END}|数|{LOOKS}|找)", r"去\g<p>"),
    (rf"{BEGIN}{LEAD}过来[,](?=[到去来]{PLACE})", ""),
    (
        rf"(?P<p>{PLACE}){SIDE}[,](?:你|等)*到了?(?:那里|那儿|以后|之后|就|后)*(?:停|待|等|站|留)(?:在|着|下来?)*(?:那里|那儿|那)?"
        r"[吧啊呀哦嘛呗]*(?=[.!。]*$)",
        r"\g<p>",
    ),
    (
        rf"{BEGIN}{LEAD}回(?:你的?|自己的?)?小?窝里?(?:待着|呆着|歇着|睡觉|休息)?[去吧]*{END}",
        "回去充电",
    ),
    (rf"{BEGIN}{LEAD}(?:去|回去|自己去)?充(?:一?会儿?|点儿?|下|一下)电去?{END}", "回去充电"),
    (
        rf"{BEGIN}{LEAD}(?:回去|去|上)(?:充电)?(?:桩|座)(?:上|那里|那儿|那)?去?充(?:会儿?)?电{END}"
        rf"|{BEGIN}{LEAD}回去(?:休息|歇着|歇会儿?|待着|睡觉){END}",
        "回去充电",
    ),
    (r"^(?:那)?你?还是(?=[去回到])(?!.*(?:还是|或))", ""),
    (rf"(?P<d>[秒钟])(?:后)?(?=回来{END}|回去{END})", r"\g<d>,"),
    (
        rf"(?P<g>[去到]{PLACE}){SIDE}(?:转一下|转一转|转转|走走|走一走|逛逛|逛一下|遛遛)(?={END})",
        r"\g<g>",
    ),
    (rf"{_TO_AND_FRO}(?P<n>[两二三四五六七八九十]|\d)(?:趟|次|遍|回|圈){END}", r"去\g<a>然后去\g<b>,\g<n>次"),
    (rf"{_TO_AND_FRO}{END}", r"去\g<a>然后去\g<b>,两次"),
    # lists and rounds
    (
        rf"{BEGIN}{LEAD}(?:数一下|数一数|数数|数)(?P<l>{MARK}(?:(?:和|、|跟){MARK})+)里?(?:一共|总共)?(?:的|有)(?:几|多少)?(?P<t>[^,。;{MARK[1:-1]}]{{1,10}}?){END}",
        r"去\g<l>数\g<t>",
    ),
    (
        rf"(?P<a>{MARK}){_AND}(?=(?:{MARK}{_AND})*{MARK}(?:这?[几两三]个(?:地方|房间))?[里那]?{_EACH})",
        r"\g<a>和",
    ),
    (
        rf"{BEGIN}{LEAD}[把去到]?(?P<l>{MARK}(?:和{MARK})+)(?:这?[几两三]个(?:地方|房间))?[里那]?{_EACH}+(?:去|帮我|给我)*"
        rf"{LOOKS}(?![到见着过了完看瞧一])",
        r"去\g<l>看看",
    ),
    (
        rf"{BEGIN}{LEAD}[把去到]?(?P<l>{MARK}(?:和{MARK})+)(?:这?[几两三]个(?:地方|房间))?[里那]?{_EACH}+(?:去|帮我|给我)*"
        rf"(?:转转|走走|逛逛|(?:转|走|逛|去|跑)一?[遍圈下趟]){END}",
        r"巡逻\g<l>",
    ),
    (
        rf"{BEGIN}{LEAD}把(?P<l>{MARK}(?:(?:和|、|跟|与){MARK})*)都?(?:看|查|检查|走|转)(?:一?[遍圈下]){END}",
        r"去\g<l>看看",
    ),
    (
        rf"{BEGIN}{LEAD}[去在把到]?{_HOUSE}{_WIDELY}(?:{_TOURS})?[,]?(?:然后|顺便|你)*(?:去)?{LOOKS}"
        rf"(?P<q>(?![看一到见着过了完])[^,。;{MARK[1:-1]}]{{2,20}}?){END}",
        r"去每个房间看看\g<q>",
    ),
    (rf"{BEGIN}{LEAD}[去在把到]?{_HOUSE}{_WIDELY}(?:找找看?|找一找|找一下|找下|找)(?P<t>(?!有没有|过|遍|一)[^,。;{MARK[1:-1]}]{{1,10}}?){END}", r"找\g<t>"),
    (rf"{BEGIN}{LEAD}(?!{_LOOKED_IN})[去在把到]?{_HOUSE}{_WIDELY}{_TOURS}(?:,?{LOOKS})?{END}", "巡逻所有房间"),
    (rf"{BEGIN}{LEAD}去?(?:巡逻|巡视|巡查|巡检)(?:一圈|一遍|一趟|一轮){END}", "巡逻所有房间"),
    (r"巡逻所有房间,(?:然后|再)?(?=去每个房间看看)", ""),
)  # fmt: skip
"""In this order: what one row writes a later one may read."""
