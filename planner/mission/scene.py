"""Gather what a skill is told: its step, the robot, the eyes, what was spent, what a yes sets off.

An ``ask`` is a question upon whose yes something moves where a step that may move the robot comes
after it, before the next ``ask`` or ``decide``: a later question asks anew, and a thought reads the
answer before it plans.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from planner.brain.interface import OFFLINE
from planner.language.catalogue import CATALOGUE, say
from planner.language.object_classes import KINDS
from planner.language.object_names import name_object
from planner.mission.account import BACK, name_place, name_point
from planner.mission.activity import TIMED
from planner.mission.outcomes import accepted_at, moves
from planner.mission.queue import skill_state_now
from planner.mission.state import ORDER_SOURCE, Mission
from planner.mission.transaction import Transaction
from planner.plan import (
    JUDGED,
    Bilingual,
    StepRecord,
    StepRole,
    StepState,
    end_of,
    parent_of,
    parents_of,
    places_of,
    say_same,
)
from planner.plan.plan_walk import catch
from planner.skills import ImageAnswer, Scene, begin_state
from planner.skills.search_bounds import GRANT_M
from wire import Pose2

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planner.site.site_view import SiteView


def scene_of(
    turn: Transaction,
    mission: Mission,
    gazed_s: float | None = None,
    answer: ImageAnswer | None = None,
) -> Scene[Any]:
    """Return the inputs of the current step's skill; ``gazed_s``: a gaze has just ended."""
    activity = turn.book.activity if mission.id == turn.book.running else None
    began_s = activity.since_s if isinstance(activity, TIMED) else None
    since_s = began_s if began_s is not None else turn.now_s
    step, brain = mission.steps[mission.step], mission.brain
    reads = brain is not None and brain.name != OFFLINE  # the offline one has no way
    return Scene(
        step=step,
        facts=turn.book.facts,
        pose=turn.book.pose,
        began=Pose2(*mission.began_at) if mission.began_at is not None else None,
        done=mission.done,
        part=mission.part,
        accepted=accepted_at(mission),
        language=mission.language,
        state=skill_state_now(mission, activity) or begin_state(step.kind),
        eyes=turn.book.eyes,
        sight=turn.book.sight,
        now_s=turn.now_s,
        gazed_s=gazed_s,
        spent_s=mission.step_s + max(0.0, turn.now_s - since_s),
        spent_m=mission.step_m + (activity.metres if activity is not None else 0.0),
        answer=answer,
        unix_s=turn.now_unix_s,
        local_offset_s=turn.book.local_offset_s,
        upon=upon_yes(turn.book.facts, mission),
        thinks=reads and mission.decides < turn.book.rules.decides,
        left_m=GRANT_M - (mission.metres - mission.step_m - mission.granted_at_m),
        afterwards=_ways_after(turn.book.facts, mission),
        offers=_may_offer(turn, mission),
        has_else=_has_else(mission),
    )


MOST_GRANTS = 4
"""Longer searches that one goal may offer, one after the other."""


def _has_else(mission: Mission) -> bool:
    """Tell whether the current step is a condition, with steps for where it does not hold."""
    return any(s.role is StepRole.OTHERWISE for s in _list_branches(mission))


def _list_branches(mission: Mission) -> tuple[StepRecord, ...]:
    """Return the steps of the ``if`` whose condition is the current step."""
    parent, row = parent_of(mission.steps, mission.step), mission.steps
    if parent is None or row[mission.step].role is not StepRole.WHEN:
        return ()
    return row[mission.step + 1 : end_of(row, parent)]


def _may_offer(turn: Transaction, mission: Mission) -> bool:
    """Tell whether a person may be asked for a longer search.

    Not where somebody waits for the robot, where nobody gave the order just now, where the plan
    says what comes next, or in a round of many.
    """
    row, at = mission.steps, mission.step
    alone = not turn.book.queue and not mission.source.startswith(ORDER_SOURCE)
    planned = _has_else(mission) or row[at].role is StepRole.UNTIL
    caught = catch(row, at, 0.0) is not None
    rounds = any(row[parent].kind == "repeat" for parent in parents_of(row, at))
    returns = any(step.kind in BACK for step in row[at + 1 :])
    return alone and mission.grants < MOST_GRANTS and not (planned or caught or rounds or returns)


def _ways_after(facts: SiteView, mission: Mission) -> tuple[tuple[tuple[float, float], ...], ...]:
    """Return where the steps after the current one drive, once for each branch that it chooses."""
    row, at, beside = mission.steps, mission.step, len(_list_branches(mission))
    branches = [
        [s for s in row[at + 1 : at + 1 + beside] if s.role is not other]
        for other in (StepRole.THEN, StepRole.OTHERWISE)
    ]
    after = [s for s in row[at + 1 + beside :] if s.state is StepState.PENDING]
    ends = ([p for s in (*one, *after) for p in _ends(facts, mission, s)] for one in branches)
    return tuple(tuple(points) for points in ends if points)


def _ends(facts: SiteView, mission: Mission, step: StepRecord) -> tuple[tuple[float, float], ...]:
    """Return the points that a step drives to, as far as its record names them [m]."""
    accepted = accepted_at(mission)
    if step.kind == "come_back":
        return () if accepted is None else ((accepted.x_m, accepted.y_m),)
    if step.x_m is not None and step.y_m is not None:
        return ((step.x_m, step.y_m),)
    named = (facts.home,) if step.kind == "return_home" else places_of(step)
    targets = (facts.targets[place] for place in named if place in facts.targets)
    return tuple((t.pose.x_m, t.pose.y_m) for t in targets) if moves(step) else ()


DO_THAT = say("deed.do_that")
_UNTIL = frozenset({"ask", "decide"})


def upon_yes(facts: SiteView, mission: Mission) -> Bilingual | None:
    """Return the robot's next act upon a yes to the question of the current step.

    None where nothing moves before the next question or thought.
    """
    step = mission.current_step
    if step is None or step.kind != "ask" or step.role in JUDGED:
        return None  # upon a no, too, something may come: a condition reads both
    gated: list[StepRecord] = []
    for step in mission.steps[mission.step + 1 :]:
        if step.kind in _UNTIL:
            break
        gated.append(step)
    return first_deed(facts, gated)


def first_deed(facts: SiteView, steps: Iterable[StepRecord]) -> Bilingual | None:
    """Name the first of these steps that may move the robot; None where none moves."""
    step = next(filter(moves, steps), None)
    return None if step is None else name_deed(facts, step)


def whole_deed(facts: SiteView, steps: Iterable[StepRecord]) -> Bilingual:
    """Name what these steps move; "do that" where it is several deeds, or none."""
    deeds = {name_deed(facts, step) for step in steps if moves(step)}
    return deeds.pop() if len(deeds) == 1 else DO_THAT


def name_deed(facts: SiteView, step: StepRecord) -> Bilingual:
    """Name what a step that may move the robot does."""
    place = facts.home if step.kind == "return_home" else step.place
    if step.kind == "go_to_pose":
        return say("deed.drive_to", name=name_point(step))
    if place:
        return say("deed.drive_to", name=name_place(facts, place))
    code = f"deed.{step.kind}"
    return say(code if CATALOGUE.has(code) else "deed.go_on", what=name_sought(step))


def name_sought(step: StepRecord) -> Bilingual:
    """Name a step's object: a kind of thing in both languages, else as it was written."""
    words = step.object or ""
    return name_object(words) if words in KINDS else say_same(words)
