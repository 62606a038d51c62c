"""Own the Chinese ways of asking for a look: states, whereabouts, numbers, and what to report.

Rows over the clauses of a marked text, for ``plain_words.in_order_words``. A question about a state
("the door, is it shut?") is answered by looking where it names a place; where a thing is lost and
somebody orders to look for it, it is searched. A question alone orders no search.
"""

from __future__ import annotations

from planner.language.grammar.everyday import table
from planner.language.grammar.lexicon import MARK
from planner.language.grammar.zh.drive_phrases import BEGIN, END, LEAD, LOOKS, PLACE, SIDE

_STATE = r"(?:反锁|上锁|[关开锁亮灭熄停拔盖])"
_SO = r"(?:好|上|住|掉|紧|严)?"
_NO_TOPIC = r"看瞧查说讲问喊叫告诉你您他她它把给让请如果就等别不没有昨刚之前早次哪谁什么几"
_TOPIC = rf"(?P<t>[^,。;!?{_NO_TOPIC}去到在]{{1,10}}?)"
_TOPIC_SEEN = rf"(?P<t>[^,。;!?{_NO_TOPIC}]{{0,10}}?)"
_STILL = r"(?:还|都|已经|一直)*"
_SEES = rf"(?:去|过去|来)?{LOOKS}"
_GLANCES = r"(?:去|过去|来)?(?:瞧一瞧|瞧一眼|瞧一下|瞧瞧|瞧|瞄一眼|瞅一眼|瞅瞅)"
_HAVE_A_LOOK = rf"(?:你|帮我|快)*(?:过去|去)?{LOOKS}"

_OWN = r"(?:我们?的?|咱们?的?|你的)?"
_THING = rf"{_OWN}(?P<t>(?![看瞧找查]|(?:在|放|丢|搁|落|跑|去)[在到了]?哪)(?!我们?(?:在|到|现在)|这[是里儿]|那[是里儿]|自己|咱)[^,。;!?哪谁他她它你您有没不{MARK[1:-1]}]{{1,10}}?)"
_WHERE = (
    r"(?:现在|到底|又|都|究竟|是)*(?:在|放在?|丢在?|搁在?|落在?|掉在?|扔在?|藏在?|摆在?|忘在?|收在?|跑|去|弄)?到?了?"
    r"(?:哪个房间|哪间?屋子?|哪里|哪儿|哪|什么地方|啥地方)(?:去|里)?了?"
)
_SEARCH = r"(?:找找看|找看看|找一找|找一下|找找|找下|找)"
_ASKED_TO = r"[,。?!](?:你|快|赶紧|赶快|帮我|给我|帮忙|麻烦)*(?:去)?"
_IS_LOST = (
    rf"(?:呢|[又怎么]*不见了|又?找不[到着]了?|丢了|没了|我?(?:不知道|忘了|忘记|不记得)?{_WHERE})"
)
_LOSSES = (
    rf"{BEGIN}(?:哎呀?,)?{_THING}{_IS_LOST}",
    rf"{BEGIN}(?:哎呀?,)?我(?:找|看)不[到见着]{_THING}(?:了|放哪里?了)",
)
_SEEN = r"(?:有没有|有)?(?:看到|看见|见到|见过|瞧见)(?:过)?"
_AT_HOME = r"(?:家里面?|家中|屋里|屋子里)"

_TOLD = r"(?:告诉|通知|(?:跟|和|向|给|对)(?=我们?[说讲报汇反]))我们?(?:说说|讲讲|说|讲|报告|汇报|反馈)?(?:一下|一声|下|声)?"
_BACK = r"(?:然后|再|最后|完了|完事|就|你)*(?:回来|过来|回头)(?:后|以后|之后)?(?:再|就)?[,]?"
_SEEN_THERE = (
    r"(?:你|都)*(?:看到|看见|发现|找到)了?些?(?:什么|啥|几个)?[^,。或还再就别勿去回到是时]{0,6}|都?有(?:没有|什么|啥|几|多少|谁|哪些)[^,。或还再就别勿去回到是时]{0,10}"
    r"|(?:是)?(?:什么|啥|个什么)?(?:结果|情况)|怎么样了?|(?:一共|总共)?(?:几|多少)[^,。]{0,4}|在不在|是谁|谁在[^,。]{0,4}"
)
_LOOKED = r"(?:看|瞧|找|数|查|检查|巡逻|点)"
_DONE = r"(?:看|瞧|数|找|查|检查|转|逛|走|弄|搞|做|拍|巡逻)完"
_MANY = r"(?:几|多少)"

_SPOT = rf"(?P<p>(?:{MARK}的?)?{MARK}(?:口|旁边|前面|后面|底下|下面|对面|上面?|里面?|那里|那边|那儿|地上|地下)*)"
_RESTS = r"(?:[站坐躺放搁停趴睡摆挂蹲][着了]?|有)"
_SOME = r"(?:一?[个只把张本位瓶条件双])?"
_A_THING = rf"(?P<t>(?![什谁哪几点些])[^,。;!?有没是不{MARK[1:-1]}]{{1,8}}?)"

LOOK_PHRASES = table(
    (r"(?P<q>几个人|多少人)[哪呐](?=$|[?。])", r"\g<q>"),
    # whether somebody or something is there, as a statement that is asked
    (rf"{BEGIN}{LEAD}(?:(?:去|过去)?{LOOKS}[,]?)?{_SPOT}(?:这会儿?|现在|此刻)*{_RESTS}{_SOME}{_A_THING}没有?{END}", r"看看\g<p>有没有\g<t>"),
    (rf"{BEGIN}{LEAD}(?:(?:去|过去)?{LOOKS}[,])?{_SPOT}[,]?(?:这会儿?|现在|此刻)*(?:是不是|是否){_RESTS}{_SOME}{_A_THING}{END}", r"看看\g<p>有没有\g<t>"),
    (rf"{BEGIN}{LEAD}(?P<r>{MARK})(?P<s>{MARK})(?P<h>[上里]面?)?{_RESTS}(?=几个人|多少人)", r"\g<r>的\g<s>\g<h>有"),
    (rf"{BEGIN}{LEAD}(?P<a>{_AT_HOME})?(?:现在|这会儿?|此刻)+(?P<q>有几个人)(?:在家?)?(?=$|[啊呀呢,。?!])", r"\g<a>\g<q>"),
    (rf"{BEGIN}{LEAD}(?P<a>{_AT_HOME})(?P<q>有几个人)(?:在家?)?[啊呀呢]*[?,。!]+(?:你|帮我|快)*(?:去)?(?:数一数|数一下|数数|看看){END}", r"数一下\g<a>\g<q>"),
    (rf"{BEGIN}{LEAD}(?:面前|眼前|正前方|前面|前方)(?:那个|这个)?是(?P<q>什么|啥|谁)(?:东西)?{END}", r"看看前面有什么"),
    # what is done before the next clause, and what is told at the end
    (rf"(?:^|(?<=[,。]))(?:你|等你)?{_DONE}(?:了|以后|之后|后)?[,]?(?:就|再|然后|你)*(?=[去到回来过告跟向充])", "然后"),
    (
        rf"(?P<c>[^,。;]*{_LOOKED}[^,。;]*)[,。;]?{_BACK}{_TOLD}(?:{_SEEN_THERE})?{END}",
        r"\g<c>,然后回来",
    ),
    (rf"(?P<c>[^,。;]*{_LOOKED}[^,。;]*)[,。;]?{_BACK}(?:说说|讲讲|报告|汇报)(?:一下)?(?:{_SEEN_THERE})?{END}", r"\g<c>,然后回来"),
    (
        rf"(?P<g>[去到]{PLACE}{SIDE}(?:一趟|一下)?)[,。;]?{_BACK}{_TOLD}(?P<q>有(?:没有|什么|啥|几|多少|谁)[^,。]{{0,10}}?){END}",
        r"\g<g>看看\g<q>,然后回来",
    ),
    (rf"(?P<c>[^,。;]+)[,。;]{_BACK}{_TOLD}{END}", r"\g<c>,然后回来"),
    (
        rf"(?P<c>[^,。;]*{_LOOKED}[^,。;]*)[,。;](?:等|你)*(?:找|看|数)(?:到|完|好)了?(?:以后|之后|后|就|再)*(?:回来{_TOLD}|{_TOLD}){END}",
        r"\g<c>,告诉我",
    ),
    # states
    (rf"{_SEES}{_TOPIC_SEEN}有没有(?P<v>{_STATE}{_SO}){END}", r"看看\g<t>\g<v>了没有"),
    (rf"{BEGIN}{LEAD}{_TOPIC}有没有(?P<v>{_STATE}{_SO}){END}", r"看看\g<t>\g<v>了没有"),
    (rf"{_SEES}{_TOPIC_SEEN}(?:是不是|是否){_STILL}(?P<v>{_STATE}{_SO})(?P<a>[着了])?的?{END}", r"看看\g<t>\g<v>\g<a>没有"),
    (rf"{BEGIN}{LEAD}{_TOPIC}(?:是不是|是否){_STILL}(?P<v>{_STATE}{_SO})(?P<a>[着了])的?{END}", r"看看\g<t>\g<v>\g<a>没有"),
    (rf"{_SEES}{_TOPIC_SEEN}(?P<v>{_STATE})[没不](?P=v){_SO}{END}", r"看看\g<t>\g<v>了没有"),
    (rf"{BEGIN}{LEAD}{_TOPIC}(?P<v>{_STATE})[没不](?P=v){_SO}{END}", r"看看\g<t>\g<v>了没有"),
    (rf"{_SEES}{_TOPIC_SEEN}{_STILL}(?P<v>{_STATE}{_SO})没有?{END}", r"看看\g<t>\g<v>了没有"),
    (rf"{_GLANCES}{_TOPIC_SEEN}{_STILL}(?P<v>{_STATE}{_SO})(?P<a>[着了])没有?{END}", r"看看\g<t>\g<v>\g<a>没有"),
    (rf"{BEGIN}{LEAD}{_TOPIC}{_STILL}(?P<v>{_STATE}{_SO})(?P<a>[着了])(?:没有?|吗){END}", r"看看\g<t>\g<v>\g<a>没有"),
    (rf"{BEGIN}{LEAD}{_TOPIC}{_STILL}(?P<v>{_STATE}{_SO})没有?{END}", r"看看\g<t>\g<v>了没有"),
    (
        rf"{BEGIN}{LEAD}(?:{_SEES})?{_TOPIC}是?(?P<v>{_STATE})着?的?,?还是{_STATE}着?的?{END}",
        r"看看\g<t>\g<v>着没有",
    ),
    (rf"(?P<q>看看[^,。;]+?[着了]没有)[,。?!]{_HAVE_A_LOOK}{END}", r"\g<q>"),
    (
        rf"(?P<q>看看[^,。;{MARK[1:-1]}]+?[着了]没有)[,。?!](?:你|帮我|快)*[去到](?P<p>{PLACE}){SIDE}{LOOKS}{END}",
        r"去\g<p>\g<q>",
    ),
    (
        rf"{_SEES}(?:哪个房间|哪间(?:房|屋子?)?|哪里|哪儿)(?:里面?)?的?(?P<t>灯|窗户?|门|空调|水龙头)(?:还|都)?(?:没关|开着|亮着|没锁|没灭)(?:的)?{END}",
        r"去每个房间看看\g<t>关了没有",
    ),
    (
        rf"{_SEES}(?P<w>[^,。;!?哪有没{MARK[1:-1]}]{{1,6}}?)在(?P<p>{PLACE}){SIDE}(?P<q>[^,。;!?有没]{{1,6}}?)(?P<a>[着了])没有?{END}",
        r"去\g<p>看看\g<w>\g<q>\g<a>没有",
    ),
    (
        rf"{_SEES}(?P<w>[^,。;!?哪有没{MARK[1:-1]}]{{1,6}}?)在(?P<p>{PLACE}){SIDE}(?:干嘛|干什么|干啥|做什么|做啥|忙什么){END}",
        r"去\g<p>看看\g<w>在做什么",
    ),
    (rf"{_GLANCES}(?P<q>[^,。;!?{_NO_TOPIC}]{{2,12}}?[着了])没有?{END}", r"看看\g<q>没有"),
    (
        rf"{BEGIN}{LEAD}{_TOPIC}(?:好像|可能|是不是|大概|应该)(?:没|忘了?|忘记)(?P<v>{_STATE}{_SO})了?[,。?!]{_HAVE_A_LOOK}{END}",
        r"看看\g<t>\g<v>了没有",
    ),
    (
        rf"{BEGIN}{LEAD}(?P<q>[^,。;!?{_NO_TOPIC}去到在]{{2,10}}?[着了])没有?[,。?!](?:你|帮我|快)*[去到](?P<p>{PLACE}){SIDE}{LOOKS}{END}",
        r"去\g<p>看看\g<q>没有",
    ),
    (rf"{BEGIN}(?P<q>你?(?:能|可以)(?:看见|看到|看得见|看得到)[^,。;]{{1,6}}?)不{END}", r"\g<q>吗"),
    # whereabouts
    (
        rf"{BEGIN}{LEAD}我?(?:好像|可能|应该|大概)?把{_THING}(?:落|放|忘|丢|搁|留)(?:在|到)?(?P<p>{PLACE}){SIDE}了?{_ASKED_TO}(?:{_SEARCH}|{LOOKS}){END}",
        r"去\g<p>找\g<t>",
    ),
    (
        rf"{BEGIN}{LEAD}(?:去)?{LOOKS}我?是不是把?{_THING}(?:落|放|忘|丢|搁|留)(?:在|到)?(?P<p>{PLACE}){SIDE}了?{END}",
        r"看看\g<p>有没有\g<t>",
    ),
    (
        rf"{BEGIN}{LEAD}(?:去)?{LOOKS}{_THING}(?:在不在|是不是在|是否在)(?P<p>{PLACE}){SIDE}{END}",
        r"看看\g<p>有没有\g<t>",
    ),
    (rf"{BEGIN}{LEAD}(?:去)?(?:{LOOKS}|{_SEARCH}){_THING}{_WHERE}{END}", r"找\g<t>"),
    (rf"{BEGIN}{_THING}(?:你|帮我|快|给我|麻烦)*(?:{LOOKS}|{_SEARCH}){_WHERE}{END}", r"找\g<t>"),
    *((rf"{lost}{_ASKED_TO}(?:{_SEARCH}|{LOOKS})[它看]?{END}", r"找\g<t>") for lost in _LOSSES),
    *(
        (
            rf"{lost}{_ASKED_TO}[去到]?(?P<p>{PLACE}){SIDE}(?:{_SEARCH}|{LOOKS})(?:有没有|在不在|是不是在那里?)?{END}",
            r"去\g<p>找\g<t>",
        )
        for lost in _LOSSES
    ),
    *((rf"{lost}{_ASKED_TO}(?:{_SEARCH}|{LOOKS}){_WHERE}{END}", r"找\g<t>") for lost in _LOSSES),
    (rf"{BEGIN}{LEAD}(?:去)?{LOOKS}{_THING}在不在家里?{END}", r"找\g<t>"),
    (
        rf"{BEGIN}{LEAD}先?[去到](?P<a>{PLACE}){SIDE}(?:{LOOKS})?[,](?:再|然后)*[去到](?P<b>{PLACE}){SIDE}(?:{LOOKS})?[,](?:{LOOKS})?"
        rf"(?:哪边|哪里|哪儿|哪个|有没)还?有(?P<t>[^,。;{MARK[1:-1]}]{{1,8}}?){END}",
        r"去\g<a>和\g<b>看看有没有\g<t>",
    ),
    (rf"{BEGIN}{LEAD}{_SEEN}{_THING}(?:没有?|吗|了没有?)?[啊呀呢]*{_ASKED_TO}{_SEARCH}[它看]?{END}", r"找\g<t>"),
    (
        rf"{BEGIN}{LEAD}(?:{_AT_HOME}|哪里|哪儿|哪个房间里?)有(?:没有)?{_THING}[啊呀呢吗]*{_ASKED_TO}{_SEARCH}看?{END}",
        r"找\g<t>",
    ),
    (rf"{BEGIN}{LEAD}(?:去)?{_SEARCH}(?:{_AT_HOME}|家)?还?有没有{_THING}{END}", r"找\g<t>"),
    (rf"{BEGIN}{LEAD}(?:去)?{LOOKS}{_AT_HOME}(?P<q>有(?:没有|谁|几|什么)[^,。;{MARK[1:-1]}]{{0,8}}?){END}", r"去每个房间看看\g<q>"),
    (rf"{BEGIN}{LEAD}(?:去)?{LOOKS}谁在家里?{END}", "去每个房间看看有没有人"),
    (rf"{BEGIN}{LEAD}(?:去)?{LOOKS}(?:哪个房间|哪里|哪儿|哪间房)里?有{_THING}{END}", r"找\g<t>"),
    (
        rf"{BEGIN}{LEAD}{_SEARCH}{_THING}[,]?{LOOKS}(?:它)?(?:是不是|在不在)(?:在)?(?P<p>{PLACE}){SIDE}{END}",
        r"去\g<p>找\g<t>",
    ),
    (
        rf"(?P<c>[^,。;]*{PLACE}[^,。;]*)[,。](?:应该|可能|好像|大概|估计|多半|我记得)(?:就|是|还)*在(?:那里|那儿|那边|那|里面|上面)的?{END}",
        r"\g<c>",
    ),
    (
        rf"{BEGIN}{LEAD}[去到在]?(?P<p>{PLACE})(?P<h>底下|下面|下边)(?:去|帮我|给我|你)*(?:{LOOKS}|{_SEARCH})(?:看)?有没有(?P<t>[^,。;]{{1,8}}?){END}",
        r"看看\g<p>\g<h>有没有\g<t>",
    ),
    # numbers
    (
        rf"{BEGIN}{_THING}(?:还剩|一共有|还有|有)(?:几|多少)[个把本张只瓶双]?[,。?!](?:你|帮我|快)*[去到](?P<p>{PLACE}){SIDE}(?:数数|数一下|数一数|{LOOKS}){END}",
        r"去\g<p>数\g<t>",
    ),
    (rf"(?:点一下|点点|点一点|清点一下|算算|算一下|数一下看看?|数数看看?)(?=[^,。;]{{0,8}}?{_MANY})", "数一下"),
    (rf"(?P<v>数一下|数一数|数数|数)(?:现在|到底)(?=[^,。;]{{0,6}}?{_MANY})", r"\g<v>"),
    (rf"(?P<v>数一下|数一数|数数|数)还?剩[下了]?(?={_MANY})", r"\g<v>有"),
    (rf"(?P<v>数一下|数一数|数数|数)(?:一共|总共)(?:有)?(?={_MANY})", r"\g<v>"),
    (
        rf"(?P<p>{MARK}(?:上面?|里面?|旁边|那边|那里)?)还?(?:剩|放|摆|堆|搁)(?:着|了|有|下)?(?={_MANY})",
        r"\g<p>有",
    ),
)  # fmt: skip
"""In this order: what one row writes a later one may read."""
