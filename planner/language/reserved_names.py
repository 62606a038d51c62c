"""Tell whether a would-be name of a place reads as an order, a denial or a condition. Pure.

Names are found in a sentence before anything else is read, so a name made of such words would take
them out of every later sentence: with a place called "do not", "do not go there" would lose its
negation.
"""

from __future__ import annotations

import re

from planner.language.commands.parser import intent_of
from planner.language.folding import has_chinese
from planner.language.grammar import Context, plan
from planner.language.grammar.sentence_text import normalise
from planner.language.object_classes import KINDS
from planner.language.object_names import canonical
from planner.language.stop import StopReading, is_stop, read_stop
from planner.plan import RUNNABLE, Clarify, Code, Plan, Refuse, Vocabulary

_HARMLESS = frozenset(
    {Code.UNKNOWN_PLACE, Code.NOT_UNDERSTOOD, Code.NO_CAMERA, Code.NO_CAPABILITY, Code.AMBIGUOUS}
)
_FUNCTION = re.compile(
    r"\b(?:and|or|then|to|from|into|please|not|no|go|come|drive|move|wait|back|here|there|it|home"
    r"|base|all|everything|everywhere|me|you|stop|first|last|left|right|forwards?|around)\b"
    r"|然后|接着|之后|以后|之前|以前|或者|还是|如果|要是|跟着|跟我|提醒|[别不没勿莫]"
)
_ALONE = re.compile(
    r"(?:[去到来回走停等请先再就把的里了吧吗我你他她它这那家和跟与])+|这里|那里|原地"
)

_WORDS = """
a about after again all am an and another any anything anybody anyone are as at away be been
before behind beside between both but by can could did do does down each either else every
everybody everyone everything everywhere few for from had has have he her here hers hey him
his how i if in inside into is it its just many may maybe me might mine more most much must
my near neither never next no nobody none nor not nothing now nowhere of off on once one
only onto or other our ours out outside over own past please shall she should since so some
somebody someone something somewhere still such than thanks that the their theirs them then
there these they this those through till to too towards twice under until up us very was we
well were what whatever when whenever where wherever whether which while who whoever whom
whose why will with without would yes yet you your yours ah aah ow ouch oh help hello hi
watch look emergency danger careful battery time times two three four five six seven eight
nine ten day days week weeks month months year years hour hours minute minutes second
seconds today tomorrow yesterday tonight morning noon afternoon evening night midnight
monday tuesday wednesday thursday friday saturday sunday say said see seen saw tell told
last first s
"""
_CLOSED = frozenset(_WORDS.split())
"""Words that a sentence needs for itself: its frame, its questions, its cries and its times."""
_DOES = (
    r"做饭|做菜|做作业|写|炒菜|煮|烧|切菜|吃饭|吃|喝|睡觉|睡|午睡|洗|打扫|扫地|拖地|擦|收拾|整理|忙|工作|[上下]班|加班|[上下]课|上学|上网|上厕所"
    r"|开会|考试|学习|休息|玩|打电话|打游戏|打牌|练|弹琴|画画|看书|看片|追剧|直播|拍|化妆|换|出门|出差|出发|出去|起床|运动|健身|锻炼|赶|晒|浇"
    r"|遛狗|买菜|接电话|搬|装修|哭|闹|聊天|听课|听歌|照顾"
)
_CLOSED_ZH = re.compile(
    rf"(?:{_DOES}|什么|哪[里儿个]?|谁|怎么样?|为什么|几|多少|几点|时间|电池|电量|每[天周月年]|[今明昨后][天晚]"
    r"|早上|上午|中午|下午|晚上|夜里|现在|马上|所有|全部|大家|东西|地方|小心|危险|救命|[啊哎喂嘿哦嗯]"
    r"|[一二三四五六七八九十]|星期|周末|时候|外面)+"
)


def name_is_needed_elsewhere(name: str) -> bool:
    """Tell whether sentences need a would-be place name as a word, or the detector as a thing.

    A sofa may well be a place to drive to; a cup or a person is not where it was.
    """
    plain = normalise(name)
    kind = KINDS.get(canonical(plain))
    if kind is not None and (kind.mobile or kind.perched):
        return True
    single = len(plain) == 1 and has_chinese(plain)
    words = plain.split()
    closed = bool(words) and all(word in _CLOSED for word in words)
    stops = read_stop(name) is not StopReading.NONE
    return single or closed or stops or _CLOSED_ZH.fullmatch(plain) is not None


def name_reads_as_order(name: str, vocabulary: Vocabulary) -> bool:
    """Tell whether a name must not be taught, given what the names of today are."""
    plain = normalise(name)
    if _FUNCTION.search(plain) or _ALONE.fullmatch(plain):
        return True
    if name_is_command(name):
        return True
    sentences = (name, f"go to the {name}", f"去{name}")
    can = Context(runnable=RUNNABLE | vocabulary.calls)
    return not all(_harmless(plan(sentence, vocabulary, can)) for sentence in sentences)


def name_is_command(name: str) -> bool:
    """Tell whether a name said alone stops, pauses or otherwise commands the planner."""
    return is_stop(name) or intent_of(name) is not None


def _harmless(read: Plan) -> bool:
    """Tell whether a sentence without this name means nothing by itself."""
    return isinstance(read, (Clarify, Refuse)) and read.code in _HARMLESS
