"""Lay before a person what the learned reader reads in a sentence that no rule reads.

Laws: what moves is one button below a question, with every step told in words; what a sentence
denies is in no offer; a question to memory drives nothing and needs no yes. What the reader is not
sure of is not offered.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from pydantic import ValidationError

from planner.language.catalogue import say
from planner.language.grammar.compound_forms import read_hour
from planner.language.grammar.lexicon import lexicon_of
from planner.language.grammar.plan_assembly import sentence
from planner.language.motion_guard import denied_places
from planner.language.order_sentence import (
    is_order_sentence,
    offer_kept,
    offer_order,
    write_order,
)
from planner.language.recall import read_span
from planner.language.semantic_parser.changed_order import CHANGES, change_order, name_pointed
from planner.language.semantic_parser.parser import parse
from planner.language.semantic_parser.plan_grammar import ALONE
from planner.language.semantic_parser.plan_steps import StepMaker
from planner.language.sentence import parse as parse_sentence
from planner.plan import (
    CONTROL,
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
    from planner.language.grammar.context import Context
    from planner.language.semantic_parser.plan_grammar import LabelledPlan, PlanNode
    from planner.plan import Bilingual, LastOrder, Vocabulary

SURE = 0.3
"""From here on a plan is offered; a person says no to what was not meant."""
_BEYOND = frozenset({Code.NO_CAPABILITY})
_DOUBTED = frozenset({Code.AMBIGUOUS, Code.OUT_OF_SCOPE})
UNREAD = frozenset({Code.NOT_UNDERSTOOD, Code.CONDITIONAL, Code.NEGATED}) | _BEYOND | _DOUBTED
"""What the rules say of sentences that this may read."""
SURER = 0.6
"""From here on the reader is believed though a rule speaks against it, and what it takes for a
question to memory or for talk is answered without a yes: nothing drives for these."""
COMMANDS: dict[str, tuple[str, str]] = {
    "slower": ("slow down", "慢一点"),
    "faster": ("faster", "快一点"),
    "resume": ("go on", "继续"),
    "pause": ("pause for a moment", "暂停一下"),
    "fact": ("remember that {words}", "记住{words}"),
    "name_here": ("this place is called {words}", "这里叫{words}"),
}
"""What the planner itself does upon a yes, in words that it reads."""
_HANGING = CONTROL | {"wait_for", "wait"}
"""Steps that wait for something, as the words "until" and "when" ask for."""
_ROLES = {PlanRole.AFTER: "order.after", PlanRole.INSTEAD: "order.instead"}
_ORDERS = frozenset({"at"} | {name for name in ALONE if name.startswith("order")})
"""Forms about standing orders."""
_TALK = {"none": "grammar.guessed_talk", "refuse": "grammar.guessed_beyond"}


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
    read = parse(text, vocabulary, least_confidence=SURE)
    if read is None:
        return None
    node, is_sure = read.plan[0], read.confidence >= SURER
    if told.code in _DOUBTED and not is_sure:
        return None
    has_offer = isinstance(told, Clarify) and bool(told.options)
    if node.form in _TALK:
        # What is beyond the robot keeps what the rules say of it, and the part that they offer.
        is_told = told.code in _BEYOND | _DOUBTED or (told.code is Code.NEGATED and not has_offer)
        if not is_sure or is_told:
            return None
        # Nothing is asked, so nothing waits for an answer.
        return Refuse(code=Code.NOT_UNDERSTOOD, reason=say(_TALK[node.form]))
    if told.code in _BEYOND and has_offer and node.form not in CHANGES:  # a part of it is offered
        return None
    if node.form in COMMANDS and is_sure:
        return _offer_command(node, language, told.code)
    # Where something else is meant, the rules' own offer of a part of it would be silly.
    without_offer = told.model_copy(update={"options": ()}) if isinstance(told, Clarify) else None
    if node.form in _ORDERS:
        if told.code is Code.NEGATED and node.form == "at" and not is_sure:
            return without_offer
        offer = _offer_standing_order(node, text, vocabulary, language, context)
        return offer or without_offer
    plan = _make_steps(read.plan, vocabulary, language, context.newest)
    if plan is None or check_plan(plan, vocabulary, context.runnable, context.blind) is not None:
        return without_offer
    if _lacks_condition(plan, told.code) or _is_doubted(plan, told, is_sure=is_sure):
        return None
    return _offer_steps(plan, text, vocabulary, language, at_once=is_sure)


def _offer_steps(
    plan: StepPlan, text: str, vocabulary: Vocabulary, language: Language, *, at_once: bool
) -> StepPlan | Clarify | None:
    """Return the question about a plan; a mere question to memory itself where it is sure."""
    if at_once and all(isinstance(step, Recall) for step in plan.steps):
        return plan
    if _places_of(plan) & denied_places(text, vocabulary):
        return None
    label = _tell(plan, vocabulary)
    return _ask_for(Option(label=label, text=label.of(language)[:2000], plan=plan))


def _offer_command(node: PlanNode, language: Language, code: Code) -> Clarify | None:
    """Return the question about what the planner itself does; None where it reads it not so.

    A bare command behind a denial ("don't slow down") is none.
    """
    if code is Code.NEGATED and not any(node.slots):
        return None
    words = " ".join(value[0] for value in node.slots if value)
    command = COMMANDS[node.form][language is Language.ZH].format(words=words)
    is_read = parse_sentence(command).intent is not None
    return _ask_for(Option(label=say_same(command), text=command)) if is_read else None


def _offer_standing_order(
    node: PlanNode, text: str, vocabulary: Vocabulary, language: Language, context: Context
) -> Clarify | None:
    """Return the question about a standing order whose time the clock reads; None: it doesn't.

    Its steps go with the button: only the time is read again.
    """
    words = tuple(value[0] if value else "" for value in node.slots)
    if any(re.search(rf"{re.escape(each)}[:.]?\d", text, re.IGNORECASE) for each in words if each):
        return None  # of "at 12:10" the reader took "at 12"
    if node.form != "at":
        which, due = (*words, "", "")[:2]
        return offer_kept(node.form, which, due, chinese=language is Language.ZH)
    steps = _make_steps(node.blocks[0], vocabulary, language)
    if steps is None or _places_of(steps) & denied_places(text, vocabulary):
        return None
    if check_plan(steps, vocabulary, context.runnable, context.blind) is not None:
        return None
    try:
        step = OrderAdd(due=words[0], order=_tell(steps, vocabulary).of(language))
    except ValidationError:
        return None
    told = write_order(step)
    return offer_order(told, steps) if is_order_sentence(told, step) else None


def _lacks_condition(plan: StepPlan, code: Code) -> bool:
    """Return whether an order hangs on something that its plan doesn't wait for."""
    kinds = {node.step.kind for node in list_nodes(plan.steps)}
    return code is Code.CONDITIONAL and not kinds & _HANGING and plan.does is not PlanRole.AFTER


def _is_doubted(plan: StepPlan, told: Clarify | Refuse, *, is_sure: bool) -> bool:
    """Return whether rules see a choice, a deed beyond the robot, or one denied with no place."""
    if told.code is Code.AMBIGUOUS:
        return not all(isinstance(step, Recall) for step in plan.steps)
    denied = told.code is Code.NEGATED and not _places_of(plan)
    return not is_sure and (told.code in _BEYOND or denied)


def _places_of(plan: StepPlan) -> set[str]:
    return {place for node in list_nodes(plan.steps) for place in places_of(node.step)}


def _make_steps(
    plan: LabelledPlan, vocabulary: Vocabulary, language: Language, newest: LastOrder | None = None
) -> StepPlan | None:
    if plan[0].form in CHANGES:
        return change_order(plan[0], newest)
    maker = StepMaker(vocabulary, language, read_hour, read_span)
    return maker.plan(name_pointed(plan, newest))


def _tell(plan: StepPlan, vocabulary: Vocabulary) -> Bilingual:
    told = sentence(plan.steps, vocabulary, lexicon_of(vocabulary))
    told = say("order.slow", order=told) if plan.pace == "slow" else told
    role = _ROLES.get(plan.does)
    return say(role, order=told) if role else told


def _ask_for(button: Option) -> Clarify:
    question = say("grammar.guessed", order=button.label)
    return Clarify(code=Code.NOT_UNDERSTOOD, question=question, options=(button,))
