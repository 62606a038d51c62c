"""Prepare a sentence for its second reading: in plainer words, and no word lost that holds it back.

Beside the tables of ``everyday`` stand here the questions whose "if" hangs nothing on anything, and
which words hold an order back.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator

from planner.language.dialect import in_standard_words
from planner.language.folding import CHINESE as HAN
from planner.language.folding import has_chinese
from planner.language.grammar.asides import tells_where, without_asides
from planner.language.grammar.checks import without_compounds
from planner.language.grammar.en import told_words as english_told_words
from planner.language.grammar.en.courtesy import COURTESY as EN_COURTESY
from planner.language.grammar.en.everyday import ENGLISH_EVERYDAY, TOLD_TWICE
from planner.language.grammar.en.looser_phrases import LOOSER, LOST_THINGS, ONE_TURN
from planner.language.grammar.en.orders import ENGLISH
from planner.language.grammar.everyday import rewrite
from planner.language.grammar.excepted_rooms import without_excepted_rooms
from planner.language.grammar.lexicon import MARK, NAME, lexicon_of
from planner.language.grammar.self_correction import take_last_word
from planner.language.grammar.sentence_text import normalise
from planner.language.grammar.zh.drive_phrases import DRIVE_PHRASES
from planner.language.grammar.zh.everyday import ASKED_AND_SENT, CHINESE_EVERYDAY
from planner.language.grammar.zh.everyday import COURTESY as ZH_COURTESY
from planner.language.grammar.zh.left_out_phrases import without_left_out_rooms
from planner.language.grammar.zh.look_phrases import LOOK_PHRASES
from planner.language.grammar.zh.orders import CHINESE
from planner.language.grammar.zh.seen_phrases import looks_first
from planner.language.grammar.zh.told_words import (
    quote_told_words,
    quote_words_for_me,
    say_why_called,
)
from planner.language.grammar.zh.until_phrases import without_known_ends
from planner.plan import AnswerPlan, Clarify, Code, Refuse, StepPlan, Vocabulary

_NAMED = re.compile(rf"[^{HAN}]{{0,8}}{MARK}[呢吗么]?[?]+")


def end_anyhow(text: str) -> str:
    """Return a Chinese text without what its order does anyhow: 找到为止, 开着就告诉我."""
    said = normalise(text)
    plain = looks_first(without_known_ends(said)) if has_chinese(text) else said
    return text if plain == said else plain


def without_sending(text: str) -> str:
    """Return "how many chairs are there, go and count" without its end, which Chinese says so.

    Likewise one turn that is told twice: "turn round and face the other way"; and in Chinese an end
    that an order has anyhow, "until it is found".
    """
    said, ended = normalise(text), normalise(end_anyhow(text))
    plain = rewrite(ended, ASKED_AND_SENT if has_chinese(text) else (*TOLD_TWICE, *ONE_TURN))
    return text if plain == rewrite(said, ()) else plain


_SPEAKS = re.compile(
    r"[^,.;!?。]*?(?:[\"“”「」]|(?:说|讲)(?!说|讲)|[问喊叫念]|告诉|提醒|通知|转告|回答|带(?:个|句)话|如果|要是)"
)
_REPORTS = re.compile(
    r"(?:告诉|通知|[跟和向给对])我们?(?:说说|讲讲|说|讲|报告|汇报)?|(?:说说|讲讲|说一下)(?=你|看)"
    r"|(?:回来|过来)(?:后|再|就)*(?:说说|讲讲)"
)
"""Words for the speaker: what follows is no speech."""
_MOST_SAID = 120
"""Characters; nobody says more in one breath, and the rows take longer the longer a clause is."""
_ASKS_IF_DONE = re.compile(r"(?<![关开锁亮灭熄停拔盖好上住掉])[了过][吗么][?。!]*$")
"""全屋走一遍了吗 orders nothing; 大门锁了吗 is looked at."""
_AFTER_SPEECH = re.compile(
    r"(?<=[,。])(?:你)?[说讲问叫喊]完(?:了|以后|之后|后)?[,]?(?:就|再|然后)*(?=[回充]|过来)"
)


def in_order_words(text: str, vocabulary: Vocabulary) -> str:
    """Return a Chinese text with each clause in the grammar's own words of order.

    Nothing is changed from the clause on that speaks to somebody, quotes, or opens a condition: its
    words may be said to others.
    """
    said = normalise(text)
    if not has_chinese(said) or len(said) > _MOST_SAID or _ASKS_IF_DONE.search(said):
        return text
    marked = lexicon_of(vocabulary).mark(said)
    own = _AFTER_SPEECH.sub("然后", marked.text)
    speech = _SPEAKS.search(_REPORTS.sub(lambda found: "〇" * len(found[0]), own))
    start = speech.start() if speech is not None else len(own)
    looks = rewrite(own[:start], LOOK_PHRASES)
    plain = rewrite(looks, DRIVE_PHRASES)
    plain = plain if plain == looks else rewrite(plain, LOOK_PHRASES)
    if plain and start < len(own) and own[start - 1] in ",.;!?。":
        plain += own[start - 1]
    plain += own[start:]
    return text if plain == own == marked.text else marked.restore(plain)


Read = Callable[[str], StepPlan | AnswerPlan | Clarify | Refuse]
_LOST = frozenset({Code.NOT_UNDERSTOOD, Code.UNKNOWN_PLACE})


_OTHER_WORDS = _LOST | {
    Code.NO_CAPABILITY, Code.AMBIGUOUS, Code.INCOMPLETE, Code.CONDITIONAL, Code.OBJECT_UNKNOWN,
}  # fmt: skip


def read_in_order_words(
    text: str, vocabulary: Vocabulary, read: Read
) -> StepPlan | AnswerPlan | Clarify | Refuse:
    """Return the plan of a text by the person's words, else by the standard words for them."""
    made = _read_in_order_words(text, vocabulary, read)
    if isinstance(made, StepPlan | AnswerPlan) or made.code not in _OTHER_WORDS:
        return made
    standard = in_standard_words(text)
    if standard == text:
        return made
    other = _read_in_order_words(standard, vocabulary, read)
    offers = isinstance(other, Clarify) and other.options and not getattr(made, "options", ())
    return other if isinstance(other, StepPlan | AnswerPlan) or offers else made


def _read_in_order_words(
    text: str, vocabulary: Vocabulary, read: Read
) -> StepPlan | AnswerPlan | Clarify | Refuse:
    """Return the plan of a text by the grammar's own words of order, else by the person's.

    It is asked about in the person's words, but where only the others tell what is missing.
    """
    told = quote_words_for_me(quote_told_words(say_why_called(text)), vocabulary)
    text = without_left_out_rooms(told, vocabulary)
    plain = in_order_words(text, vocabulary)
    made = read(plain)
    if plain == text or isinstance(made, StepPlan | AnswerPlan):
        return made
    own = read(text)
    lacks = made.code is Code.INCOMPLETE and getattr(own, "code", None) in _LOST
    return made if lacks else own


def leave_asides_out(text: str, vocabulary: Vocabulary) -> str | None:
    """Return a sentence without what it takes back, courtesy, praise and statements of how things
    stand; None where it has none of them.
    """
    marked = lexicon_of(vocabulary).mark(normalise(text))
    left = without_asides(take_last_word(marked.text) or marked.text)
    return marked.restore(left) if left != marked.text else None


def in_plain_words(text: str, vocabulary: Vocabulary) -> str | None:
    """Return a sentence in the grammar's own words; None where there are none, or where a word in
    it holds orders back: what is taken away must carry no meaning.
    """
    said = normalise(text)
    chinese = has_chinese(said)
    courtesy, phrases = (
        (ZH_COURTESY, CHINESE_EVERYDAY) if chinese else (EN_COURTESY, (*LOOSER, *ENGLISH_EVERYDAY))
    )
    marked = lexicon_of(vocabulary).mark(said)
    willing = rewrite(marked.text, courtesy)
    if willing.rstrip().endswith("?") and _NAMED.fullmatch(willing):
        return None  # "the kitchen?" asks
    if tells_where(willing):
        return None
    rewritten = rewrite(willing, phrases)
    if not held_back(willing) <= held_back(rewritten):
        return None
    plain = marked.restore(rewritten)
    return plain if plain and plain != said else None


def in_other_words(text: str, vocabulary: Vocabulary, *, plainer: bool) -> Iterator[str]:
    """Yield a sentence in other words: its told words quoted, its asides left out, plainer."""
    quoted = english_told_words.quote_told_words(text)
    if quoted is not None:
        yield quoted
    lexicon = lexicon_of(vocabulary)
    marked = lexicon.mark(normalise(text))
    others = without_excepted_rooms(marked, lexicon, vocabulary)
    if others is not None:
        yield others
    sought = rewrite(marked.text, () if has_chinese(text) else LOST_THINGS)
    if sought != rewrite(marked.text, ()):
        yield marked.restore(sought)
    ordered = leave_asides_out(text, vocabulary)
    if ordered is not None:
        yield without_sending(ordered)
    for said in (text, ordered) if plainer else (ordered,):
        plain = in_plain_words(said, vocabulary) if said is not None else None
        if plain is not None:
            yield plain


def held_back(text: str) -> Counter[str]:
    """Return the words of a sentence that deny, except, leave a choice, hang it on something or
    name a speed.
    """
    looked_at = without_compounds(asks_whether(text))
    vetoes = (*ENGLISH.vetoes, *CHINESE.vetoes)
    return Counter(found[0] for _, veto in vetoes for found in veto.finditer(looked_at))


_WHETHER = re.compile(
    r"\b(tell (?:me|us)|check(?:ing)?|see(?:ing)?|look(?:ing)?|find(?:ing)? out|report"
    r"|let (?:me|us) know"
    rf"|ask(?: (?:him|her|them|(?:every|any|some)(?:one|body)|{NAME}|(?:(?:the|my|our|a) )?[a-z]+)"
    rf"(?: (?:in|at|on|by|near) (?:the )?(?:{MARK}|[a-z]+(?: room)?))?)?) (?:if|whether)\b"
    r"|(?<=[看查认下])(?:一下|看)?(?:是否|是不是|有没有)"
)


_WHEN_THEY = re.compile(
    rf"(\bask (?:him|her|them|{NAME}|(?:(?:the|my|our) )[a-z]+)"
    rf"(?: (?:in|at|on|by|near) (?:the )?(?:{MARK}|[a-z]+(?: room)?))?) when"
    r"(?= (?:he|she|they)(?:'s| is|'re| are|'ll| will| can| wants?| needs?| has| have)\b"
    r"(?! (?:back|here|there|home|in|up|awake|done|ready)\b)"
    r"(?![^,.;!?]*\b(?:if|whether|what|how|where|who|why|to)\b)[^,.;!?]*(?:[.!?]|$| and ))"
)
"""What is asked of somebody: "ask him when he's free"; before a question it is when to ask."""


_WHOEVER = re.compile(r"(?:(?<=\btell )|(?<=\bask ))whoever(?: is|'s)(?= (?:in|at|on|by|near)\b)")
"""Whoever is there is told or asked: no condition."""

_A_NOT_A = re.compile(r"((?:看|查|确认|问)[^,。;!?]*?)([^,。;!?])不\2")
"""看看她在不在: to be looked at, no negation."""

_DONE_OR_NOT = re.compile(
    r"((?:看|查|确认|问)[^,。;!?]*?(?:[着了完好过]|回来|回家|到家|起床|起来))没有?(?=[,。;!?]|$)"
)
"""看看电视开着没有, 看看门关了没: likewise."""

_ASKS_THEM = re.compile(r"(问[^,。;!?]{0,12}?)(?:要不要|想不想|是不是|是否|能不能|有没有|需不需要)")
"""问问妈妈要不要喝茶: asked of somebody, no condition."""


def asks_whether(text: str) -> str:
    """Return the text without the "if" of a question that looking answers: no condition."""
    plain = _DONE_OR_NOT.sub(r"\1", _A_NOT_A.sub(r"\1\2", _ASKS_THEM.sub(r"\1要", text)))
    plain = _WHOEVER.sub("them", _WHEN_THEY.sub(r"\1", plain))
    return _WHETHER.sub(lambda found: found[1] or "有", plain)
