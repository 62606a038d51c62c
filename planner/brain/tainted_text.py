"""Think again about a goal with words from pictures and tools: they may be told, never obeyed.

Law: what was read in a picture, or came from a tool, may change what is said, never what is done.
What is done comes from a thought that was not shown those words; a second thought, which is, may
only put other words into an answer or a ``say``, and is dropped where it differs in anything else.
So a sign can add no step, move none and take none away, however the model that reads it or the one
that plans obeys it. A tool's arguments are deeds: nothing that was read goes to another server.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from planner.brain.errors import BadPlan, BrainDown
from planner.language.catalogue import say
from planner.plan import AnswerPlan, StepPlan, list_nodes

if TYPE_CHECKING:
    from planner.brain.interface import Brain, Observation, ThinkRequest, ThinkResult
    from planner.brain.streamed_draft import Hear
    from planner.plan import Plan

_SAID = say("observation.said_something")
"""Words that were said after a picture was read may repeat it, so they are withheld as well."""


def is_tainted(request: ThinkRequest) -> bool:
    """Tell whether this goal has words in its course that may have stood in a picture."""
    return any(seen.read is not None for seen in request.observed)


def withheld(request: ThinkRequest) -> ThinkRequest:
    """Return the request without any words that may have stood in a picture."""
    kept: list[Observation] = []
    after = False
    for seen in request.observed:
        after = after or seen.read is not None
        words = {"read": None, "detail": _SAID} if after and seen.step == "say" else {"read": None}
        kept.append(seen.model_copy(update=words))
    return request.model_copy(update={"observed": tuple(kept)})


def deeds(plan: Plan) -> dict[str, Any]:
    """Return all of a plan but the words that an answer or a ``say`` gives to people.

    A question stays: it is looked at with, decided by, or answered by a person who is then obeyed.
    """
    if isinstance(plan, AnswerPlan):
        return {"kind": plan.kind}
    if not isinstance(plan, StepPlan):
        return plan.model_dump()
    steps = [_without_words(step.model_dump()) for step in plan.steps]
    return {"kind": plan.kind, "does": plan.does, "pace": plan.pace, "steps": steps}


def _without_words(value: Any) -> Any:
    """Return a step without the words that it says, and so with the steps that it holds."""
    if isinstance(value, dict):
        if value.get("kind") == "say":
            return {"kind": "say"}
        return {name: _without_words(part) for name, part in value.items()}
    if isinstance(value, list | tuple):
        return [_without_words(part) for part in value]
    return value


def speaks(plan: Plan) -> bool:
    """Return whether a plan has words that a model's reading might fill."""
    if isinstance(plan, StepPlan):
        return any(node.step.kind == "say" for node in list_nodes(plan.steps))
    return isinstance(plan, AnswerPlan)


async def think_warily(
    brain: Brain, request: ThinkRequest, hear: Hear | None = None
) -> ThinkResult:
    """Return a brain's thought; nothing that is done in it follows from words in a picture.

    Raises:
        BadPlan, BrainDown: as the brain does, before it was shown any such words.
    """
    if not is_tainted(request):
        return await brain.think(request, hear)
    acts = await brain.think(withheld(request))
    if not speaks(acts.plan):
        return acts

    def does_the_same(plan: Plan) -> bool:
        return deeds(plan) == deeds(acts.plan)

    try:
        says = await brain.think(request.model_copy(update={"accepts": does_the_same}))
    except (BrainDown, BadPlan):
        return acts
    cost = {
        name: getattr(acts, name) + getattr(says, name)
        for name in ("calls", "tokens", "prompt_tokens", "reply_tokens")
    }
    better = says if does_the_same(says.plan) else acts
    return better.model_copy(update=cost)
