"""Lay before a person what the learned reader reads in a sentence that no rule reads.

Laws: what moves is one button below a question, with every step told in words; what a sentence
denies is in no offer; a question to memory drives nothing and needs no yes. What the reader is not
sure of is not offered.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.catalogue import say
from planner.language.grammar.en.compound import ENGLISH_COMPOUND
from planner.language.grammar.lexicon import lexicon_of
from planner.language.grammar.plan_assembly import sentence
from planner.language.grammar.zh.compound import CHINESE_COMPOUND
from planner.language.motion_guard import denied_places
from planner.language.semantic_parser.parser import parse
from planner.language.semantic_parser.plan_grammar import STEPS
from planner.language.semantic_parser.plan_steps import StepMaker
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

if TYPE_CHECKING:
    from planner.language.grammar.context import Context
    from planner.language.semantic_parser.plan_grammar import LabelledPlan
    from planner.plan import Bilingual, Vocabulary

SURE = 0.3
"""From here on a plan is offered; a person says no to what was not meant."""
UNREAD = frozenset({Code.NOT_UNDERSTOOD, Code.CONDITIONAL, Code.NEGATED})
"""What the rules say of sentences that this may read."""
SURE_OF_RECALL = 0.6
"""From here on a question to memory is answered: it drives nothing, and needs no yes."""
SURE_OF_TALK = 0.6
"""From here on a sentence is taken for talk, or for what the robot can't do: nothing moves."""
COMMANDS: dict[str, tuple[str, str]] = {
    "slower": ("slow down", "慢一点"),
    "faster": ("faster", "快一点"),
    "resume": ("go on", "继续"),
    "fact": ("remember that {words}", "记住{words}"),
}
"""What the planner itself does upon a yes, in words that it reads."""
_TALK = {"none": "grammar.guessed_talk", "refuse": "grammar.guessed_beyond"}


def offer_plan(
    told: Plan, text: str, vocabulary: Vocabulary, language: Language, context: Context
) -> StepPlan | Clarify | None:
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
    form, offers = read.plan[0].form, isinstance(told, Clarify) and told.options
    if told.code is Code.NEGATED and form not in STEPS:
        return None
    if form in _TALK:
        sure = read.confidence >= SURE_OF_TALK and isinstance(told, Clarify) and not offers
        return Clarify(code=Code.NOT_UNDERSTOOD, question=say(_TALK[form])) if sure else None
    if form in COMMANDS:
        words = "".join(value[0] for value in read.plan[0].slots if value)
        command = COMMANDS[form][language is Language.ZH].format(words=words)
        return _ask_for(Option(label=say_same(command), text=command))
    plan = _make_steps(read.plan, vocabulary, language)
    if plan is None or check_plan(plan, vocabulary, context.runnable, context.blind) is not None:
        # Something else is meant: the rules' own offer of a part of it would be silly.
        return told.model_copy(update={"options": ()}) if isinstance(told, Clarify) else None
    if all(isinstance(step, Recall) for step in plan.steps):
        surely = told.code is Code.NOT_UNDERSTOOD and read.confidence >= SURE_OF_RECALL
        return plan if surely else None
    if _is_held_back(plan, text, vocabulary, told.code):
        return None
    label = _tell(plan, vocabulary)
    return _ask_for(Option(label=label, text=label.of(language)[:2000], plan=plan))


def _is_held_back(plan: StepPlan, text: str, vocabulary: Vocabulary, code: Code) -> bool:
    """Return whether a sentence denies what a plan does, or sets a condition that it lacks."""
    nodes = list_nodes(plan.steps)
    places = {place for node in nodes for place in places_of(node.step)}
    denied = denied_places(text, vocabulary)
    if code is Code.NEGATED:  # of a place, or of the very deed where none is named
        return bool(denied) or not places
    hangs = any(node.step.kind in CONTROL for node in nodes)
    return (code is Code.CONDITIONAL and not hangs) or bool(places & denied)


def _make_steps(plan: LabelledPlan, vocabulary: Vocabulary, language: Language) -> StepPlan | None:
    forms = CHINESE_COMPOUND if language is Language.ZH else ENGLISH_COMPOUND
    return StepMaker(vocabulary, language, forms.time).plan(plan)


def _tell(plan: StepPlan, vocabulary: Vocabulary) -> Bilingual:
    told = sentence(plan.steps, vocabulary, lexicon_of(vocabulary))
    told = say("order.slow", order=told) if plan.pace == "slow" else told
    return say("order.after", order=told) if plan.does is PlanRole.AFTER else told


def _ask_for(button: Option) -> Clarify:
    question = say("grammar.guessed", order=button.label)
    return Clarify(code=Code.NOT_UNDERSTOOD, question=question, options=(button,))
