"""Judge a plan: its length, its places, the kinds of its steps, and the things that it names.

The one judge of plans, asked three times with what is known there. A model's answer is judged for
its repair (``planner.brain.endpoint.reply_validation``) and any brain's once more
(``planner.mission.plan_request``), both without a detector's classes. The missions, which trust no
brain, judge it before any of it is carried out (``planner.mission.plan_check``), with those
classes. Every reason is collected, so that a model can be asked to write the plan better. A camera
that fails later is no fault of a plan: it ends its own step (``planner.skills.act_of``).

A plan that holds plans is judged whole, every branch of it, with bounds that hold over all rounds.

Which steps may be planned follows from what a robot has: eyes or none, and somebody who knows what
they see (:class:`Means`).
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator
from math import prod

from planner.plan.base import Bilingual, Frozen
from planner.plan.goal import StepRecord, places_of, plan_record
from planner.plan.outcome import Code
from planner.plan.responses import (
    MAX_STEPS,
    STEPLESS,
    AnswerPlan,
    Clarify,
    Plan,
    Refuse,
    StepPlan,
)
from planner.plan.steps import (
    CONTROL,
    GIVEN,
    NEEDS_CAMERA,
    NEEDS_GROWING_MAP,
    RUNNABLE,
    TOOL_CALLS,
    Step,
)
from planner.plan.tree import parent_of, parents_of

NEEDS_DETECTOR = frozenset({"find", "count", "follow", "go_to_object"})
POINTS = frozenset({"go_to_point"})
"""Runnable with any camera, but of use only to who sees the picture that it points at."""


class Means(Frozen):
    """Hold the robot's parts beyond wheels and a voice."""

    camera: bool = False
    detector: bool = False  # recognises what the camera shows
    model: bool = False  # a vision model may be asked about a picture
    growing_map: bool = False  # a map is being made by driving

    @property
    def runnable(self) -> frozenset[str]:
        """Return the kinds of steps that this robot can do."""
        grows = NEEDS_GROWING_MAP if self.growing_map else frozenset()
        drives = RUNNABLE | GIVEN | TOOL_CALLS | grows
        if not self.camera:
            return drives
        look = {"look"} if self.detector or self.model else set()
        return drives | POINTS | look | (NEEDS_DETECTOR if self.detector else frozenset())

    @property
    def plannable(self) -> frozenset[str]:
        """Return the kinds that a brain may plan with: it points at nothing, picture or map.

        Skills and tools are offered where there are any (``Vocabulary.calls``).
        """
        return self.runnable - POINTS - GIVEN - TOOL_CALLS

    @property
    def blind(self) -> Code:
        """Return the message on a step that needs eyes and can't be done."""
        return Code.NO_DETECTOR if self.camera else Code.NO_CAMERA

    def lacks(self, kind: str) -> Code | None:
        """Return the part missing for a kind of step, or None where nothing is."""
        if kind in self.runnable or kind == "clock":
            return None
        return _lack(kind, self.blind)


BARE = Means()
"""A robot that only drives and talks."""


class Reason(Frozen):
    """Name one fault of a plan; `repairable` where the model could write it better."""

    code: Code
    step: int | None  # index into the plan's steps; None where the plan as a whole is meant
    what: str
    repairable: bool
    said: Bilingual | None = None  # in words for a person, where the code alone does not say it


class PlanRejection(Frozen):
    """Refuse a plan, with every reason found; ``planner.language.plan_rejections`` tells it."""

    reasons: tuple[Reason, ...]

    @property
    def first(self) -> Reason:
        """Return the reason that a person must hear first: one that no repair can mend."""
        return next((reason for reason in self.reasons if not reason.repairable), self.reasons[0])

    @property
    def repairable(self) -> bool:
        """Tell whether handing the reasons back to the model could help."""
        return all(reason.repairable for reason in self.reasons)


def check_plan(
    plan: Plan | tuple[StepRecord, ...],
    places: Container[str],
    runnable: frozenset[str] = RUNNABLE,
    blind: Code = Code.NO_CAMERA,
    unknown_object: Callable[[StepRecord], Bilingual | None] | None = None,
) -> PlanRejection | None:
    """Return every reason against carrying out a plan, or None where there is none.

    Args:
        plan: as a brain wrote it, or its steps as the missions keep them. What has no steps passes:
            an answer, a question, a refusal.
        places: the ids that exist.
        runnable: the kinds of steps that this robot can do now.
        blind: the code of a step that needs eyes and can't be run.
        unknown_object: says why nothing here can recognise what a step names, in words for a
            person; None where nobody can tell, as on the brain's side.

    Bounds of numbers hold from birth (the models refuse them), so they are not looked at again.
    """
    if isinstance(plan, AnswerPlan | Clarify | Refuse):
        return None
    if isinstance(plan, StepPlan) and plan.does in STEPLESS:
        return _refuse_steps(plan)
    steps = plan_record(plan).steps if isinstance(plan, StepPlan) else plan
    reasons = (*_faults(steps, places, runnable, blind), *_unknown(steps, unknown_object))
    return PlanRejection(reasons=reasons) if reasons else None


def _refuse_steps(plan: StepPlan) -> PlanRejection | None:
    """Refuse a plan that ends a goal or answers a question and would move the robot besides."""
    if not plan.steps:
        return None
    what = f"{len(plan.steps)} steps; {plan.does.value} takes none"
    return PlanRejection(
        reasons=(Reason(code=Code.BAD_PLAN, step=None, what=what, repairable=True),)
    )


def _faults(
    steps: tuple[StepRecord, ...],
    places: Container[str],
    runnable: frozenset[str],
    blind: Code,
) -> Iterator[Reason]:
    count = sum(step.kind not in CONTROL for step in steps)
    if not 1 <= count <= MAX_STEPS:
        what = f"{count} steps; expected 1 to {MAX_STEPS}"
        yield Reason(code=Code.BAD_PLAN, step=None, what=what, repairable=True)
    for what in _beyond_bounds(steps):
        yield Reason(code=Code.BAD_PLAN, step=None, what=what, repairable=True)
    for index, step in enumerate(steps):
        for place in places_of(step):
            if place not in places:
                yield Reason(code=Code.UNKNOWN_PLACE, step=index, what=place, repairable=True)
        if step.kind in ("wait_for", "stand_at") and step.object and "find" not in runnable:
            yield Reason(code=blind, step=index, what=step.kind, repairable=False)
        if step.kind not in runnable and step.kind != "clock":
            yield Reason(code=lacking(step, blind), step=index, what=step.kind, repairable=False)


MAX_DEPTH = 3
"""Steps in steps: deeper than that nobody can say aloud what will be done."""
MAX_UNROLLED = 200
"""Steps of all rounds, both branches counted, each place of a patrol as one."""
MAX_STANDING_S = 2 * 3600.0
"""What waits add up to over all rounds."""


def _beyond_bounds(steps: tuple[StepRecord, ...]) -> Iterator[str]:
    """Say which bound over the whole tree is not kept, with what came and what is expected."""
    deepest = max((step.depth for step in steps), default=0)
    if not deepest <= MAX_DEPTH:
        yield f"steps stand {deepest} deep in others; at most {MAX_DEPTH}"
        return
    if not len(steps) <= 2 * MAX_STEPS:
        yield f"{len(steps)} steps with those that hold steps; at most {2 * MAX_STEPS}"
        return
    rounds = [_rounds(steps, index) for index in range(len(steps))]
    unrolled = sum(n * max(1, len(s.places)) for n, s in zip(rounds, steps, strict=True))
    if not unrolled <= MAX_UNROLLED:
        yield f"{unrolled} steps over all rounds; at most {MAX_UNROLLED}"
    waits = ((n, s.seconds) for n, s in zip(rounds, steps, strict=True) if s.kind in STANDS)
    standing_s = sum(n * (seconds or 0.0) for n, seconds in waits)
    if not standing_s <= MAX_STANDING_S:
        yield f"waits of {standing_s:.0f} s over all rounds; at most {MAX_STANDING_S:.0f}"
    open_ = {i for i, step in enumerate(steps) if step.kind in CONTROL}
    for index, step in enumerate(steps):
        held = [i for i in parents_of(steps, index) if steps[i].kind == "repeat"]
        if step.kind == "decide" and held:  # its new steps would take the loop's place unseen
            yield "decide inside repeat; put it behind, or use if"
        parent = parent_of(steps, index)
        if step.depth and parent not in open_:
            yield f"a step stands in {steps[parent].kind if parent is not None else 'nothing'}"


STANDS = frozenset({"wait", "wait_for"})


def _rounds(steps: tuple[StepRecord, ...], index: int) -> int:
    """Return how often a step may be done: the rounds of all repeats about it."""
    return prod(steps[i].times or 1 for i in parents_of(steps, index) if steps[i].kind == "repeat")


def _unknown(
    steps: tuple[StepRecord, ...],
    unknown_object: Callable[[StepRecord], Bilingual | None] | None,
) -> Iterator[Reason]:
    if unknown_object is None:
        return
    for index, step in enumerate(steps):
        said, what = unknown_object(step), step.object or step.text or ""
        if said is not None:
            code = Code.OBJECT_UNKNOWN
            yield Reason(code=code, step=index, what=what, repairable=True, said=said)


def lacking(step: Step | StepRecord, blind: Code = Code.NO_CAMERA) -> Code:
    """Name the robot's lack for a step that it can't run; ``blind``: its eyes' lack."""
    return _lack(step.kind, blind)


def _lack(kind: str, blind: Code) -> Code:
    if kind in NEEDS_GROWING_MAP:
        return Code.NOT_MAPPING
    if kind in GIVEN:
        return Code.POINT_NOT_GIVEN
    return blind if kind in NEEDS_CAMERA else Code.NO_CAPABILITY
