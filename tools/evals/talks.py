"""Hold the suites of conversations: single sentences that lean on what was before, whole scripts.

A sentence of ``talks/*.tsv`` is right where it does to the goals before it what is expected (in
their place, after them, beside them, nothing), with the plan that is expected, and unasked.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, Any, TypeVar

from pons.evals.matchers import BadMatcher, read_expectation
from tools.evals.conversation import Conversation, converse, show_conversations
from tools.evals.lines import LineVerdict
from tools.evals.robot import conversation_robot
from tools.evals.scripted_model import ScriptedModel
from tools.evals.scripts import PLANS, Reaction, ScriptSet, ScriptTurn, read_scripts

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence
    from pathlib import Path

    from planner.brain import Brain, ThinkRequest, ThinkResult
    from planner.brain.streamed_draft import Hear
    from planner.plan import BrainTag
    from tools.evals.lines import SuiteLine
    from tools.evals.scripts import Script

T = TypeVar("T")
PERSON_GOAL = 0.95
_DOES = {
    "new": frozenset({Reaction.NEW}),
    "after": frozenset({Reaction.AFTER}),
    "instead": frozenset({Reaction.INSTEAD}),
    "cancel": frozenset({Reaction.CANCEL}),
    "keeps": frozenset({Reaction.NO, Reaction.ASKS, Reaction.ANSWER}),
}


def _read_order(text: str) -> ScriptTurn:
    order, _, plan = text.partition(" => ")
    says = (order.removeprefix("done: "),)
    stays = not order.startswith("done: ")
    return ScriptTurn(says, frozenset({Reaction.NEW}), read_expectation(plan), stays=stays)


async def hear_talk(line: SuiteLine, brain: Brain, site: Path) -> LineVerdict:
    """Return what a sentence comes to behind the orders before it.

    Raises:
        BadMatcher: its expectation can't be read.
    """
    before, text, expected = line.columns
    role, _, plan = expected.partition(":")
    if role not in _DOES:
        raise BadMatcher(f"{expected!r}: unknown role {role!r}; known: {', '.join(_DOES)}")
    wanted = read_expectation(plan.strip()) if plan.strip() else None
    model = ScriptedModel(whims=False)
    with conversation_robot(model, site) as robot:
        for turn in (_read_order(each) for each in before.split(" & ") if each.strip()):
            model.expect(turn)
            taken = await robot.hear(turn.says[0])
            if taken.reaction is Reaction.CONFIRMS:  # one of two places: the guard asks first
                taken = await robot.confirm(taken.goal, yes=True)
            robot.settle(taken.goal, stays=turn.stays)
        robot.think_with(brain)
        heard = await robot.hear(text)
    fits = heard.plan is not None and wanted is not None and wanted.fits(heard.plan)
    right = heard.reaction in _DOES[role] and (fits or heard.reaction not in PLANS)
    steps = heard.plan.steps if heard.plan is not None else ()
    told = f"{heard.reaction}: {'; '.join(step.kind for step in steps)}"
    return LineVerdict(line, text, told, right)


@dataclass(frozen=True, slots=True)
class _BrainOutside:
    """Be a brain that needs sockets, which the lockstep's event loop has none of."""

    brain: Brain
    loop: asyncio.AbstractEventLoop

    @property
    def tag(self) -> BrainTag:
        return self.brain.tag

    async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
        del hear
        thinking = self.brain.think(request)
        return asyncio.run_coroutine_threadsafe(thinking, self.loop).result()


async def hold_beside(
    hold: Callable[[Brain], Coroutine[Any, Any, T]], brain: Brain, *, outside: bool
) -> T:
    """Hold talks in a thread of their own where a model's sockets need this event loop."""
    if not outside:
        return await hold(brain)
    model = _BrainOutside(brain, asyncio.get_running_loop())
    return await asyncio.to_thread(lambda: asyncio.run(hold(model)))


async def score_person(brain: Brain, said: argparse.Namespace) -> bool:
    """Hold conversations with a brain and, where no model is named, with a scripted one too."""
    brains = (lambda: brain,) if said.model is not None else (lambda: brain, ScriptedModel)
    return await _score(brains, (ScriptSet.OWN, ScriptSet.THIRD, ScriptSet.FOURTH), said)


async def score_trial(brain: Brain, said: argparse.Namespace) -> bool:
    """Hold the trial, which is for models: what it asks is beyond a grammar."""
    scripted = (lambda: ScriptedModel(whims=False), ScriptedModel)[: 1 if said.drive else 2]
    brains = (lambda: brain,) if said.model is not None else scripted
    return await _score(brains, (ScriptSet.TRIAL,), said)


async def _score(
    brains: Sequence[Callable[[], Brain]], sets: tuple[ScriptSet, ...], said: argparse.Namespace
) -> bool:
    right = count = wrong = 0
    for name, script_set, make in product(("en", "zh"), sets, brains):
        brain = make()
        held = tuple(
            [await hold(one, brain, said.site, driven=said.drive)
             for one in read_scripts(name, script_set)]
        )  # fmt: skip
        hostile = brain.hostile if isinstance(brain, ScriptedModel) else 0
        print(show_conversations(f"{script_set}{name}", brain.tag.name, held, hostile))
        right, count = right + sum(h.right for h in held), count + len(held)
        wrong += sum(h.moves_wrongly for h in held)
    return right >= PERSON_GOAL * count and not wrong


async def hold(script: Script, brain: Brain, site: Path, *, driven: bool = False) -> Conversation:
    """Return how a conversation went with a robot that nobody has talked to yet."""
    with conversation_robot(brain, site, driven=driven) as robot:
        return await converse(script, brain, robot)
