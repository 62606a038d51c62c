"""Tell by sentence structure whether a clause orders the robot, asks, or merely states. Pure.

The law is positional: an order opens with a verb that the robot can follow, once courtesy is set
aside ("could you", "I want you to", 你, 帮我). A clause in which somebody else stands before the verb
("Mum is going to the kitchen", 我先去厨房), one in the past, and one that calls another person by name
order nothing, whatever verb comes later. A bare name ("the kitchen, please") is an order by itself.
In doubt a clause is a statement: a person is then asked, and nothing else.
"""

from __future__ import annotations

import re
from enum import Enum, auto
from typing import TYPE_CHECKING

from planner.language.motion_guard.mentioned_names import find_places, places_named, plain
from planner.language.person_names import NAMES_ZH, is_given_name

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.plan import Vocabulary


class Mood(Enum):
    """What a clause does: only an order sends the robot anywhere."""

    ORDER = auto()
    QUESTION = auto()
    STATEMENT = auto()
    CALL = auto()
    """Calls somebody who is not the robot: the order behind it is theirs."""


_SUBJECT = (
    r"(?:i|we|he|she|it|they|there|this|that|some(?:one|body)|every(?:one|body)|any(?:one|body)"
    r"|no(?:body| one))\b(?!\W*$)"
)
_ENDS = re.compile(
    rf"[,.;!:|。，；！：、]+|(?<=[?？])|\b(?:and|but|so|because|while|since|then) (?={_SUBJECT})"
    r"|(?<=[\u3400-\u9fff])(?=你(?:就|再|先|去|来|过|帮|快))"
)
_OPENS = re.compile(
    r"(?:please|pls|ok(?:ay)?|well|so|and|but|then|now|hey|hi|hello|robot|pons|just|no|not|yes|yeah"
    r"|right|um+|uh+|er+|hm+|oh|ah|like|quick|quickly|slowly|gently|first|next|finally|also|again"
    r"|maybe|perhaps|actually|sorry|instead|rather|kindly|wait|if (?:possible|you please)"
    r"|after that|in a moment|when you(?: are|'re) (?:done|ready)|as you (?:can|like)|always|only"
    r"|still|or|either|on|go on|come on|the other way|that's right|nope"
    r"|last|of all|be (?:a|an|so) \w+ (?:and|to)|(?:good|there's a) (?:boy|girl|robot))\b[ ']*"
)
_TO_YOU = re.compile(
    r"(?:(?:can|could|would|will|won't|may|should|might|must) you"
    r"|why (?:don't|not|do not)(?: you)?|(?:would|do) you mind|mind|would it be possible for you to"
    r"|you(?:'d| had)? (?:can|could|may|must|should|need to|have to|ought to|better|will)"
    r"|i(?:'d| would| will)? ?(?:want|need|like|love|wish|expect|ask|prefer)s? (?:it if )?you"
    r"|we(?:'d| would)? ?(?:want|need|like|love) you|(?:i|we) (?:think|guess|hope) you"
    r"|you(?:'re| are) (?:to|needed|wanted|expected|supposed|free|allowed)|you|let's|let us"
    r"|let me see"
    r"|(?:i|we)(?:'d| would) (?:like|love|appreciate|be \w+)(?: it)?(?: if you)?"
    r"|(?:how|what) about|time (?:for you )?to|it(?:'s| is) time|feel free to|try|start"
    r"|begin|finish|end|keep|i (?:said|mean|meant)|fancy|rather)\b[ ']*"
    r"(?:could|would|can|please|to|by|with|like|kindly|just|maybe|and|also|now|then|first|ever"
    r"|quickly|be so kind as|be able|in|at|possibly|mind|awfully|have|never)?\b ?"
)
_VERB_EN = (
    r"(?:go|goe?ing|drive|driving|ride|come|coming|walk|run|rush|hurry|dash|head|move|roll|scoot"
    r"|travel|navigat\w+|proceed|make|get|visit|visiting|swing|stop|drop|return|take|bring|fetch"
    r"|carry|deliver|lead|guide|escort|accompany|show|follow|meet|greet|welcome|tell|ask|say"
    r"|announce|call|wake|remind|patrol|rounds?|tour|inspect|check\w*|look\w*|see|seeing"
    r"|find|finding"
    r"|search|count|scan|watch|monitor|explore|observe|survey|wait|stay|stand|park|face|turn|spin"
    r"|rotate|approach|reach|position|place|charge|recharge|dock|enter|leave|pop|nip|peek|peep|pass"
    r"|cross|join|hang|send|describe|identify|locate|report|introduce|inform|talk|speak|answer|give"
    r"|back|reverse|step|do|have|repeat|let|map|circle|creep|crawl|shoo|track|trail|chase|listen"
    r"|forget|use|spot|notice|contact|conduct|head|continue|resume|start|help|pick|put"
    r"|place|grasp|grab)\b"
)
_ORDER_EN = re.compile(
    rf"{_VERB_EN}|(?:a |one |another )?(?:trip|tour|round|lap|look)s?\b"
    r"|(?:to|into|towards?|over|off|out|through|up|down|away|forward|straight|left|right|via|first"
    r"|in|at|by|with|near|beside|behind|before|for)\b|\d"
    r"|(?:if|when|whenever|once|unless|until|after|before|as soon as|every|whatever|in case)\b"
    rf"|(?!{_SUBJECT}|thanks?\b|sorry\b|\w+(?:ed|ing|s|n't) )[a-z]+ (?:\w+ )?(?:to|into|towards?) "
    r"(?:the|my|our|your)\b"
)
_VERB_FIRST = re.compile(
    rf"(?!(?:is|are|do|does|have)\b){_VERB_EN}|(?:if|when|whenever|once|unless|until|after"
    rf"|before)\b"
)
_ASKS_PAST = re.compile(
    r"(?:did|was|were|had|have you|has|haven't|what would|how do i|how can i)\b"
)
_ASKS = re.compile(
    r"(?:what|who|whose|which|where|how|is|are|isn't|aren't|do|does|has|have|any|anyone|anybody)\b"
    r"|.*\?\s*$"
)
_PAST_YOU = re.compile(
    r"you(?!(?: are|'re)? (?:needed|wanted|expected|supposed|to)\b)(?:'re|'ve"
    r"|'d)?(?: (?:are|were|have|had|did|just))? ?"
    r"(?:went|drove|came|found|saw|looked|checked|were|was|did|been|have|had|are|\w+ed|always|never"
    r"|keep|know|look(?:ed)? (?:so|good|great|nice))\b"
)
_NOT_CALLED = re.compile(
    r"(?:thanks?|thank you|good \w+|bye|goodbye|careful|listen|look|wait|stop|fast|faster|now"
    r"|there|here|later|dear|cheers|great|fine|sure|anyway|alright|all right)\b"
)
_FILLS = re.compile(
    r"\b(?:the|a|an|my|our|your|please|pls|now|ok|okay|hey|hi|hello|robot|pons|and|or|then|quick"
    r"|quickly|slowly|again|too|also|next|just|um+|uh+|er+|hm+|oh|well|yes|no|right|there|in|at|on"
    r"|by|of|to|kindly|i think|i guess|maybe|perhaps|actually|sorry|instead|not|rather|thanks"
    r"|thank you|i (?:said|mean|meant))\b"
    r"|我说的?|[请吧呢啊呀的了嘛哦嗯那就是不和跟与、里间边上儿]|一下|麻烦|好的|不对|谢谢|现在|马上"
    r"|机器人|先|再|最后|快点|[^\w]+"
)
"""What may stand beside a bare name."""

_OPENS_ZH = re.compile(
    r"(?:[能可会]不[能可会](?:以)?|快[点些]|慢?一[点些下]|慢[点些]"
    r"|[嗯哦啊喂嘿哎唉那请你您快先再又也就都还得该能会别\s]|那个|好[的了]?|不对|不是|而是|是|对了|麻烦|拜托|劳驾"
    r"|机器人|帮我?个?忙?|给我|替我|赶紧|赶快|马上|立刻|现在|然后|接着|之后|最后|以后|直接"
    r"|最好|要不然?|不如|否则"
    r"|能不能|可不可以|可以|可否|能否|应该|需要|要|记得|继续|慢慢地?|悄悄地?|一起|自己|分别"
    r"|依次|每[^,，去看]{1,4}"
    r"|我(?:想|要|希望|需要)(?:让|叫|请)?[你您]|我(?:是|刚)?说(?:的是)?|我的意思是|改成"
    r"|换成|咱们?|顺便|一会儿?"
    r"|从[^,，去到]{1,8}(?=去|到)|[在往向朝]|用[^,，]{1,4}|按[^,，]{1,6}|以[^,，]{1,6})"
)
_ORDER_ZH = re.compile(
    r"(?!看起?来|看上去"
    r"|看样子)(?:[去到进回来找查数转跟走巡送带接停站靠绕逛溜过开看瞧盯睇返往朝驶问叫喊讲念等待留跑退掉拿取"
    r"移躲歇睡躺躲让候陪抵穿搜寻巡环观描介通追随左右向原面后继充拍领引出前直倒统导充]|前[往进面]|说(?!呢|得|不定)|告诉|通知|检查|环顾|探索|观察|打|把|如果|要是|假如|万一|若"
    r"|除[了非]|只要|当|直到|[一二两三四五六七八九十\d](?!点))"
)
_UPON_ZH = re.compile(rf"(?:[就便则再]|的话|以后)(?:你|{_ORDER_ZH.pattern})")
_IF_ZH = re.compile(r"要是|如果|假如|的话")
_OTHER_ZH = re.compile(rf"(?:{NAMES_ZH}|孩子们?|宝宝们?|大家|同学们|妈|爸|\w{{1,3}}们)")
_PAST_ZH = re.compile(
    r"[你您](?:刚才?|昨[天晚]|前天|上[回次]|之前|已经|早上|今天|平时|老是?|经过)|^(?:谢谢"
    r"|感谢|多谢)|辛苦|过(?:吗|没|了|的|$)"
    r"|[你您][^,，]{0,4}真|[去来]的$|到了[我你他她]|[哪怎]么?(?:个|走)"
)
_ASKS_ZH = re.compile(r".*(?:吗|呢|没有?|什么|谁|哪|多少|几|怎|啥|[？?])|.*([^\W\d])[不没]\1")


def moods_of(text: str, vocabulary: Vocabulary) -> tuple[tuple[str, Mood], ...]:
    """Return the clauses of a text, each with what it does."""
    found: list[tuple[str, Mood]] = []
    called = False
    for clause in _ENDS.split(plain(text)):
        words = clause.strip(" '\"“”")
        if not words:
            continue
        mood = _mood(words, vocabulary)
        if mood is Mood.CALL:
            called = True
        elif called and mood is Mood.ORDER:
            mood = Mood.STATEMENT
        found.append((words, mood))
    return tuple(found)


def _mood(clause: str, vocabulary: Vocabulary) -> Mood:
    rest = _strip(clause, _OPENS)
    if rest and _VERB_FIRST.match(rest):
        return Mood.ORDER
    chinese = re.search(r"[\u3400-\u9fff]", clause) is not None
    if _is_bare(clause, vocabulary):
        return Mood.ORDER
    return _mood_zh(clause, vocabulary) if chinese else _mood_en(clause, rest, vocabulary)


def _mood_en(clause: str, rest: str, vocabulary: Vocabulary) -> Mood:
    if not rest:
        return Mood.ORDER if _OPENS.match(clause) and "wait" in clause else Mood.STATEMENT
    first = rest.split(" ", maxsplit=1)[0]
    named = bool(places_named(rest, vocabulary))
    if is_given_name(rest) or (rest.count(" ") == 0 and _is_call(rest, named)):
        return Mood.CALL
    if is_given_name(first):
        return Mood.STATEMENT
    if _ASKS_PAST.match(rest) or _PAST_YOU.match(rest):
        return Mood.STATEMENT
    while (led := _named_first(rest, vocabulary)) != rest:
        rest = led
    asked = _TO_YOU.match(rest)
    if asked is not None:
        verb = _strip(rest[asked.end() :].strip(), _OPENS)
        return (
            Mood.ORDER
            if _ORDER_EN.match(verb) or _is_bare(verb, vocabulary)
            else Mood.QUESTION
            if _ASKS.match(rest)
            else Mood.STATEMENT
        )
    if _ASKS.match(rest) and not re.match(r"(?:do|have) (?:a|an|the|one|your|it)\b", rest):
        return Mood.QUESTION
    return Mood.ORDER if _ORDER_EN.match(rest) else Mood.STATEMENT


def _named_first(rest: str, vocabulary: Vocabulary) -> str:
    """Return what follows "the study and", the rest of a list that an order has begun."""
    places = find_places(rest, vocabulary)
    if not places or not re.fullmatch(r"(?:(?:the|my|our) )?", rest[: places[0].start]):
        return rest
    joined = re.match(r" (?:and|or|then|please)\b ?", rest[places[0].end :])
    return rest[places[0].end + joined.end() :] if joined is not None else rest


def _is_call(word: str, named: bool) -> bool:
    return not (named or _NOT_CALLED.match(word) or _ORDER_EN.match(word) or _TO_YOU.match(word))


def _mood_zh(clause: str, vocabulary: Vocabulary) -> Mood:
    if _OTHER_ZH.fullmatch(clause.strip("啊呀哎,， ")):
        return Mood.CALL
    other = _OTHER_ZH.match(clause)
    if other is None and not clause.startswith("我") and _UPON_ZH.search(clause):
        return Mood.ORDER
    if other is not None:
        if _IF_ZH.search(clause):
            return Mood.ORDER
        return Mood.QUESTION if _ASKS_ZH.match(clause) and "去" not in clause else Mood.STATEMENT
    if _PAST_ZH.search(clause):
        return Mood.STATEMENT
    rest = _strip(clause, _OPENS)
    asked = _TO_YOU.match(rest)
    rest = rest[asked.end() :] if asked is not None else rest
    while True:
        places = find_places(rest, vocabulary)
        if places and places[0].start == 0:
            rest = re.sub(
                r"^(?:那?[里边儿上个面]|之间|中间|的|和|跟|与|、)+", "", rest[places[0].end :]
            )
            continue
        opened = _OPENS_ZH.match(rest)
        if opened is None or not opened[0]:
            break
        rest = rest[opened.end() :]
    if _ORDER_ZH.match(rest):
        return Mood.ORDER
    return Mood.QUESTION if _ASKS_ZH.match(clause) else Mood.STATEMENT


def _strip(text: str, opener: re.Pattern[str]) -> str:
    while (found := opener.match(text)) is not None and found.end():
        text = text[found.end() :].strip()
    return text


def orders_anything(texts: Sequence[str], vocabulary: Vocabulary, *, by_question: bool) -> bool:
    """Return whether any part of what a person said orders the robot, or is a bare name.

    Args:
        texts: order and answers, whole.
        vocabulary: whose names are no words of their own.
        by_question: a question counts, too: the step is one by which questions are answered.
    """
    counts = {Mood.ORDER, Mood.QUESTION} if by_question else {Mood.ORDER}
    return any(mood in counts for text in texts for _, mood in moods_of(text, vocabulary))


_STILL = re.compile(
    r"(?:please |just |you )*(?:wait|stay|stop|say|remind|stand still)\b"
    r"|[请你就先]*(?:[等待说念停别站]|留在)"
)


_CORRECTS = re.compile(
    r"(?:[,.;!|]|^) *(?:no|nope|oh no|sorry)\b[ ,]*(?=(?:wait|no|i |the |to |make|rather|go|not)\b)"
    r"|不对[,，]?|错了[,，]?"
)
"""What stands before it is taken back where a place follows."""
_OWN_WAY = re.compile(
    r"(?:i|we)(?:'m|'re|'ll| am| are| will| need| have to| must| might| may| want to| gotta"
    r"| got to) "
    r"(?!you\b)|我们?(?:先|要|去|得|马上|一会|正|自己)"
)
"""A person's own way is no place to seek anything for them."""


def cut_statements(text: str, vocabulary: Vocabulary) -> str:
    """Cut the clauses in which a place is only spoken of, unless the order leans on them.

    "Grandma is in the bedroom, go and see" leans on the statement, since its order names no place;
    "wait here, I am going to the bathroom" does not: its order leads nowhere.
    """
    for found in reversed([*_CORRECTS.finditer(text)]):
        if places_named(text[found.end() :], vocabulary):
            text = text[found.end() :]
            break
    clauses = [each for each in moods_of(text, vocabulary) if not _OWN_WAY.match(each[0])]
    orders = [words for words, mood in clauses if mood is not Mood.STATEMENT]
    leads = [words for words in orders if not _STILL.match(words)]
    leans = bool(leads) and not any(places_named(words, vocabulary) for words in leads)
    return " | ".join(words for words, _ in clauses) if leans else " | ".join(orders)


def _is_bare(text: str, vocabulary: Vocabulary) -> bool:
    places = find_places(text, vocabulary)
    for place in reversed(places):
        text = f"{text[: place.start]} {text[place.end :]}"
    return bool(places) and not _FILLS.sub("", text)
