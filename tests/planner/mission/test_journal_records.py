"""Goals that former programs wrote down are read into what their skills remember, and go on."""

from __future__ import annotations

import json
from typing import Any, get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from planner.mission.events import Reply, Restarted, Resume
from planner.mission.journal_records import read_mission
from planner.mission.state import Mission
from planner.plan import GoalState, StepState
from planner.skills import SKILLS
from planner.skills.skill_state import (
    STATES,
    ApproachStage,
    AskStage,
    AskState,
    CountState,
    FindState,
    FollowPersonState,
    FollowStage,
    GoToObjectState,
    GoToPointState,
    LookStage,
    LookState,
    PointingStage,
    SkillState,
    SkillStateBase,
)
from tests.planner.mission.former_records import (
    APPROACH,
    ASKED_AGAIN,
    COUNT,
    FIND,
    FOLLOW,
    LOOK,
    LOOK_ANEW,
    POINTED,
    YOUNGER,
)
from tests.planner.mission.lockstep import (
    ANNA,
    CUP,
    FAILED,
    PAUSED,
    SUCCEEDED,
    Seeing,
    standing_still,
)

THING, AT = (5.0, 0.0, 0.8), (4.0, 0.5, 0.4)
HALL_SEEN: dict[str, Any] = {
    "spot": "kitchen/0", "spots": ("here",), "rooms": ("hall",), "here": (0.0, 0.0),
    "order": ("hall", "kitchen"),
}  # fmt: skip
ROWS: list[tuple[str, SkillStateBase]] = [
    (FIND, FindState(**HALL_SEEN, views=(0,), turned=1)),
    (COUNT, CountState(**HALL_SEEN, views=(0, 1, 2, 3, 4))),
    (LOOK, LookState(spot="here", views=(0, 1, 2, 3, 4), turned=5, here=(0.0, 0.0), ahead=0.0,
                     order=("hall", "kitchen"), faced=(0.0, 1.047, 2.094, 3.142, -2.094))),
    (FOLLOW, FollowPersonState(stage=FollowStage.SHUT, at=(3.0, 0.0, 0.9), seen_s=6.9,
                               label="person", shut_at=(0.0, 0.0), shut_ways=3)),
    (APPROACH, GoToObjectState(at=THING, approach=ApproachStage.FACE, label="cup", color="red")),
    (LOOK_ANEW, GoToObjectState(spot="hall/0", spots=("here",), rooms=("kitchen",),
                                here=(4.125, 0.0), order=("kitchen", "hall"), label="cup",
                                color="red", again=1)),
    (POINTED, GoToObjectState(pointing=PointingStage.PROPOSED, pointed=AT)),
    (ASKED_AGAIN, AskState(stage=AskStage.AGAIN, heard="perhaps")),
]  # fmt: skip
NAMES = ["find", "count", "look", "follow", "approach", "look_anew", "pointed", "asked_again"]


def with_notes(row: str, **notes: Any) -> str:
    record = json.loads(row)
    record["notes"] |= notes
    return json.dumps(record)


def restarted(row: str) -> Seeing:
    """Return a planner that begins with this row of a former one, its eyes open."""
    world = Seeing()
    world.bridge.lose_owner()
    world.event(Restarted((read_mission(row),), (), 0.0))
    world.open_eyes()
    world.run(0.2)
    world.act()
    return world


@pytest.mark.parametrize(("row", "state"), ROWS, ids=NAMES)
def test_a_former_row_is_read_into_the_state_of_its_skill(row: str, state: SkillStateBase) -> None:
    former, mission = json.loads(row), read_mission(row)
    assert type(mission) is Mission
    assert mission.skill_state == state
    now = json.loads(mission.model_dump_json())
    del former["notes"], now["skill_state"]
    for name in (
        "recovery",
        "changed",
        "departed_at",
        "interrupted",
        "sure",
        "grants",
        "granted_at_m",
        "by",
        "stopped_by",
        "answers",
        "points",
    ):  # younger than these rows
        del now[name]
    for step in now["plan"]["steps"]:
        for name in YOUNGER:
            del step[name]
    assert now == former, "all else is as it was"
    assert read_mission(mission.model_dump_json()) == mission, "and is read as it is written"


def test_a_former_search_goes_on_where_it_was() -> None:
    world = restarted(FIND)
    assert (world.goal("g1").state, world.goal("g1").reason) == (PAUSED, "planner_restarted")
    assert standing_still(world)
    world.event(Resume("g1"))
    began_s = world.now_s
    while world.goal("g1").steps[0].state is StepState.RUNNING or world.now_s == began_s:
        world.see(0.2)
        assert world.now_s - began_s < 15.0, "five directions were left, and not the hall"
    step = world.goal("g1").steps[0]
    assert step.said is not None
    assert step.said.en == "I saw no red cup. I looked in the hall and kitchen."


def test_a_former_search_finds_what_it_sees() -> None:
    world = restarted(FIND)
    world.event(Resume("g1"))
    world.things = (CUP,)
    world.see_until("g1", SUCCEEDED)


def test_former_goals_take_up_what_they_remember() -> None:
    world = restarted(LOOK)
    world.event(Resume("g1"))
    world.see_until("g1", SUCCEEDED, limit_s=6.0)  # one direction was left
    after = restarted(FOLLOW)
    after.things, after.way = (ANNA,), lambda _: "no_route"
    after.event(Resume("g1"))
    while after.goal("g1").steps[0].state is not StepState.FAILED:
        after.see(0.2)
        assert len(after.routes) <= 3, "three of the ways to them were shut before"


@pytest.mark.parametrize(
    ("row", "reply", "ends"),
    [(POINTED, "yes", SUCCEEDED), (POINTED, "no", FAILED), (ASKED_AGAIN, "yes", SUCCEEDED),
     (ASKED_AGAIN, "hm", GoalState.CANCELLED)],
    ids=["pointed-yes", "pointed-no", "asked-yes", "asked-neither"],
)  # fmt: skip
def test_a_former_question_takes_its_answer(row: str, reply: str, ends: GoalState) -> None:
    world = restarted(row)
    assert world.goal("g1").state is GoalState.NEEDS_CLARIFICATION
    assert standing_still(world)
    world.event(Reply("g1", reply))
    world.see_until("g1", ends)


@pytest.mark.parametrize(
    ("row", "notes", "expected"),
    [
        (FIND, {"aim": "cup_1", "stage": 2}, {"aim": "cup_1", "aim_stage": "facing"}),
        (FIND, {"broke": True, "stage": 77}, {"out_of_metres": True, "aim_stage": "chosen"}),
        (APPROACH, {"at": None, "stage": 2}, {"pointing": "point", "approach": "drive"}),
        (APPROACH, {"at": None, "aim": "a", "stage": 1}, {"aim_stage": "near", "pointing": "look"}),
        (APPROACH, {"stage": 13}, {"approach": "judge", "pointing": "look"}),
        (LOOK, {"stage": 1}, {"stage": LookStage.GAZED}),
        (FOLLOW, {"stage": 1}, {"stage": FollowStage.ROUND}),
        (ASKED_AGAIN, {"stage": 1}, {"stage": AskStage.THOUGHT}),
    ],
)
def test_a_number_is_read_by_what_stood_beside_it(
    row: str, notes: dict[str, Any], expected: dict[str, Any]
) -> None:
    state = read_mission(with_notes(row, **notes)).skill_state
    assert state is not None
    assert {name: getattr(state, name) for name in expected} == expected


def test_a_former_point_is_reached_or_driven_up_to() -> None:
    def read(**notes: Any) -> SkillStateBase | None:
        record = json.loads(with_notes(APPROACH, **{"stage": 0, "at": None, **notes}))
        record["plan"]["steps"][0] |= {"kind": "go_to_point", "x": 5, "y": 5}
        return read_mission(json.dumps(record)).skill_state

    assert isinstance(there := read(stage=1), GoToPointState)
    assert there.reached
    assert isinstance(up := read(stage=12, at=THING), GoToPointState)
    assert (up.reached, up.approach, up.at) == (False, ApproachStage.CHECK, THING)


@pytest.mark.parametrize("kind", sorted(SKILLS.keys() - STATES.keys()))
def test_a_skill_that_remembers_nothing_takes_nothing_over(kind: str) -> None:
    record = json.loads(with_notes(FIND, broke=True))
    record["plan"]["steps"][0]["kind"] = kind
    assert read_mission(json.dumps(record)).skill_state is None


@pytest.mark.parametrize(
    "record",
    [
        "{}",
        with_notes(FIND, foreign=1),
        with_notes(FIND, views="all"),
        with_notes(FIND, seen_s=float("nan")),
        json.dumps({**json.loads(FIND), "skill_state": {"kind": "find"}}),
    ],
    ids=["empty", "unknown", "type", "nan", "both"],
)
def test_what_no_program_of_ours_wrote_is_refused(record: str) -> None:
    with pytest.raises(ValidationError):
        read_mission(record)


def test_a_goal_remembers_nothing_of_another_skill() -> None:
    row = json.loads(read_mission(FIND).model_dump_json())
    for kind in STATES.keys() - {"find"}:
        with pytest.raises(ValidationError, match="'find'"):
            read_mission(json.dumps({**row, "skill_state": {"kind": kind}}))
    with pytest.raises(ValidationError):
        read_mission(json.dumps({**row, "skill_state": {"kind": "find", "faced": [0.0]}}))


kinds, stages = st.sampled_from(sorted(SKILLS)), st.integers(-2, 20)
points = st.none() | st.tuples(*[st.floats(-50.0, 50.0)] * 3)
notes = st.fixed_dictionaries(
    {"stage": stages, "at": points, "pointed": points, "stand": st.integers(0, 9)},
    optional={"aim": st.just("cup_1"), "broke": st.booleans(), "heard": st.just("hm"),
              "here": st.just([0.0, 1.0]), "faced": st.just([0.1])},
)  # fmt: skip


@given(kinds, notes)
def test_any_former_row_is_read_into_its_own_skills_state(kind: str, kept: dict[str, Any]) -> None:
    record = json.loads(with_notes(FIND, **kept))
    record["plan"]["steps"][0]["kind"] = kind
    mission = read_mission(json.dumps(record))
    wanted = STATES.get(kind)
    assert mission.skill_state is None if wanted is None else type(mission.skill_state) is wanted
    assert read_mission(mission.model_dump_json()) == mission


def test_each_kind_stands_in_the_table_of_states() -> None:
    [union, _] = get_args(SkillState)
    made = {state.model_fields["kind"].default: state for state in get_args(union)}
    assert made == dict(STATES)
    assert STATES.keys() <= SKILLS.keys()
