"""Score what a brain makes of words that lean on the goal before: the missions' own code, no robot.

A sentence is right where it does to the open goal what is expected (in its place, after it, beside
it, nothing), with the plan that is expected, and where a person would not be asked first.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from planner.language.sentence import parse
from planner.mission.effects import AskBrain
from planner.mission.events import Planned, Submitted
from planner.mission.plan_request import thinker
from planner.mission.plan_roles import takes_back
from planner.mission.reception import receive
from planner.mission.reducer import advance
from planner.mission.state import MissionState
from planner.plan import GoalState, Means, PlanRole, StepPlan
from planner.site.site import Site
from planner.site.site_view import facts_of, vocabulary_of
from pons.evals.cases import HELD_OUT, TUNED, Case
from pons.evals.hostile_plans import expected_plan
from pons.evals.matchers import BadMatcher, Expectation, read_expectation
from pons.evals.world import new_goal

if TYPE_CHECKING:
    from planner.brain import Brain
    from planner.mission.effects import Effect

TALKS = Path(__file__).parent / "talks"
KEEPS = "keeps"
ROLES = (*(role.value for role in PlanRole), KEEPS)
_NOW_S = 1000.0


@dataclass(frozen=True, slots=True)
class TalkCase:
    """Hold one sentence in a conversation, and what it is to do."""

    split: str
    group: str
    before: tuple[tuple[str, StepPlan, bool], ...]
    """Orders, their plans, and whether they have ended."""
    text: str
    role: str
    wanted: Expectation | None


@dataclass(frozen=True, slots=True)
class TalkVerdict:
    """Hold what came of one sentence."""

    case: TalkCase
    role: str
    plan: str
    right: bool
    asked: bool


def read_talks(name: str) -> tuple[TalkCase, ...]:
    """Return the cases of a language.

    Raises:
        BadMatcher: a line can't be read.
    """
    lines = (TALKS / f"{name}.tsv").read_text("utf-8").splitlines()
    return tuple(_read(line) for line in lines if line.strip() and not line.startswith("#"))


def _read(line: str) -> TalkCase:
    split, group, before, text, wanted = line.split("\t")
    role, _, plan = wanted.partition(":")
    if role not in ROLES:
        raise BadMatcher(f"{wanted!r}: unknown role {role!r}; known: {', '.join(ROLES)}")
    orders = tuple(_read_order(each) for each in before.split(" & ") if each.strip())
    kept = TUNED if split == "tuned" else HELD_OUT
    expected = read_expectation(plan.strip()) if plan.strip() else None
    return TalkCase(kept, group, orders, text, role, expected)


def _read_order(text: str) -> tuple[str, StepPlan, bool]:
    order, _, plan = text.partition(" => ")
    made = expected_plan(Case(order, "", wanted=read_expectation(plan)))
    if made is None:
        raise BadMatcher(f"{text!r}: an order needs a plan")
    return order.removeprefix("done: "), made, order.startswith("done: ")


async def score_talks(
    cases: tuple[TalkCase, ...], brain: Brain, site: Site
) -> tuple[TalkVerdict, ...]:
    """Return the verdicts in order."""
    return tuple([await score_talk(case, brain, site) for case in cases])


async def score_talk(case: TalkCase, brain: Brain, site: Site) -> TalkVerdict:
    """Return what a sentence comes to behind the orders before it."""
    book = _book_after(case, site)
    given = Submitted(new_goal("talk"), case.text, parse(case.text).language)
    heard = receive(book, parse(case.text), given, _NOW_S)
    _, effects = advance(book, heard.given, _NOW_S)
    think = thinker(brain, vocabulary_of(site), None, Means(camera=True, detector=True))
    planned = await think(_ask(effects)) if _asks(effects) else Planned("said", None)
    role = _role(case, heard.takes_back is not None, heard.given, planned)
    made = planned.plan
    fits = made is not None and case.wanted is not None and case.wanted.fits(made)
    right = role == case.role and (fits or case.wanted is None) and not planned.unasked
    steps = made.steps if isinstance(made, StepPlan) else ()
    told = "; ".join(
        f"{s.kind} {getattr(s, 'object', '') or ''} {getattr(s, 'place', '') or ''}".strip()
        for s in steps
    )
    return TalkVerdict(case, role, told, right, bool(planned.unasked))


def _book_after(case: TalkCase, site: Site) -> MissionState:
    book = MissionState(facts_of(site))
    for number, (order, plan, ended) in enumerate(case.before):
        goal = f"before-{number}"
        book, _ = advance(book, Submitted(goal, order, parse(order).language), _NOW_S)
        book, _ = advance(book, Planned(goal, plan), _NOW_S)
        kept = book.missions[goal].model_copy(
            update={
                "plan": book.missions[goal].plan,
                "state": GoalState.SUCCEEDED if ended else GoalState.RUNNING,
            }
        )
        missions = {**book.missions, goal: kept}
        book = replace(book, missions=missions, running=None if ended else goal, queue=())
    return book


def _asks(effects: tuple[Effect, ...]) -> bool:
    return any(isinstance(each, AskBrain) for each in effects)


def _ask(effects: tuple[Effect, ...]) -> AskBrain:
    return next(each for each in effects if isinstance(each, AskBrain))


def _role(case: TalkCase, ends: bool, given: Submitted, planned: Planned) -> str:
    """Return what a sentence does to the goal that is open, as the missions would do it."""
    plan = planned.plan
    if not isinstance(plan, StepPlan):
        return PlanRole.CANCEL.value if ends else KEEPS
    if plan.does in (PlanRole.CANCEL, PlanRole.ANSWER_TO):
        return plan.does.value
    instead = plan.does is PlanRole.INSTEAD and takes_back(case.text)
    if ends or given.replace or instead:
        return PlanRole.INSTEAD.value
    waits = not all(ended for _, _, ended in case.before)
    after = waits and (given.first or plan.does is PlanRole.AFTER)
    return PlanRole.AFTER.value if after else PlanRole.NEW.value


def show_talks(name: str, verdicts: tuple[TalkVerdict, ...]) -> str:
    """Return the figures, and every sentence that came to something else."""
    lines = []
    for split in (TUNED, HELD_OUT):
        mine = [each for each in verdicts if each.case.split == split]
        lines.append(f"{name} {split}: {sum(v.right for v in mine)} of {len(mine)} right")
    lines += [
        f"  {v.case.text!r} -> {v.role}: {v.plan or 'no plan'}; expected {v.case.role}"
        for v in verdicts
        if not v.right
    ]
    return "\n".join(lines)
