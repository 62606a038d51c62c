"""Lay before a person what the learned reader reads in a sentence that no rule reads.

Laws: what moves is one button below a question, with every step told in words; what a sentence
denies is in no offer; a question to memory drives nothing and needs no yes. What the reader is not
sure of is not offered.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from pydantic import ValidationError

from planner.language.catalogue import join, say
from planner.language.grammar.checks import condition_in
from planner.language.grammar.compound_forms import read_hour
from planner.language.grammar.lexicon import lexicon_of
from planner.language.grammar.plan_assembly import quote_part, sentence
from planner.language.grammar.sentence_text import normalise
from planner.language.motion_guard import denied_places
from planner.language.order_sentence import (
    is_order_sentence,
    offer_kept,
    offer_order,
    write_order,
)
from planner.language.recall import read_span
from planner.language.semantic_parser.changed_order import (
    CHANGES,
    change_order,
    name_pointed,
    put_first,
)
from planner.language.semantic_parser.linear_plan import TOKEN_NUMBERS
from planner.language.semantic_parser.parser import parse
from planner.language.semantic_parser.plan_grammar import ALONE
from planner.language.semantic_parser.plan_steps import StepMaker
from planner.language.sentence import parse as parse_sentence
from planner.plan import (
    CONTROL,
    Bilingual,
    Clarify,
    Code,
    Language,
    Option,
    Plan,
    PlanRole,
    Recall,
    Refuse,
    StepPlan,
    check_plan,
    list_nodes,
    places_of,
    say_same,
)
from planner.plan.order_steps import OrderAdd

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.language.grammar.context import Context
    from planner.language.semantic_parser.decoding import ParsedPlan
    from planner.language.semantic_parser.plan_grammar import LabelledPlan, PlanNode
    from planner.plan import Vocabulary

SURE = 0.07
"""From here on a plan is offered: of those offers half are right, and a no costs a word."""
MOST_OFFERED, MOST_TOLD = 3, 250
"""Plans, and characters of the question about them: nobody hears out more."""
FAIRLY_SURE = 0.3
"""From here on where the rules offer a part themselves or see a choice, and of a plan that names
nothing said, as ``turn(around)``: gibberish is read so."""
UNRIVALLED = 0.7
"""From here on the likeliest plan is offered alone, below it with those that come close."""
CLOSE = 0.15
"""Of the likeliest one's confidence: so much another plan needs to be offered beside it."""
_DOUBTED = frozenset({Code.AMBIGUOUS, Code.OUT_OF_SCOPE, Code.NO_CAPABILITY})
UNREAD = frozenset({Code.NOT_UNDERSTOOD, Code.CONDITIONAL, Code.NEGATED}) | _DOUBTED
"""What the rules say of sentences that this may read."""
SURER = 0.6
"""From here on the reader is believed though a rule speaks against it, and what it takes for a
question to memory or for talk is answered without a yes: nothing drives for these."""
_LEAST = dict.fromkeys(_DOUBTED, SURER) | dict.fromkeys((Code.NEGATED, Code.CONDITIONAL), 0.1)
_LEAST[Code.AMBIGUOUS] = FAIRLY_SURE
"""From here on where the rules say why they won't."""
COMMANDS: dict[str, tuple[str, str]] = {
    "slower": ("slow down", "慢一点"),
    "faster": ("faster", "快一点"),
    "resume": ("go on", "继续"),
    "pause": ("pause for a moment", "暂停一下"),
    "cancel": ("cancel the goal", "取消这个任务"),
    "fact": ("remember that {words}", "记住{words}"),
    "forget": ("forget about {words}", "忘掉关于{words}的事"),
    "name_here": ("call this place {words}", "把这里叫做{words}"),
    "here": ("you are in the {words}", "你在{words}"),
}
"""What the planner itself does upon a yes, in words that it reads."""
_TOLD = COMMANDS | {"here": ("take it that I am in the {words}", "当作我在{words}")}
"""In which words a person is asked for that yes."""
HANGING = CONTROL | {"wait_for", "wait"}
"""Steps that wait for something, as the words "until" and "when" ask for."""
_ROLES = {PlanRole.AFTER: "order.after", PlanRole.INSTEAD: "order.instead"}
_ORDERS = frozenset({"at"} | {name for name in ALONE if name.startswith("order")})
"""Forms about standing orders."""
_NEVER_DENIALS = frozenset({"at", "orders", "order_move", "order_resume"})
"""Of these: what a sentence with a denial hardly ever asks for."""
_TALK = {"none": "grammar.guessed_talk", "refuse": "grammar.guessed_beyond"}


@dataclass(frozen=True, slots=True)
class _UnreadSentence:
    """Hold a sentence that no rule reads, and what the rules say of it."""

    told: Clarify | Refuse
    text: str
    vocabulary: Vocabulary
    language: Language
    context: Context

    @property
    def has_offer(self) -> bool:
        """Return whether the rules offer a part of it."""
        return isinstance(self.told, Clarify) and bool(self.told.options)


def offer_plan(
    told: Plan, text: str, vocabulary: Vocabulary, language: Language, context: Context
) -> StepPlan | Clarify | Refuse | None:
    """Return what is laid before a person whose sentence no rule reads; None: nothing.

    Args:
        told: what the rules say of the sentence.
        text: the sentence as it was said.
        vocabulary: of the site.
        language: of the sentence.
        context: what the robot can do.
    """
    if not isinstance(told, Clarify | Refuse) or told.code not in UNREAD:
        return None
    readings = parse(text, vocabulary, most=MOST_OFFERED, least_confidence=SURE * CLOSE)
    if not readings:
        return None
    surest, others = readings[0], readings[1:]
    said = _UnreadSentence(told, text, vocabulary, language, context)
    least = FAIRLY_SURE if said.has_offer else _LEAST.get(told.code, SURE)
    if surest.confidence < least:
        return None
    if surest.plan[0].form in _TALK:
        return _tell_talk(said, surest)
    offer = _offer_reading(said, surest)
    is_choice = told.code is Code.AMBIGUOUS
    if not isinstance(offer, StepPlan) and (is_choice or surest.confidence < UNRIVALLED):
        is_close = isinstance(offer, Clarify) and not is_choice
        least = CLOSE * surest.confidence if is_close else SURE
        close = [each for each in others if each.confidence >= least]
        return _offer_several(said, [offer, *(_offer_reading(said, each) for each in close)])
    return offer


def _offer_several(
    said: _UnreadSentence, offers: Sequence[StepPlan | Clarify | None]
) -> Clarify | None:
    """Return the question which of several plans is meant; the first offer's where there is one."""
    asked = [each for each in offers if isinstance(each, Clarify)]
    shown: list[Option] = []
    for button in (button for each in asked for button in each.options):
        told = {each.label.en for each in shown} | {each.label.zh for each in shown}
        if not told & {button.label.en, button.label.zh}:
            shown.append(button)
    for count in range(min(len(shown), MOST_OFFERED), 1, -1):
        ways = [
            say(f"grammar.way_{at}", order=each.label) for at, each in enumerate(shown[:count], 1)
        ]
        question = join((say("grammar.guessed_several"), *ways))
        if len(question.of(said.language)) <= MOST_TOLD:
            return Clarify(code=said.told.code, question=question, options=tuple(shown[:count]))
    return next((each for each in asked if each.options), *offers[:1])


def _tell_talk(said: _UnreadSentence, read: ParsedPlan) -> Refuse | None:
    """Return that a sentence is taken for talk or is beyond the robot; None: the rules' words stay.

    Nothing is asked, so nothing waits for an answer.
    """
    code = said.told.code
    is_told = code in _DOUBTED or (code is Code.NEGATED and not said.has_offer)
    if read.confidence < SURER or is_told:
        return None
    return Refuse(code=Code.NOT_UNDERSTOOD, reason=say(_TALK[read.plan[0].form]))


def _offer_reading(said: _UnreadSentence, read: ParsedPlan) -> StepPlan | Clarify | None:
    """Return what is laid before a person of one reading; None: what the rules say stays."""
    told, node, is_sure = said.told, read.plan[0], read.confidence >= SURER
    context = said.context
    is_named = any(_said_words(each) for each in read.plan)
    if node.form in _TALK or (not is_named and read.confidence < FAIRLY_SURE):
        return None
    if told.code is Code.NO_CAPABILITY and said.has_offer and node.form not in CHANGES:
        return None  # a part of it is offered
    if told.code is Code.NEGATED and not is_sure and node.form in COMMANDS.keys() | _NEVER_DENIALS:
        return None
    if node.form in COMMANDS:
        return _offer_command(node, said)
    # Where something else is meant, the rules' own offer of a part of it would be silly.
    without_offer = told.model_copy(update={"options": ()}) if isinstance(told, Clarify) else None
    if node.form in _ORDERS:
        return _offer_standing_order(node, said) or without_offer
    plan = _make_steps(read.plan, said)
    if (
        plan is None
        or check_plan(plan, said.vocabulary, context.runnable, context.blind) is not None
    ):
        return without_offer
    if told.code is Code.NEGATED and not is_sure and not _places_of(plan):
        return None
    lacks_condition = _lacks_condition(plan, told.code)
    if lacks_condition and not is_sure:
        return None
    return _offer_steps(plan, said, at_once=is_sure, lacks_condition=lacks_condition)


def _offer_steps(
    plan: StepPlan, said: _UnreadSentence, *, at_once: bool, lacks_condition: bool
) -> StepPlan | Clarify | None:
    """Return the question about a plan; a mere question to memory itself where it is sure.

    A condition that the plan doesn't wait for is named in it.
    """
    if at_once and all(isinstance(step, Recall) for step in plan.steps):
        return plan
    if _places_of(plan) & _denied_in(said.text, said.vocabulary):
        return None
    label = _tell(plan, said.vocabulary)
    if lacks_condition:
        part = condition_in(normalise(said.text))
        if part is None:
            return None
        label = say("order.unchecked", order=label, part=quote_part(part))
    return _ask_for(said, Option(label=label, text=label.of(said.language)[:2000], plan=plan))


def _offer_command(node: PlanNode, said: _UnreadSentence) -> Clarify | None:
    """Return the question about what the planner itself does; None where it reads it not so.

    A bare command behind a denial ("don't slow down") is none.
    """
    if said.told.code is Code.NEGATED and not any(node.slots):
        return None
    named = " ".join(value[0] for value in node.slots if value)
    names = say_same(named)
    if named in said.vocabulary.by_id:
        names = said.vocabulary.name(named)
    command, label = (
        Bilingual(en=en.format(words=names.en), zh=zh.format(words=names.zh))
        for en, zh in (COMMANDS[node.form], _TOLD[node.form])
    )
    text = command.of(said.language)
    is_read = parse_sentence(text).intent is not None
    return _ask_for(said, Option(label=label, text=text)) if is_read else None


def _offer_standing_order(node: PlanNode, said: _UnreadSentence) -> Clarify | None:
    """Return the question about a standing order whose time the clock reads; None: it doesn't.

    Its steps go with the button: only the time is read again.
    """
    text, vocabulary, context = said.text, said.vocabulary, said.context
    words = tuple(value[0] if value else "" for value in node.slots)
    if any(re.search(rf"{re.escape(each)}[:.]?\d", text, re.IGNORECASE) for each in words if each):
        return None  # of "at 12:10" the reader took "at 12"
    if node.form != "at":
        which, due = (*words, "", "")[:2]
        return offer_kept(node.form, which, due, chinese=said.language is Language.ZH)
    steps = _make_steps(node.blocks[0], said)
    if steps is None or _places_of(steps) & _denied_in(text, vocabulary):
        return None
    if check_plan(steps, vocabulary, context.runnable, context.blind) is not None:
        return None
    try:
        step = OrderAdd(due=words[0], order=_tell(steps, vocabulary).of(said.language))
    except ValidationError:
        return None
    told = write_order(step)
    return offer_order(told, steps) if is_order_sentence(told, step) else None


def _lacks_condition(plan: StepPlan, code: Code) -> bool:
    """Return whether an order hangs on something that its plan doesn't wait for."""
    kinds = {node.step.kind for node in list_nodes(plan.steps)}
    return code is Code.CONDITIONAL and not kinds & HANGING and plan.does is not PlanRole.AFTER


@lru_cache(maxsize=4)
def _denied_in(text: str, vocabulary: Vocabulary) -> frozenset[str]:
    """Return the places that a sentence denies; once for all its readings."""
    return frozenset(denied_places(text, vocabulary))


def _places_of(plan: StepPlan) -> set[str]:
    return {place for node in list_nodes(plan.steps) for place in places_of(node.step)}


def _said_words(node: PlanNode) -> bool:
    """Return whether a node, or one that it holds, names a place, an amount or words."""
    held = (*node.condition, *(each for block in node.blocks for each in block))
    slots = any(text not in TOKEN_NUMBERS for value in node.slots for text in value)
    return slots or any(map(_said_words, held))


def _make_steps(plan: LabelledPlan, said: _UnreadSentence) -> StepPlan | None:
    newest, now = said.context.newest, said.context.now
    if plan[0].form in CHANGES:
        return change_order(plan[0], newest)

    def read_coming(words: str) -> str | None:
        return read_hour(words, now) or read_hour(f"at {words}", now)

    maker = StepMaker(said.vocabulary, said.language, read_coming, read_span)
    made = maker.plan(name_pointed(plan, newest))
    return put_first(made, newest) if made is not None and plan[0].form == "first" else made


def _tell(plan: StepPlan, vocabulary: Vocabulary) -> Bilingual:
    told = sentence(plan.steps, vocabulary, lexicon_of(vocabulary))
    told = say("order.slow", order=told) if plan.pace == "slow" else told
    role = _ROLES.get(plan.does)
    return say(role, order=told) if role else told


def _ask_for(said: _UnreadSentence, button: Option) -> Clarify:
    question = say("grammar.guessed", order=button.label)
    return Clarify(code=said.told.code, question=question, options=(button,))
