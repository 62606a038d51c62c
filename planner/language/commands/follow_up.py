"""Read a sentence that leans on the goal before it: a correction, one more, again, the other one.

Pure, both languages, whole sentences only: "say hello again" is an order of its own. Which goal is
leant on is for the missions to say (``planner.mission.follow_up``). A plain yes or no, and whatever
holds a condition or a question, is none of these.
"""

from __future__ import annotations

import re

from planner.language.commands.command import (
    AppendCommand,
    LeaveOutCommand,
    OtherPlaceCommand,
    RepeatCommand,
    Replace,
)
from planner.language.folding import fold_words, has_chinese
from planner.language.numbers import TIMES, chinese_number, times
from planner.language.yes_no import consents

MAX_READ = 120
"""Characters; a longer sentence is an order of its own."""
FollowUp = RepeatCommand | AppendCommand | OtherPlaceCommand | LeaveOutCommand | Replace
_ENDS = " .!,;:。~…，；！"
_PLEASE = r"(?:please|pls|ok|okay|robot|pons|hey|um|uh|well|oh|now|and|just|thanks)"
_NOISE = re.compile(r"^(?:(?:um+|uh+|er+|h+m+|well|ok|okay|hey|robot|pons|please|嗯|呃|请)[ ,]+)+")
_POLITE = re.compile(rf"(?:(?:{_PLEASE}|(?:can|could|would|will) you)[ ,]+)+|(?:[ ,]+{_PLEASE})+$")
_POLITE_END = re.compile(
    rf"(?:(?<! as)[ ,]+(?:{_PLEASE}|while you(?:'re| are) (?:at it|there|about it)))+$"
)
_POLITE_ZH = re.compile(
    r"^(?:请|麻烦你?|那个?|[嗯呃哎诶欸唉哦噢喔啊]|哎呀|好|机器人|,)+|(?:吧|呀|啊|哦|呗|嘛|哈|谢谢|,)+$"
)
_OPEN_END = re.compile(
    r"\b(?:if|unless|when|whenever|until|otherwise|or|because|whether)\b|\?|[;:]"
    r"|如果|要是|假如|除非|的话|否则|(?<=.)还是|吗$|呢$|？"
)
"""With these a sentence is more than one word in a conversation."""

_STATE_END = re.compile(r"(?<=[睡坐躺站忙开等歇]着)呢$")
"""他睡着呢 tells, and asks nothing."""
_ANY_VERB_ZH = r"(?:[来做去走跑试数找看说转念读退绕问查跟等]|执行|巡[逻视]|检查|转[身圈]|前进|后退)"
_AGAIN = re.compile(
    r"(?:do |try |go |run )?(?:(?:it|that|this|the same(?: thing)?) )?"
    r"(?:again|once more|one more time|another time)"
    r"|(?:repeat|redo) (?:it|that|this)(?: again| once more)?|(?:the )?same (?:thing )?again"
    r"|repeat(?: the)?(?: last)? (?:goal|order|task|drive)"
)
_MORE = re.compile(
    rf"(?:do |go |try )?(?:(?:it|that|this|the same(?: thing)?) )?(?:"
    rf"(?:again )?{TIMES}(?: more| again)?|(?P<more>two|three|four|[2-9]) more(?: times)?"
    r"|(?P<more2>two|three|four|[2-9]) more times)"
)
_MORE_ZH = re.compile(rf"再{_ANY_VERB_ZH}?(?P<times>[二两三四五六七八九]|[2-9])(?:次|遍|趟|回)")
_AGAIN_ZH = re.compile(
    rf"(?:再|重新?)(?:去|过去|来)?{_ANY_VERB_ZH}?(?:一)?(?:次|遍|趟|回)|(?:重新?|再)(?:来|做|试|执行)(?:过)?"
    r"|重复(?:一)?(?:次|遍)|同样(?:的)?再来(?:一)?(?:次|遍)?|老样子再来(?:一)?(?:次|遍)?"
)
_SINCE_ZH = re.compile(r"[,。](?:都|已经|现在|可能|说不定)[^,。去到回来找看跟再别不]{1,10}[了呢]$")
"""Why it is done again: 再看一遍，都过十分钟了."""
_OTHER = re.compile(
    r"(?:(?:no|nope|not (?:this|that)(?: one)?|sorry)[ ,]+)*(?:i meant? |i said |go to |to )?"
    r"(?:the|that) other(?: one| room| place)"
    r"|(?:(?:no|nope)[ ,]+)?i meant? the other(?: one)?"
)
_OTHER_ZH = re.compile(
    r"(?:不是?这个|不是?那个|不对|不是|不|错了)?,?(?:我(?:说|要|指)的?是|我是说|去|到|是)?"
    r"另(?:外)?(?:那)?一?(?:个|间)(?:房间|地方)?"
)

_WHY_LEFT = (
    r"[,;.] (?:because |since |as |for )?(?:there|she|he|it|they|i|we|(?:the|my"
    r"|our) [a-z]+(?: [a-z]+)?"
    r"|somebody|someone|everybody|everyone|mum|mom|dad|grandma|grandpa|granny|[a-z]+(?='s\b| is\b))"
    r"(?:'[a-z]+| (?:is|are|am|was|were|has|have|had|will|needs?|wants?|sleeps?|works?|just|already"
    r"|always|still|only)\b)"
    r"(?!.*\b(?:go|come|drive|find|look|then|instead|first|if|you|try|meant?|said)\b)[^,;.]*"
)
"""Why a place is left out; it orders nothing."""
_LEFT_OUT = re.compile(
    r"(?:you (?:can|could|may) )?(?:skip|leave out|omit|miss out|pass over) (?P<rest>(?:the |my "
    r"|our )?[a-z][a-z' -]{1,30}?)"
    rf"(?:{_WHY_LEFT})?"
    r"|(?:you (?:can|could|may) )?leave (?P<rest2>(?:the |my |our )?[a-z][a-z' -]{1,30}?) out"
    rf"|(?:(?:no|oh|wait)[ ,]+)*(?:but )?not (?P<rest4>(?:the |my "
    rf"|our )[a-z][a-z' -]{{1,30}}?){_WHY_LEFT}"
    r"|(?:but )?(?:except(?: for)?|apart from|without) (?P<rest3>(?:the |my "
    r"|our )[a-z][a-z' -]{1,30}?)"
)
_LEFT_OUT_ZH = re.compile(
    r"(?:(?:跳过|略过)(?P<rest>[^,。;]{1,8}?)(?:别去|不去)?了?|除了(?P<rest2>[^,。;]{1,8}?)(?:以外"
    r"|之外)?)"
    r"(?:,(?:因为)?(?:有人|我|[他她]|宝宝|孩子|妈|爸|奶奶|爷爷|客人|里面|那里)[^,去到]{0,10})?"
)

_ALSO_BEFORE = re.compile(
    r"(?:and (?:then|also|after that)|and then also|also|after that|afterwards|and) (?P<rest>.+)"
)
_SAME = re.compile(
    r"(?:now )?(?:do )?(?:the )?same(?: thing)?(?: again)? (?:in|at|for|with) (?P<rest>.+)"
    r"|(?:and )?(?:what|how) about (?P<rest2>(?:in |on |at |by |under )?(?:the|my|our)"
    r" [a-z][a-z' -]{1,30})"
    r"|and (?P<rest3>(?:in |at )?(?:the|my|our) [a-z][a-z' -]{1,30})"
    r"|(?:do|take in|include|throw in|add) (?P<rest4>(?:the|my|our) [a-z][a-z' -]{1,30}?)"
    r"(?: to (?:it|that|the|your) ?(?:round|patrol|tour|list)?s?)?"
)
_ASKS = re.compile(
    r"^(?:(?:and )?(?:what|how) about )|^and (?:in |at )?(?:the|my|our) [a-z' -]+$|^.{1,8}呢$"
)
"""What asks for one more by a question: its mark is no doubt."""
_DONE = re.compile(
    r"(?:and )?(?:when|once|after|as soon as) (?:you(?:'re| are) (?:all )?(?:done|finished)"
    r"(?: with (?:that|it|this)| there| here| (?:in |with )?(?:the|my|our) [a-z]+(?: [a-z]+)?)?"
    r"|you(?: have|'ve)? finish(?:ed)?(?: (?:that|it|this|(?:in )?(?:the|my|our) [a-z]+"
    r"(?: [a-z]+)?))?"
    r"|that(?:'s| is) (?:done|finished))[ ,]+(?:then )?(?P<rest>.+)"
)
_DONE_ZH = re.compile(
    r"(?:等你?|你)?(?:[弄做干忙办找数看说转走跑去查绕]|巡[逻视查]|检查|探索)?完(?:了|这个|那个"
    r"|之后|以后)*(?:[^,去到回来]{1,6}?(?:之后|以后|了)?(?=[,去到]))?(?:就|再|然后|顺便|顺带|,)*"
    r"(?P<rest>[去到回来找看数巡].+)"
)
_SAME_ZH = re.compile(
    r"(?:(?:还|这|那)?(?:不够|差一点|不算完),?)?(?:顺便|顺带|再|还有|另外|,)*(?:把|帮我把)?"
    r"(?P<rest>(?![别不没勿]|[a-z]+ ?[一-龥]).{1,8}?)(?:那边|里面?)?的?"
    r"(?:呢|也(?:照样|同样|一样|要|得|帮我|给我|再|去|一起)*"
    r"(?:来|做|弄|数|找|看|瞅|瞧|查|检查|清点|巡|转|走)(?:一(?:遍|次|下|圈|眼)|一?[数看瞅瞧找查转走])(?:吧|呗"
    r"|啊|哈)*|也(?:加上|算上|加进去|算进去|带上))"
)
_TOO = re.compile(
    r"(?P<rest>.+?)[ ,]+(?:too|as well|also|while you(?:'re| are) (?:there|at it|about it))"
)
_ALSO_ZH = re.compile(
    r"(?:然后|接着|之后|完了(?:以后|之后)?|还有|另外)[,]?(?:也|还|再)?(?P<rest>.+?)(?:也(?:去一下"
    r"|去|要))?"
    r"|(?P<rest2>(?![别不没勿]|[a-z]+ ?[一-龥]).{1,12}?)也(?:要)?"
    r"(?:去一下|去一趟|去|看看|看一下|要)"
)

_ONWARD = re.compile(r"^(?:on|over|off|back)(?: again)? (?=(?:in)?to )")
_ALONGSIDE_ZH = re.compile(r"^(?:顺便|顺带|再|帮我|,)*把")
_TAKEN = (
    r"(?:(?:oh|ah|(?:oh )?no|nope|nah|wait|sorry|oops|wrong (?:room|place|one)|wrong"
    r"|not that(?: one| room)?|on (?:second thoughts?|reflection)|come to think of it"
    r"|actually)[ ,.!;]+)"
)
_MEANT = (
    r"(?:i (?:meant?|said|wanted|want)(?: to say)?|i was thinking of|make (?:it|that)|it(?:'s| is))"
)
_BARE_EN = r"(?:to |in |into |at )?(?:(?:the|my|our) )?[a-z][a-z' -]{1,30}"
_DRIVE_EN = r"(?:go|drive|come|head|move|return|turn|look|find|count|follow|patrol|wait)\b.+"
_GO_THERE = (
    r"(?:[ ,.;]+(?:so |please )?(?:go|drive|come|head) (?:over )?there(?: instead| please)?)?"
)
_CORRECTION = re.compile(
    rf"{_TAKEN}++{_MEANT} (?P<a>.+?){_GO_THERE}"
    rf"|{_MEANT.replace('|want', '')} (?P<b>{_BARE_EN}?){_GO_THERE}"
    r"|(?:(?:no|nope|nah|wrong room|wrong place|not that one|not (?:t?here)|oops"
    r"|on (?:second thoughts?|reflection)|come to think of it)[ ,.!;]+"
    r"(?:(?:wait|sorry|actually|hang on|i mean)[ ,.!;]+)*)+"
    r"(?:rather |try |better |instead )?"
    rf"(?P<c>(?:to |in |into |at |by |near |beside |next to |on )?(?:the|my|our)"
    rf" [a-z][a-z' -]{{1,30}}?"
    rf"(?:, (?:on|in|at|by|near|beside|next to) (?:the|my|our) [a-z][a-z' -]{{1,30}})?"
    rf"|{_DRIVE_EN})"
    r"(?: first| instead| rather| i meant?)?"
    rf"|(?:(?:no|wait|hold on|hang on)[ ,]+)*not (?:to )?(?:the|my|our) [a-z' -]{{2,24}}[,;.]?"
    rf" (?:but )?(?:rather )?(?:i (?:want|need) you (?:to (?:go|come|be) )?(?:in |to |at )?)?"
    rf"(?P<d>(?:to )?(?:the|my|our) [a-z][a-z' -]{{1,30}})"
    r"|(?:(?:oh|ah|no|sorry|wait|hang on|hold on)[ ,.!;]+)*"
    r"(?P<k>(?:to |in )?(?:the|my|our) [a-z][a-z' -]{1,30}?)[ ,]+i meant?"
)
_CORRECTION_ZH = re.compile(
    r"(?:(?:不对)+|(?:不是)+|错了|搞错了|我?说错了|不不|不)[,。!！]+"
    r"(?P<a>(?:去|到|回|找|看看|数).+|(?:我(?:说|要|指)的?是|我是说|是|应该是).{1,12})"
    r"|(?:不对|错了|搞错了|我?说错了)[,。!！]+(?P<e>(?!应该|可能|好像|大概|也许|多半"
    r"|在)[^我你您没不好行].{0,7})"
    r"|(?:(?:等等|等一?下|不)[,。!！]+)?我是说(?P<f>.{1,12})"
    r"|(?:不对,?)?不是[^,是]{1,10}?[,]?(?:而)?是(?P<b>.{1,12})"
    r"|还是(?P<g>(?:去|到|回).{1,12}?)(?:好了|吧|得了)"
    r"|(?:(?:等一?下|等等|不对)[,。!！]+)?不是[^,是]{1,10}?[,。]我(?:是)?(?:要|想要?|让)你(?:去"
    r"|到)(?P<i>.{1,12})"
    r"|(?:不对|不是?|错了)[,。!！]+(?:应该|可能|好像|大概|也许|多半)?(?:是)?在(?P<h>.{1,8})"
    r"|(?:(?:等等|等一?下|哎|不)[,。!！]+)?我(?:说|指|要)的(?:是|可是)(?P<c>.{1,12}?)(?:[,]?不是.{1,12})?"
)
_SORRY_ZH = re.compile(
    r"^(?:[哦噢喔啊哎呀诶欸唉嗯呃]+[,。!！]*)?(?:(?:真的?|很|实在)?(?:不好意思|抱歉|对不起)(?:了"
    r"|啊|呀|哈|哦)?[,。!！]*)+"
)
_SORRY = re.compile(r"(?<=[a-z])[ ,]+(?:i am |i'm )?sorry$")
"""An apology before a correction; alone, or before a plain order, it takes nothing back."""
_LEAD_ZH = re.compile(r"^(?:我(?:说|要|指|想)的?(?:可)?是|我是说|应该是|而是|是)")
_LEAD = re.compile(rf"^(?:{_MEANT}) ")


def read_follow_up(text: str) -> FollowUp | None:
    """Return the word in a conversation that a sentence is, or None."""
    said = _NOISE.sub("", fold_words(text).replace("’", "'").strip(_ENDS))
    chinese = has_chinese(said)
    if not 0 < len(said) <= MAX_READ or consents(text) is not None:
        return None
    said = _STATE_END.sub("", said) if chinese else said
    said = said.rstrip("?？ ") if _ASKS.search(said.rstrip("?？ ")) else said
    done = _DONE.fullmatch(said) or _DONE_ZH.fullmatch("".join(said.split()))
    if done is not None and not _OPEN_END.search(done["rest"]):
        return AppendCommand(done["rest"].strip(_ENDS))
    if _OPEN_END.search(said) and not _ASKS.search(said):
        return None
    bare = "".join(said.split()) if chinese else said
    plain = _strip(_POLITE_ZH if chinese else _POLITE, bare)
    again = _strip(_POLITE_ZH, _SINCE_ZH.sub("", plain)) if chinese else plain
    if (_AGAIN_ZH if chinese else _AGAIN).fullmatch(again):
        return RepeatCommand()
    more = (_MORE_ZH if chinese else _MORE).fullmatch(plain)
    if more is not None and (count := _times_of(more.groupdict(), chinese=chinese)) is not None:
        return RepeatCommand(count)
    if (_OTHER_ZH if chinese else _OTHER).fullmatch(plain):
        return OtherPlaceCommand()
    if (left := (_LEFT_OUT_ZH if chinese else _LEFT_OUT).fullmatch(plain)) is not None:
        return LeaveOutCommand(next(text for text in left.groups() if text))
    ends = _POLITE_ZH if chinese else _POLITE_END
    taken_back = _correction(plain, chinese=chinese) or _correction(bare, chinese=chinese)
    return taken_back or _also(_strip(ends, bare), chinese=chinese)


def _times_of(said: dict[str, str | None], *, chinese: bool) -> int | None:
    """Return how many more times something is to be done."""
    words = next((text for text in said.values() if text), None)
    if words is None:
        return None
    return int(chinese_number(words) or words) if chinese else times(words)


def _correction(plain: str, *, chinese: bool) -> Replace | None:
    said = _SORRY_ZH.sub("", plain) if chinese else _SORRY.sub("", plain)
    found = (_CORRECTION_ZH if chinese else _CORRECTION).fullmatch(said)
    if found is None:
        return None
    rest = next(text for text in found.groups() if text is not None)
    rest = _strip(_LEAD_ZH if chinese else _LEAD, rest).strip(_ENDS)
    return Replace(rest, now=True, corrects=True) if rest and consents(rest) is None else None


def _also(bare: str, *, chinese: bool) -> AppendCommand | None:
    """Read "and then the kitchen too"; "and" alone joins nothing to a goal that ran before."""
    patterns = (_ALSO_ZH, _SAME_ZH) if chinese else (_ALSO_BEFORE, _TOO, _SAME)
    rest, found = bare, False
    asks = (_SAME_ZH if chinese else _SAME).fullmatch(bare) is not None
    for pattern in patterns:
        match = pattern.fullmatch(rest)
        if match is not None:
            rest, found = next(t for t in match.groups() if t is not None), True
    rest = _strip(_POLITE_ZH if chinese else _POLITE, rest).strip(_ENDS)
    rest = (_ALONGSIDE_ZH if chinese else _ONWARD).sub("", rest)
    return AppendCommand(rest, asks) if found and rest and consents(rest) is None else None


def _strip(pattern: re.Pattern[str], text: str) -> str:
    """Take courtesy off both ends."""
    while True:
        found = pattern.match(text)
        shorter = text[found.end() :] if found is not None else text
        behind = [m for m in pattern.finditer(shorter) if m.end() == len(shorter) and m.start() > 0]
        shorter = shorter[: behind[-1].start()] if behind else shorter
        if shorter == text or not shorter:
            return text
        text = shorter.strip(_ENDS)
