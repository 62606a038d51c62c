"""Read flat statements that are worth remembering, and what corrects one that was told. Pure.

"I've put your spare cable in the bedroom, under the bed" orders nothing and says where a thing is;
"Auntie Bernie's sleeping in the study this week" who is where for how long; "the plumber comes on
Friday" when. Laws: a statement of now ("I'm hungry", "dinner is ready") is talk; one whose subject
is a pronoun alone answers somebody; one that orders, asks or hangs on something is no statement.
"""

from __future__ import annotations

import re

from planner.language.commands import chinese, english
from planner.language.commands.command import ENDS, write_plainly
from planner.language.folding import fold_script, has_chinese

MAX_STATEMENT = 140
"""Characters; a flat statement is short."""
_ORDERS = (
    r"(?:please|don't|do not|never|go|come (?!s\b)|drive|find|look|check|tell|ask|say|remind|wake"
    r"|bring|take|follow"
    r"|wait|stop|turn|count|put|leave|move|let|make|get|give|keep|remember)"
)
_OPEN = re.compile(
    r"\b(?:if|unless|whether|when|whenever|until|till|or|please|you|who|what|where|why|how|which|maybe|perhaps"
    rf"|i think|probably)\b|\?|(?:^|[,;.:] |\band |\bthen |\bso ){_ORDERS}\b"
)
_LEAD = re.compile(
    r"(?:(?:ok|okay|right|well|oh|hey|hi|listen|robot|pons|and|so)[ ,]+)*"
    r"(?:(?:just )?(?:so you know|to let you know|letting you know|thought you should know"
    r"|for your information)|fyi"
    r"|for the record|by the way|heads up|(?:i should (?:tell|let) you(?: know)?|you should know"
    r"|let me tell you)(?: that)?)?[ ,:]*"
)
_TAIL = re.compile(
    r"[ ,;.]+(?:in case (?:any(?:body|one)|some(?:body|one)|you|he|she|they|[a-z]+)(?:'re| are|'s"
    r"| is)?"
    r" (?:asks?|needs? (?:it|them|to know)|wants? (?:it|them|to know)|wonders?|looks? for (?:it"
    r"|them)|looking(?: for (?:it|them))?)(?: you)?"
    r"|(?:just )?(?:so you know|fyi|by the way|for your information|okay|ok|all right|right"
    r"|thanks|thank you|remember)"
    r"|(?:and )?(?:don't|do not|never) forget(?: (?:it|that|this|about it))?"
    r"|(?:and )?(?:don't|do not) let (?:me|us) forget(?: (?:it|that|which [a-z ]+ it is"
    r"|where [a-z ]+ (?:is|are)|when it is))?"
    r"|(?:and )?(?:remember|keep|note)(?: it| that| this)?(?: in mind)?(?: for me"
    r"| for us)?(?:,? (?:would|will|can|could) you)?)$"
)
_OURS = r"(?:(?:the|my|our|your|his|her|their|[a-z]+'s|some|a|an) )"
NOUN = (
    rf"{_OURS}(?:spare |old |new |red |blue |green |black |white |big |small |other "
    rf"|good )*[a-z0-9' -]{{2,30}}?"
)
_AT = (
    r"(?:in|on|at|under|behind|near|next to|beside|inside|on top of|by|between|above|below"
    r"|over by|underneath|to|into|onto)"
)
_SPOT = rf"{_AT} (?:(?:the|my|our|your|a|[a-z]+'s) )?[a-z][a-z0-9' ]{{1,30}}?"
SPOTS = rf"{_SPOT}(?:,? {_SPOT}){{0,2}}"
_STILL = (
    r"(?:still |now |always |usually |kept |stored |lying |standing |hidden |drying |parked "
    r"|back |both |all )*"
)
_NOW = r"(?: (?:now|drying now|drying|again|instead|at the moment|for now|today|tonight))?"
_ACTS = (
    r"(?:just |already |also )*(?:put|left|moved|placed|stored|parked|hid|hidden|dropped|hung"
    r"|tucked|kept|keep|shoved|stuck|taken|locked)"
)
_BE = r"(?:'s|'re| is| are)"
_DAY = r"(?:monday|tuesday|wednesday|thursday|friday|saturday|sunday)s?"
_SPELL = (
    rf"(?:today|tonight|tomorrow|this (?:week|weekend|month|morning|afternoon|evening|summer"
    rf"|winter|{_DAY})|these days|next (?:week|weekend|month|{_DAY})"
    rf"|all (?:day|week|month|night|morning|afternoon)|for (?:the|a few|two|three|a) (?:week"
    rf"|weekend|day|days|weeks|month|night|nights)"
    rf"|from now on|on {_DAY}(?: (?:morning|afternoon|evening|night))?|at weekends|on weekends"
    rf"|on weekdays|every (?:day|night|morning|evening|week|{_DAY}))"
)
_CLOCK = (
    r"(?:at (?:about |half |quarter past )?(?:\d{1,2}(?:[:.]\d\d)?"
    r"|[a-z]+)(?: o'clock)?(?: ?[ap]m)?)"
)
_WHEN = rf"(?:{_SPELL}(?: {_CLOCK})?|{_CLOCK}(?: {_SPELL})+)"
_PERSON = (
    r"(?:(?!(?:it|that|this|there|he|she|they|you|everything|something|dinner|lunch|i)\b)"
    r"(?:(?:the|my|our|his|her) )?[a-z][a-z'-]*(?: and (?:(?:the|my|our) )?[a-z]+| [a-z]+){0,2}?)"
)
_STAYS = (
    r"(?:sleeping|staying|working|living|resting|studying|camping|recovering|playing"
    r"|practising|having (?:a nap|lessons))"
)
_VISITS = (
    r"(?:coming|visiting|arriving|leaving|moving|starting|going out|being collected"
    r"|getting (?:back|home)|coming (?:back|over|round|home|to (?:stay|visit|dinner|clean)))"
)
_COMES = (
    r"(?:comes?|arrives?|leaves?|visits?|starts?|goes out|go out|gets? (?:back|home)"
    r"|get collected|(?:is|are) due|is|are)"
)
_FORMS = re.compile(
    rf"{NOUN}{_BE} {_STILL}{SPOTS}{_NOW}"
    rf"|(?:i|we|he|she|they|(?!the\b)[a-z]+)(?:'ve| have|'s| has)? {_ACTS} {NOUN} {SPOTS}{_NOW}"
    rf"|(?:i|we)(?:'ve| have)? moved {NOUN}[,;.]? (?:and )?(?:it|they)(?:'s|'re| is"
    rf"| are) {_STILL}{SPOTS}{_NOW}"
    rf"|{_PERSON}{_BE} {_STAYS} {_SPOT} {_WHEN}"
    rf"|{_PERSON}{_BE} {_VISITS}(?: to [a-z ]{{3,20}}?)? {_WHEN}"
    rf"|{_PERSON} {_COMES} (?:to [a-z ]{{3,20}}? )?{_WHEN}"
    rf"|we(?:'ve| have)(?: got)? [a-z ]{{3,30}} (?:coming|visiting|staying)(?: (?:over"
    rf"|round))? {_WHEN}"
    rf"|{_OURS}?[a-z-]+ (?:password|code|pin|number) is [a-z0-9 ]{{2,30}}"
    rf"|{_PERSON} (?:is|are) allergic to [a-z ]{{3,30}}"
    rf"|{_PERSON} (?:doesn't|does not|can't|cannot) (?:eat|drink|take|like) [a-z ]{{3,30}}"
)
_SURE_FORMS = re.compile(
    r"(?!(?:it|that|this|there|he|she|they|you|i|we)\b)[a-z][a-z' ]{1,30}? (?:is|are|goes?|comes?"
    r"|has|have|lives?|takes?|likes?|needs?|'s) [a-z0-9:' ]{2,60}"
)
"""What is worth remembering only where somebody asks for that."""
_ASKED_TO_KEEP = re.compile(r"forget|remember|keep|note|so you know|fyi|in case")
_LEAD_ZH = re.compile(
    r"(?:对了|那个|哦|喂|机器人|顺便|提前|先|我)*,?(?:(?:跟|和|给|同)你(?:讲|说|提)(?:一?下|一声|个事|一件事|哈|啊)*|告诉你(?:一?下|一声|个事|哈|啊)*"
    r"|通知你一?下|让你知道一?下|说一声|说一下|提一下)[,:]*|(?:对了|顺便说一下|顺便说一句|提醒一下|备注一下),"
)
_TAIL_ZH = re.compile(
    r"[,。!](?:回头|到时候?|等下|要是|万一)*我?(?:要是)?(?:忘|找不到|想不起来)了?,?你?(?:就|再|要|得)*(?:提醒|告诉)我(?:一声|一下)?$|"
    r"[,。!](?:你|您)?(?:(?:要|得|先)?(?:知道|晓得|心里有数)(?:一下|就行|就好|了|哈|啊|哦|吧)*|记得(?:啊|哦|哈|了)?|别忘(?:了|啦|记)*(?:啊|哦|哈)?"
    r"|跟你(?:说|讲)(?:一下|一声)|(?:等下|等会儿?|待会儿?|一会儿?|以后|要是|如果|万一)?(?:有人|谁|别人|[他她]们?|.{1,4})(?:要是)?(?:问|找)(?:你|起|到)?(?:的话)?(?:,|就|你)*(?:你)?(?:就)?(?:告诉|跟|和)(?:[他她]们?|人家)?(?:说|讲)?(?:一声)?)$"
)
_WHO_ZH = (
    r"(?:我?(?:爸爸?|妈妈?|老公|老婆|儿子|女儿|爷爷|奶奶|阿公|阿婆|外公|外婆|哥哥?|姐姐?|弟弟?|妹妹?|叔叔|舅舅|姑姑)|阿姨|保姆|客人|快递(?:员|小哥)?|师傅|维修师傅|水管工|电工"
    r"|医生|老师|家教|朋友|同事|邻居|亲戚|小[一-龥]|老[一-龥]|[一-龥]{1,2}(?:阿姨|叔叔|老师|师傅|奶奶|爷爷|哥|姐))"
)
_WHEN_ZH = (
    r"(?:(?:今天|明天|后天|今晚|明晚|明早|大后天|(?:下|这)?个?(?:周|星期|礼拜)[一二三四五六日天末]|(?:每|这|下)(?:个)?(?:周|星期|礼拜|天|月)|这几天|最近几天|周末)"
    r"(?:早上|上午|中午|下午|晚上|傍晚)?(?:[一二三四五六七八九十两\d]{1,3}点(?:半|钟|[一二三四五六七八九十\d]{1,3}分?)?)?|(?:早上|上午|中午|下午|晚上)[一二三四五六七八九十两\d]{1,3}点半?钟?)"
)
_FORMS_ZH = re.compile(
    rf"{_WHO_ZH}(?:们)?(?:会|要|就|都)?{_WHEN_ZH}(?:会|要|就|都)?(?:过?来|上门|到|回来|回家|走|出差|住|睡|在|休息|上班|放假|搬).{{0,12}}"
    rf"|{_WHEN_ZH}{_WHO_ZH}(?:会|要|就|都)?(?:过?来|上门|到|回来|回家|走|出差|住|睡|休息|上班|放假|搬).{{0,12}}"
    r"|(?:我们?|[他她]|妈妈?|爸爸?)(?:刚|刚才|已经)?把[^,;。!?]{1,14}(?:放|搁|收|塞|挂|停|藏|存|移|搬|挪)(?:在|到|进)[^,;。!?吗呢]{2,14}(?:了)?"
    r"|[^,;。!?你我他她它这那]{2,10}(?:密码|号码|编号)是[^,;。!?吗呢什么]{2,20}"
    rf"|{_WHO_ZH}对[^,;。!?]{{1,10}}过敏"
)
_OPEN_ZH = re.compile(
    r"如果|要是|的话|吗|呢|[?？]|什么|哪|谁|怎么|几点了|是不是|有没有|还是|可能|好像|大概|请|帮|提醒|叫我|告诉|[跟和给对].{1,4}(?:说|讲)|你|您|别|不要|^(?:去|到|来|回|找|看|等|当)|(.)不\1|没有?$"
)
_SURE_FORMS_ZH = re.compile(
    r"(?!.*(?:去|回来|过来|找|看看|跟着))"
    r"(?!去|到|来|回|找|看|别|不|请|把|给|帮|跟|等|[他她它这那])[^,;。!?]{4,40}"
)


def find_statement(text: str) -> str | None:
    """Return the words of a flat statement that is worth remembering; None of anything else."""
    written = write_plainly(text).strip(ENDS)
    if not 0 < len(written) <= MAX_STATEMENT or "?" in text or "？" in text:
        return None
    folded = fold_script(written.lower())
    if len(folded) != len(written):
        return None
    in_chinese = has_chinese(written)
    lead, tail = (_LEAD_ZH, _TAIL_ZH) if in_chinese else (_LEAD, _TAIL)
    begins = found.end() if (found := lead.match(folded)) else 0
    ends, asked = len(folded), bool(found and found[0].strip(ENDS))
    while (behind := tail.search(folded[:ends])) is not None and behind.start() > begins:
        ends, asked = behind.start(), True
    core = folded[begins:ends].strip(ENDS)
    start = folded.index(core, begins) if core else begins
    words = written[start : start + len(core)]
    opens = (_OPEN_ZH if in_chinese else _OPEN).search(core)
    if not core or opens is not None:
        return None
    if _is_worth(core, in_chinese=in_chinese):
        return words
    sure = (_SURE_FORMS_ZH if in_chinese else _SURE_FORMS).fullmatch(core)
    kept = asked and (in_chinese or _ASKED_TO_KEEP.search(folded) is not None)
    return words if kept and sure is not None else None


def _is_worth(core: str, *, in_chinese: bool) -> bool:
    if in_chinese:
        return (
            chinese.STATEMENT.fullmatch(core) is not None or _FORMS_ZH.fullmatch(core) is not None
        )
    return english.STATEMENT.fullmatch(core) is not None or _FORMS.fullmatch(core) is not None
