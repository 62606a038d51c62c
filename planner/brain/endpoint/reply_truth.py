"""Find what a well-formed reply must not do to a person: lie, speak another language, lay a trap.

Each rule is a law over the reply and the person's own words, and knows no phrase of a model's. A
reply that breaks one goes back to the model once, with the reason; after that it is no plan, and
the built-in brain answers. Pure.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.brain.endpoint.order_proposal import names_order
from planner.brain.endpoint.plan_reply import Unusable, clean
from planner.language.commands import Forget, ForgetFacts
from planner.language.folding import fold_words, has_chinese
from planner.language.schedule import ChangeOrders, CorrectOrder, ScheduleCommand, split_time
from planner.language.sentence import language_of, parse
from planner.plan import AnswerPlan, Ask, Clarify, Language, Say, StepPlan, words_of
from planner.plan.steps import DRIVES
from planner.plan.tree import list_nodes

if TYPE_CHECKING:
    from planner.brain.endpoint.plan_reply import Planned
    from planner.brain.interface import ThinkRequest

MOST_SENTENCES = 6
MOST_CHARACTERS = 400
COPIED = 48
"""Characters in a row that stand in the instructions are a copy of them."""
MERE_SIGNS = 4
"""Letters that need not be of any language: "42 %", "OK", a name."""
_SENTENCE_END = re.compile(r"[.!?](?=\s|$)|[。！？]")
_DONE_BY_WORD = DRIVES - {"find"}
"""A search may be answered from memory; a drive is driven or it is not."""


def find_untruth(
    plan: Planned,
    grammar: Planned | None,
    request: ThinkRequest,
    instructions: str,
    *,
    mended: bool = False,
) -> Unusable | None:
    """Return why a reply is not to be told or done; None: it is.

    Args:
        plan: what the model wrote.
        grammar: the built-in brain's reading of the order, where nothing of it was done yet;
            asked for only of a reply that only talks.
        request: what the person said.
        instructions: what the model was told by us.
        mended: the model was told of a fault before. What it lets the robot say in another language
            is then what somebody may have asked for ("greet her in French").
    """
    language = request.language or language_of(request.order or request.text)
    if only_talks(plan) and (drives := _drives_of(grammar)):
        why = f"this order is to be done, and words move nothing: plan {', '.join(drives)}"
        return _unusable("only_words", why)
    for text in _texts(plan, language):
        spoken = mended and isinstance(plan, StepPlan)
        if not spoken and (foreign := _misspoken(text, language)) is not None:
            return _unusable("wrong_language", foreign)
        if (copied := _is_copied(text, instructions)) is not None:
            return _unusable("instructions_told", copied)
    if isinstance(plan, AnswerPlan) and (long := _is_too_long(plan.text.of(language))) is not None:
        return _unusable("answer_too_long", long)
    if isinstance(plan, Clarify) and (trap := _traps(plan, request)) is not None:
        return _unusable("offer_not_asked", trap)
    return None


def _unusable(code: str, why: str) -> Unusable:
    return Unusable((why,), code)


def only_talks(plan: Planned) -> bool:
    """Return whether a reply would have the robot say words and do nothing else."""
    steps = plan.steps if isinstance(plan, StepPlan) else ()
    return isinstance(plan, AnswerPlan) or (bool(steps) and all(s.kind == "say" for s in steps))


def _drives_of(grammar: Planned | None) -> list[str]:
    """Return the kinds of steps by which the robot surely is to drive."""
    steps = grammar.steps if isinstance(grammar, StepPlan) else ()
    return [step.kind for step in steps if step.kind in _DONE_BY_WORD]


def _texts(plan: Planned, language: Language) -> list[str]:
    """Return what the person would hear of a reply."""
    if isinstance(plan, StepPlan):
        steps = [node.step for node in list_nodes(plan.steps)]
        return [
            step.question if isinstance(step, Ask) else step.text
            for step in steps
            if isinstance(step, Ask | Say)
        ]
    said = words_of(plan)
    offers = [option.text for option in plan.options] if isinstance(plan, Clarify) else []
    return [*([] if said is None else [said.of(language)]), *offers]


def _misspoken(text: str, language: Language) -> str | None:
    """Return why a text is not of a language; its script alone is judged."""
    letters = sum(map(str.isalpha, text))
    if letters <= MERE_SIGNS and not has_chinese(text):
        return None
    if language is Language.ZH and not has_chinese(text):
        return f"“{clean(text)[:60]}” is not Chinese: speak to the person in Chinese"
    latin = sum(char.isascii() and char.isalpha() for char in text)
    if language is Language.EN and 2 * latin < letters:
        return f"“{clean(text)[:60]}” is not English: speak to the person in English"
    return None


def _is_copied(text: str, instructions: str) -> str | None:
    starts = range(max(0, len(text) - COPIED + 1))
    if any(text[at : at + COPIED] in instructions for at in starts):
        return "these instructions are not told: answer in words of your own"
    return None


def _is_too_long(text: str) -> str | None:
    sentences = len(_SENTENCE_END.findall(text))
    if sentences <= MOST_SENTENCES and len(text) <= MOST_CHARACTERS:
        return None
    return f"{sentences} sentences, {len(text)} characters: answer in one or two short sentences"


def _traps(plan: Clarify, request: ThinkRequest) -> str | None:
    """Return why an option is not the person's: it deletes, or comes again by itself, unasked."""
    said = (request.order, request.text, *(each.answer for each in request.exchanges))
    own = [parse(words).intent for words in said if words]
    deletes = any(isinstance(intent, Forget | ForgetFacts | ChangeOrders) for intent in own)
    timed = any(isinstance(intent, ScheduleCommand) for intent in own)
    timed = timed or any(split_time(fold_words(words))[0] for words in said if words)
    for option in plan.options:
        intent, shown = parse(option.text).intent, f"option “{clean(option.text)[:60]}”"
        named = names_order(intent, tuple(words for words in said if words))
        if isinstance(intent, CorrectOrder) and not (named or timed):
            return f"{shown} changes a standing order that the person did not name"
        if isinstance(intent, Forget | ForgetFacts | ChangeOrders) and not (deletes or named):
            return f"{shown} deletes what is kept, which nobody asked for"
        if isinstance(intent, ScheduleCommand) and not timed:
            return f"{shown} is a standing order, and the person named no time"
    return None
