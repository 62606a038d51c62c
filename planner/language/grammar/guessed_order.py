"""Guess what a sentence may mean, by the intent model: an order in the grammar's words, or talk.

Laws: every place that the sentence names is in the order, and no other; things and words are told
in the sentence's own; what holds an order back (a denial, a condition, a choice) is never guessed
past. The order is read as any sentence is, and then asked about: nothing moves by a guess. A
question to memory drives nothing and needs no yes.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from itertools import groupby
from typing import TYPE_CHECKING, Literal

from planner.language.catalogue import say
from planner.language.commands import intent_of
from planner.language.grammar.checks import withholds_offers, without_compounds
from planner.language.grammar.en.orders import ENGLISH
from planner.language.grammar.lexicon import MARK
from planner.language.grammar.questions_whether import asks_whether
from planner.language.grammar.zh.orders import CHINESE
from planner.language.intent.features import MOST_UNITS, units_of
from planner.language.intent.intent_model import THING, WORDS, load_intent_model
from planner.plan import (
    AnswerPlan,
    Clarify,
    Code,
    Language,
    Option,
    Recall,
    Refuse,
    StepPlan,
    say_same,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from planner.plan import Step

    ReadsOrder = Callable[[str], StepPlan | AnswerPlan | Clarify | Refuse]
    NamesSteps = Callable[[Sequence[Step]], Option]

    from planner.language.grammar.lexicon import MarkedText
    from planner.language.intent.intent_model import Guess

SURE = 0.3
"""From here on an order is offered: of sentences of writers who were kept away in training, half of
the orders are guessed right, and one guess in four is wrong; people say no to those."""
SURE_OF_TALK = 0.6
"""From here on a sentence is taken for talk, or for what the robot can't do: nothing moves."""

NONE, REFUSED, RECALLED = "none", "refuse", "recall"
ORDERS: dict[str, tuple[str, str]] = {
    "go": ("go to {p}", "去{p}"),
    "go_go": ("go to {p} and then to {q}", "先去{p}再去{q}"),
    "look": ("go to {p} and look around", "去{p}看看"),
    "look_here": ("look around", "看看周围"),
    "look_look": ("look around {p}, then look around {q}", "去{p}看看,再去{q}看看"),
    "look_back": ("look around {p} and come back", "去{p}看看再回来"),
    "find_at": ("find {t} in {p}", "去{p}找{t}"),
    "find_find": ("find {t} in {p}, then find {t} in {q}", "去{p}找{t},再去{q}找{t}"),
    "find": ("find {t}", "找{t}"),
    "count_at": ("count {t} in {p}", "数一下{p}的{t}"),
    "count_here": ("count {t} here", "数一下这里的{t}"),
    "person_at": ("is anyone in {p}?", "看看{p}有没有人"),
    "person": ("find a person", "找人"),
    "go_say": ('go to {p} and say "{w}"', "去{p}说“{w}”"),
    "go_ask": ('go to {p} and ask "{w}"', "去{p}问“{w}”"),
    "person_say": ('find a person and say "{w}"', "找到人,说“{w}”"),
    "person_ask": ('find a person and ask "{w}"', "找到人,问“{w}”"),
    "go_wait_for": ("go to {p} and wait until somebody comes", "去{p}等到有人来"),
    "follow": ("follow me", "跟着我"),
    "home": ("go home", "回家"),
    "back": ("come back", "回来"),
    "go_back": ("go to {p} and come back", "去{p}再回来"),
    "go_wait": ("go to {p}", "去{p}"),
    "rounds": ("patrol all rooms", "巡逻所有房间"),
    "turn": ("turn around", "转身"),
    "round": ("turn 360 degrees", "转360度"),
    "left": ("turn left", "左转"),
    "right": ("turn right", "右转"),
    "forward": ("move forward a bit", "往前走一点"),
    "backward": ("back up a bit", "后退一点"),
}
"""By intent, in both languages; an intent that is not here asks for no drive."""
REMEMBERS: dict[str, tuple[str, str]] = {
    RECALLED: ("where did you last see {t}?", "你最后在哪里看到{t}?"),
}
"""What memory is asked: it drives nothing, and waits for no yes."""
COMMANDS: dict[str, tuple[str, str]] = {
    "slower": ("slow down", "慢一点"),
    "faster": ("faster", "快一点"),
    "resume": ("go on", "继续"),
    "remember": ("remember that {s}", "记住{s}"),
}
"""What the planner itself does upon a yes; ``{s}`` is the sentence."""
OTHERS = (NONE, REFUSED, "other", "order", "orders", "forget", "stop", "cancel")
"""What else a sentence may be: no drive is offered then."""
_AMOUNT = re.compile(
    r"(?:(?:just|an?|one|another|tiny|wee|bit|little|tad|touch|inch|more|further|farther|closer"
    r"|nearer|some|again|yet|still|and|then|go|keep|going|please|,)(?: |$)?)+"
    r"|[再来多一点儿些还要近靠过去往前吧, ]+"
)
"""How much more, and nothing of what: "a bit more" is no wish to go faster, or to turn."""
_TURNS = ("turn", "left", "right")
_SIDES = {"left": r"\bleft\b|左", "right": r"\bright\b(?! ?,| now| away| here| there)|右"}
_SLIGHT = re.compile(r"\b(?:bit|little|touch|tad|slightly)\b|一[点些丢]|稍|略|偏")
_SLIGHTLY = {
    "left": ("turn left 30 degrees", "左转30度"),
    "right": ("turn right 30 degrees", "右转30度"),
}
"""By "a bit" people mean 15 to 45 degrees; the button says how far."""
_PLACE_SLOTS = ("{p}", "{q}")
_DENIES_NOTHING = re.compile(
    r"不知道?|不晓得|不清楚|[找看]不[着到见]|不见了|不早了|不放心|不好意思|走不[开动]|腿脚不好|忙不过来|听不清"
    r"|要不(?=你|咱|我们)|差不多"
    # A-not-A asks; 没 tells what was not; 看不见 tells what can't be
    r"|([^\s,.;!?。])[不没]\1|没(?!必要|[叫让]你)|[看听弄找弯站够记睡坐赶认想起抬拿]不(?:[见到清懂了动下起着住出来及过完]|得(?!进))"
    r"|不(?:太|大|怎么)?(?:踏实|舒服|方便|安|对劲|亮|响|转|够|在|安心|好使|利索|灵|稳|敢|信|记得|着急)"
    r"|[扑冒搜找跑想翻认露掉漏]出来|还不出来|滚(?=[到在进着了去])|忘(?:了|记)?(?=[带拿关锁在放])"
    r"|\b(?:can ?not|could not) (?:for the life of (?:me|us) )?"
    r"(?:find|see|reach|get up|walk|leave|come|hear|tell|bend|move|stand|sleep|remember|think)\b"
    r"|\b(?:do|does|did) not (?:know|remember|see|feel well)\b|\bnot sure\b"
    r"|\bno (?:idea|clue|sign|luck|rush|hurry|sound|noise|answer|dawdling|messing)\b"
    r"|(?<=[a-z] )(?<!you )(?:am|is|are|was|were|has|have|had|does|did) not\b"
    r"(?! (?:to|allowed|for you|want|like|need|let|wish))"
    r"|\bnobody (?:has|is|was|did)\b|\b(?:all|be|sits?|sitting|is) alone\b"
    r"|\bwhile (?=i|we|she|he|they|it|the|my)\b|\bwhoever(?: is|'s)?\b"
    r"|\b(?:know|wonder|wondering|sure|tell|see|check) if\b"
)
"""Said of a person, of what is lost or of how things stand, it forbids nothing."""
_OWN = re.compile(r"^(?:(?:the|a|an|my|our|your|any|some) )+")
_TIGHT = re.compile(r" ([,.;:?!])")


class GuessKind(StrEnum):
    """Say what a sentence may be."""

    ORDER = "order"
    """Laid before the person, and done upon a yes."""
    COMMAND = "command"
    """Likewise, a word to the planner itself."""
    RECALL = "recall"
    """Asked of memory at once: it drives nothing."""
    REFUSED = "refused"
    """More than wheels and a camera can do."""
    TALK = "talk"
    """It asks for nothing."""
    OTHER = "other"
    """Something else: it would be silly to offer a drive to the place that it names."""


@dataclass(frozen=True, slots=True)
class GuessedMeaning:
    """Hold what a sentence may mean, and the plain words of an order or a question to memory."""

    kind: GuessKind
    order: str = ""


def guess_meaning(marked: MarkedText, language: Language) -> GuessedMeaning | None:
    """Return what a marked sentence may mean; None: not guessed."""
    units, model = units_of(marked.text), load_intent_model()
    if model is None or not 0 < len(units) <= MOST_UNITS:
        return None
    places = len(set(re.findall(MARK, marked.text)))
    guess = model.guess(units, admit_intents(places))
    if not guess.share >= SURE:
        return None
    if guess.intent in (NONE, REFUSED) and guess.share >= SURE_OF_TALK and not places:
        return GuessedMeaning(GuessKind.TALK if guess.intent == NONE else GuessKind.REFUSED)
    if _AMOUNT.fullmatch(marked.text.strip(" ,.;!。")):
        return GuessedMeaning(GuessKind.OTHER)
    if guess.intent in COMMANDS:
        words = COMMANDS[guess.intent][language is Language.ZH]
        said = marked.restore(marked.text).strip(" ,.;!?。")
        return GuessedMeaning(GuessKind.COMMAND, words.replace("{s}", said))
    if guess.intent in OTHERS:
        return GuessedMeaning(GuessKind.OTHER)
    if guess.intent in ORDERS and _holds_back(marked.text):
        return None
    order = write_order(guess, units, marked, language)
    kind = GuessKind.RECALL if guess.intent in REMEMBERS else GuessKind.ORDER
    return None if order is None else GuessedMeaning(kind, order)


def answer_guess(
    guessed: GuessedMeaning | None, read: ReadsOrder, name: NamesSteps
) -> StepPlan | Clarify | Literal[GuessKind.OTHER] | None:
    """Return what becomes of a sentence that was not understood; None: nothing is guessed.

    Law: a guess that moves is a button below a question, an order that the grammar reads by itself.

    Args:
        guessed: what the sentence may mean.
        read: returns the plan of an order.
        name: returns the button of steps.
    """
    if guessed is None:
        return None
    match guessed.kind:
        case GuessKind.TALK:
            return Clarify(code=Code.NOT_UNDERSTOOD, question=say("grammar.guessed_talk"))
        case GuessKind.REFUSED:
            return Clarify(code=Code.NOT_UNDERSTOOD, question=say("grammar.guessed_beyond"))
        case GuessKind.OTHER:
            return GuessKind.OTHER
        case GuessKind.COMMAND:
            button = Option(label=say_same(guessed.order), text=guessed.order)
            return _offer(button) if intent_of(guessed.order) is not None else None
    meant = read(guessed.order)
    if not isinstance(meant, StepPlan):
        return None
    if guessed.kind is GuessKind.RECALL:
        return meant if all(isinstance(step, Recall) for step in meant.steps) else None
    button = name(meant.steps)
    return _offer(button) if isinstance(read(button.text), StepPlan) else None


def _offer(button: Option) -> Clarify:
    question = say("grammar.guessed", order=button.label)
    return Clarify(code=Code.NOT_UNDERSTOOD, question=question, options=(button,))


@cache
def admit_intents(places: int) -> frozenset[str]:
    """Return the intents that a sentence may have which names so many places."""
    orders = {
        intent
        for intent, (form, _) in ORDERS.items()
        if sum(slot in form for slot in _PLACE_SLOTS) == places
    }
    return frozenset({*orders, *REMEMBERS, *COMMANDS, *OTHERS})


def _holds_back(text: str) -> bool:
    """Tell whether a sentence denies, excepts, hangs on something or leaves a choice.

    A speed does not: the order is driven as any is, and the person sees it before.
    """
    plain = _DENIES_NOTHING.sub("〇", text)
    looked_at = without_compounds(asks_whether(plain))
    vetoes = (*ENGLISH.vetoes, *CHINESE.vetoes)
    held = any(veto.search(looked_at) for code, veto in vetoes if code is not Code.OUT_OF_SCOPE)
    return held or withholds_offers(plain)


def write_order(
    guess: Guess, units: list[str], marked: MarkedText, language: Language
) -> str | None:
    """Return the order of a guess; None where a place is left out, or a place or slot lacks."""
    chinese = language is Language.ZH
    intent = _turn_of(guess.intent, marked.text)
    form = {**ORDERS, **REMEMBERS}.get(intent, ("", ""))[chinese]
    named = list(dict.fromkeys(re.findall(MARK, marked.text)))
    if intent in _SIDES and _SLIGHT.search(marked.text):
        form = _SLIGHTLY[intent][chinese]
    wanted = [slot for slot in _PLACE_SLOTS if slot in form]
    left_out = len(named) != len(wanted) and guess.intent not in REMEMBERS
    if not form or left_out or any(len(marked.mention(mark).ids) != 1 for mark in named):
        return None
    written = [marked.mention(mark).written for mark in named]
    for slot, label in (("{t}", THING), ("{w}", WORDS)):
        if slot not in form:
            continue
        words = _longest(label, guess, units, written, chinese=chinese)
        if label == THING:
            words = _OWN.sub("", words)
            words = words if chinese or not words else f"the {words}"
        if not words:
            return None
        form = form.replace(slot, words)
    for slot, name in zip(wanted, written, strict=False):
        form = form.replace(slot, name if chinese else f"the {name}")
    return form


def _turn_of(intent: str, text: str) -> str:
    """Return a guessed turn towards the side that the sentence names, where it names one."""
    sides = [side for side, words in _SIDES.items() if re.search(words, text)]
    return sides[0] if intent in _TURNS and len(sides) == 1 else intent


def _longest(
    label: int, guess: Guess, units: list[str], written: list[str], *, chinese: bool
) -> str:
    """Return the longest run of units with a label, places by their names; "" where none has it."""
    names = {f"<{number}>": name for number, name in enumerate(written)}
    pairs = zip(units, guess.labels, strict=True)
    runs = [
        [names.get(unit, unit) for unit, _ in run]
        for has_label, run in groupby(pairs, lambda pair: pair[1] == label)
        if has_label
    ]
    longest = max(runs, key=len, default=[])
    return "".join(longest) if chinese else _TIGHT.sub(r"\1", " ".join(longest)).strip(" ,.;:")
