"""A plan is shown before it moves: known ways with their figures, unknown ones as open."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from typing import Any

import pytest

from planner.mission.state import MissionState
from planner.plan import (
    Attempt,
    Bilingual,
    ClockTime,
    Find,
    GoTo,
    If,
    MoveStraight,
    Patrol,
    PlanRecord,
    Refuse,
    Repeat,
    ReturnHome,
    Step,
    StepPlan,
    StepState,
    Turn,
    Wait,
    plan_record,
)
from planner.rehearsal import MOST_LEGS, Rehearsal, RehearsalError, Rehearser
from planner.site import KnownPlaces
from tests.planner.api.fakes import StraightRoutes, two_room
from tests.wire.examples import STATUS
from wire import Pose2, RobotDescription, Status

HERE = Pose2(2.0, 1.0, 0.0)
AT_HERE = STATUS.model_copy(update={"base_in_map": HERE})


def rehearser(status: Status | None = AT_HERE) -> Rehearser:
    site = KnownPlaces(two_room())
    book = MissionState(site.facts, status=status)
    return Rehearser(site, RobotDescription(), StraightRoutes(), lambda: book)


def shown(*steps: Step, **changes: Any) -> Rehearsal:
    plan = plan_record(StepPlan(steps=steps))
    rows = tuple(
        row.model_copy(update=changes) if n == 0 else row for n, row in enumerate(plan.steps)
    )
    return asyncio.run(rehearser().of_plan(plan.model_copy(update={"steps": rows})))


def test_each_step_has_its_way_and_the_next_begins_at_its_end() -> None:
    told = shown(GoTo(place="living_room"), Wait(seconds=5.0), ReturnHome())
    first, waits, home = told.steps
    assert (first.does, first.points[0]) == ("drives", (HERE.x_m, HERE.y_m))
    assert first.name is not None
    assert first.name.en == "living room"
    assert (waits.does, waits.seconds) == ("stands", 5.0)
    assert home.points[0] == first.points[-1]
    assert told.length_m == pytest.approx(first.length_m + home.length_m)
    assert told.seconds == pytest.approx(first.seconds + 5.0 + home.seconds, abs=0.11)
    assert (told.narrowest_m, told.is_whole) == (0.84, True)
    assert told.begins == HERE


def test_a_shut_way_is_told_with_its_code_and_the_rest_is_shown_from_there() -> None:
    told = shown(GoTo(place="kitchen"), GoTo(place="living_room"))
    shut, after = told.steps
    assert (shut.does, shut.code, shut.points) == ("shut", "no_route", ())
    assert shut.message is not None
    assert shut.message.zh
    assert after.points[0] == (HERE.x_m, HERE.y_m)
    assert not told.is_whole


def test_a_place_that_is_gone_is_told() -> None:
    told = shown(GoTo(place="attic"))
    assert (told.steps[0].does, told.steps[0].code) == ("shut", "place_gone")


def test_what_hangs_on_a_picture_is_open() -> None:
    told = shown(Find(object="cup"), ReturnHome())
    assert [step.does for step in told.steps] == ["open", "drives"]
    assert not told.is_whole


def test_turns_and_patrols_are_their_own_skills_legs() -> None:
    told = shown(Turn(angle_rad=7.0), Patrol(places=("living_room", "sofa")))
    spun, patrol = told.steps
    assert spun.does == "drives"
    assert spun.seconds > 7.0, "all the way round, and not the shorter way"
    assert patrol.length_m == 4.0


def test_a_straight_way_that_is_short_is_not_driven() -> None:
    class Short(StraightRoutes):
        async def route(self, request: Any) -> Any:
            return replace(await super().route(request), moved_goal_m=0.4)

    site = KnownPlaces(two_room())
    book = MissionState(site.facts, status=AT_HERE)
    plan = plan_record(StepPlan(steps=(MoveStraight(distance_m=1.0),)))
    short = Rehearser(site, RobotDescription(), Short(), lambda: book)
    told = asyncio.run(short.of_plan(plan))
    assert (told.steps[0].does, told.steps[0].code) == ("shut", "no_room")


def test_a_branch_begins_where_its_condition_stands_and_the_other_is_not_summed_up() -> None:
    told = shown(
        If(
            when=ClockTime(after="22:00"),
            then=(GoTo(place="living_room"),),
            otherwise=(ReturnHome(),),
        )
    )
    condition, then, otherwise = told.steps
    assert condition.does == "open"
    assert (then.branch, then.instead) == (True, False)
    assert (otherwise.branch, otherwise.instead) == (True, True)
    assert then.points[0] == otherwise.points[0]
    assert told.length_m == then.length_m


def test_a_round_is_shown_once_and_what_helps_after_a_failure_beside() -> None:
    told = shown(
        Repeat(steps=(GoTo(place="living_room"),), times=3),
        Attempt(steps=(GoTo(place="sofa"),), on_failure=(ReturnHome(),)),
    )
    assert [step.instead for step in told.steps] == [False, False, True]


def test_of_a_plan_under_way_the_rest_is_shown() -> None:
    told = shown(GoTo(place="living_room"), ReturnHome(), state=StepState.SUCCEEDED)
    assert [step.index for step in told.steps] == [1]


def test_a_plan_that_is_too_long_is_refused() -> None:
    with pytest.raises(RehearsalError) as refused:
        shown(*(Patrol(places=("living_room", "sofa") * 10) for _ in range(MOST_LEGS // 20 + 1)))
    assert refused.value.code == "rehearsal_too_long"


@pytest.mark.parametrize("status", [None, STATUS.model_copy(update={"base_in_map": None})])
def test_without_a_pose_there_is_no_way_to_show(status: Status | None) -> None:
    with pytest.raises(RehearsalError) as refused:
        asyncio.run(rehearser(status).of_text("go home"))
    assert refused.value.code == "rehearsal_without_pose"


@pytest.mark.parametrize(
    "plan",
    [None, PlanRecord(kind="steps"),
     plan_record(Refuse(code="unsafe", reason=Bilingual(en="no", zh="不")))],
)  # fmt: skip
def test_what_is_no_plan_is_told_so(plan: PlanRecord | None) -> None:
    with pytest.raises(RehearsalError) as refused:
        asyncio.run(rehearser().of_plan(plan))
    assert refused.value.code == "rehearsal_no_plan"


@pytest.mark.parametrize("text", ["go to the living room", "去客厅"])
def test_a_sentence_is_read_by_the_rules(text: str) -> None:
    told = asyncio.run(rehearser().of_text(text))
    assert [step.place for step in told.steps] == ["living_room"]
