"""What each skill that drives, turns, waits or speaks asks for, on the way and again."""

from __future__ import annotations

from dataclasses import replace
from math import degrees, pi, radians
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.perception.snapshot import Sight, Thing
from planner.plan import (
    CONDITIONS,
    CONTROL,
    EVERY_KIND,
    GIVEN,
    NEEDS_CAMERA,
    NEEDS_GROWING_MAP,
    RUNNABLE,
    TOOL_CALLS,
    Code,
    Means,
    StandAt,
    StepState,
    say_same,
)
from planner.site import Site
from planner.site.site_view import facts_of
from planner.skills import (
    SKILLS,
    DriveLeg,
    Eyesight,
    Fail,
    Finish,
    Question,
    Retry,
    SkillAction,
    Skip,
    Speak,
    Stand,
    Think,
    Way,
    act_of,
    begin_state,
    no_room,
)
from planner.skills.measured_motions import PART_RAD
from planner.skills.skill_state import STATES, StandAtState
from tests.conftest import ROOT
from tests.planner.mission.fakes import FACTS
from tests.planner.skills.scenes import said_of, scene
from wire import CameraConfig, Pose2, wrap


def turn(angle_rad: float, **more: object) -> object:
    return act_of(scene("turn", step={"angle_rad": angle_rad}, **more))


@settings(max_examples=50)
@given(st.floats(-4 * pi, 4 * pi), st.floats(-pi, pi), st.floats(-0.05, 0.05))
def test_the_parts_add_up_whatever_each_leaves(angle: float, yaw: float, off: float) -> None:
    began, pose, done, part = Pose2(1.0, 2.0, yaw), Pose2(1.0, 2.0, yaw), 0.0, 0
    while isinstance(act := turn(angle, pose=pose, began=began, done=done, part=part), DriveLeg):
        step = wrap(act.goal.yaw_rad - pose.yaw_rad)
        assert (act.way, act.heading, act.limit_m) == (Way.SPIN, True, 0.5)
        assert abs(step) <= PART_RAD + 0.06, "the bridge never finds the other way shorter"
        done += step + off
        pose, part = Pose2(1.0, 2.0, wrap(act.goal.yaw_rad + off)), part + 1
        assert part <= 10
    assert abs(done - angle) <= 0.1 + 1e-6
    assert isinstance(act, Finish) == (abs(done - angle) <= abs(angle) / 2)


@pytest.mark.parametrize(
    ("asked_deg", "turned_deg", "left_deg"), [(90, 60, 30), (-200, -150, -50), (720, 700, 20)]
)
def test_after_a_pause_only_what_is_left_is_turned(
    asked_deg: float, turned_deg: float, left_deg: float
) -> None:
    here = Pose2(0.0, 0.0, wrap(radians(turned_deg)))
    almost = radians(turned_deg) + 0.05  # odometry and the map differ a little; the map decides
    act = turn(radians(asked_deg), pose=here, done=almost, part=1)
    assert isinstance(act, DriveLeg)
    assert degrees(wrap(act.goal.yaw_rad - here.yaw_rad)) == pytest.approx(left_deg, abs=0.01)


@pytest.mark.parametrize(
    ("asked", "done", "reason"),
    [(pi / 2, pi / 2 - 0.1, None), (pi / 2, 0.9, "odometry_disagrees"), (0.08, 0.0, "too_short")],
)
def test_the_verdict_on_a_turn_is_odometrys(asked: float, done: float, reason: str | None) -> None:
    act = turn(asked, pose=Pose2(0, 0, wrap(asked)), done=done, part=1)
    assert isinstance(act, Finish | Fail)
    assert act.figures == {"turned_rad": round(done, 4), "residual_rad": round(asked - done, 4)}
    assert getattr(act, "reason", None) == reason


def test_a_pose_that_never_settles_ends_and_none_is_waited_for() -> None:
    assert isinstance(turn(1.0, pose=Pose2(0, 0, 0.5), done=0.5, part=3), Fail)
    assert isinstance(turn(1.0, pose=None, began=None), Retry)


def move(distance_m: float, **more: object) -> object:
    return act_of(scene("move", step={"distance_m": distance_m}, **more))


@pytest.mark.parametrize("distance_m", [0.5, -0.3, 10.0])
def test_a_move_aims_along_the_heading_at_which_it_began(distance_m: float) -> None:
    began = Pose2(1.0, 2.0, pi / 2)
    for pose in (began, Pose2(1.05, 2.0 + distance_m / 3, pi / 2 + 0.1)):
        act = move(distance_m, pose=pose, began=began)
        assert isinstance(act, DriveLeg)
        assert (act.way, act.heading) == (Way.STRAIGHT, True)
        goal = (act.goal.x_m, act.goal.y_m, act.goal.yaw_rad)
        assert goal == pytest.approx((1.0, 2.0 + distance_m, pi / 2))
        assert act.limit_m is not None
        assert act.limit_m <= abs(distance_m) + 0.5


@pytest.mark.parametrize(
    ("asked", "done", "reason"),
    [(0.5, 0.45, None), (-0.3, -0.31, None), (2.0, 1.5, "odometry_disagrees"),
     (0.1, 0.0, "too_short"), (-0.5, 0.5, "odometry_disagrees")],
)  # fmt: skip
def test_the_verdict_on_a_move_is_odometrys(asked: float, done: float, reason: str | None) -> None:
    act = move(asked, done=done, part=1)
    assert isinstance(act, Finish | Fail)
    assert act.figures["moved_m"] == done
    assert act.figures["residual_m"] == pytest.approx(abs(asked - done))
    assert getattr(act, "reason", None) == reason


def test_room_is_told_in_metres_and_a_pose_is_waited_for() -> None:
    said = no_room(Pose2(3.0, 0.0, 0.0), Pose2(1.0, 0.0, 0.0), 0.5).said
    assert said is not None
    assert "1.5 m" in said.en
    assert "1.5 米" in said.zh
    assert isinstance(move(1.0, pose=None), Retry)


AT_HOME = facts_of(Site.load(ROOT / "sites" / "home"))
HERE = Pose2(6.0, 4.75, 0.0)
EYES = Eyesight(CameraConfig(), ("chair", "cup"))
CHAIR = Thing("chair_1", "chair", "red", 7.5, 4.75, 0.4, 0.05, 0.9, 0.0, 0.0, 5, "hallway")


def acted(state: StandAtState | None = None, pose: Pose2 | None = HERE, **step: Any) -> Any:
    asked = StandAt.model_validate(step).model_dump(exclude={"kind"})
    more = {"state": state} if state is not None else {}
    sight = Sight(None, (CHAIR,))
    return act_of(
        scene("stand_at", step=asked, facts=AT_HOME, pose=pose, eyes=EYES, sight=sight, **more)
    )


def test_it_drives_to_the_side_facing_it_and_tells_how_far_it_came() -> None:
    leg = acted(place="front_door", side="before", distance_m=1.0)
    assert isinstance(leg, DriveLeg)
    assert (leg.way, leg.heading) == (Way.ROUTE, True)
    assert isinstance(leg.then, StandAtState)
    ended = acted(leg.then, pose=Pose2(10.1, 1.35, -1.57), place="front_door", side="before")
    assert isinstance(ended, Finish)
    assert (ended.code, ended.said and ended.said.en) == (
        Code.ARRIVED,
        "I stand 1.0 m before the front door.",
    )


def test_a_spot_without_a_way_is_followed_by_the_next_and_then_by_a_no() -> None:
    act = acted(place="bed", side="beside")
    tried = []
    while isinstance(act, DriveLeg):
        tried.append((act.goal.x_m, act.goal.y_m))
        assert isinstance(act.otherwise, StandAtState)
        act = acted(act.otherwise, place="bed", side="beside")
    assert len(set(tried)) == len(tried) == 2
    assert isinstance(act, Fail)
    assert (act.code, act.reason) == (Code.NO_ROOM, "no_spot")
    assert (
        said_of(act).en
        == "There is no free floor beside the bed that I can get to, so I stay here."
    )
    assert "床旁边" in said_of(act).zh


@pytest.mark.parametrize(
    ("step", "words"),
    [
        ({"place": "sofa", "side": "behind"}, "no free floor behind the sofa"),
        ({"place": "sofa", "side": "before", "distance_m": 1.0}, "no free floor 1.0 m before"),
        ({"place": "kitchen", "side": "before"}, "a room has no side"),
        ({"place": "attic", "side": "before"}, "attic"),
        ({"object": "cup", "side": "beside"}, "have me find it first"),
        ({"object": "unicorn", "side": "beside"}, "unicorn"),
    ],
)
def test_what_can_not_be_stood_at_says_why(step: dict[str, Any], words: str) -> None:
    act = acted(**step)
    assert isinstance(act, Fail), act
    assert words in said_of(act).en
    assert said_of(act).zh


def test_a_thing_that_was_seen_has_sides_as_seen_from_here() -> None:
    before, behind = (acted(object="red chair", side=side) for side in ("before", "behind"))
    assert before.goal.x_m < CHAIR.x_m < behind.goal.x_m
    facing = acted(object="chair", side="facing", pose=Pose2(6.0, 4.75, 2.0))
    assert isinstance(facing, DriveLeg)
    assert facing.way is Way.SPIN
    assert abs(facing.goal.yaw_rad) < 0.01
    there = acted(object="chair", side="facing")
    assert isinstance(there, Finish), "it faces it already"
    assert said_of(there).en == "I face the red chair, 1.5 m away."


def test_who_does_not_know_where_it_is_waits() -> None:
    assert isinstance(acted(pose=None, place="bed", side="beside"), Retry)


@pytest.mark.parametrize(
    "bad",
    [{"side": "before"}, {"place": "bed", "object": "cup", "side": "before"},
     {"place": "bed", "side": "on"}, {"place": "bed", "side": "before", "distance_m": 99.0},
     {"place": "bed", "side": "before", "distance_m": -1.0},
     {"place": "bed", "side": "before", "distance_m": float("nan")}],
)  # fmt: skip
def test_what_is_no_side_is_no_step(bad: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="validation error"):
        StandAt.model_validate(bad)


HALL, DOCK = FACTS.targets["hall"].pose, FACTS.targets["dock"].pose
BACK = Pose2(1.0, 1.0, 0.5)


def test_what_may_be_planned_has_a_skill_and_what_it_takes_is_known() -> None:
    whole = Means(camera=True, detector=True, growing_map=True)
    assert set(SKILLS) | CONTROL == EVERY_KIND | GIVEN | CONDITIONS | TOOL_CALLS
    assert whole.runnable == EVERY_KIND | GIVEN | TOOL_CALLS
    assert (
        Means().runnable - GIVEN - TOOL_CALLS
        == RUNNABLE
        == EVERY_KIND - NEEDS_CAMERA - NEEDS_GROWING_MAP
    )
    assert Means(growing_map=True).plannable - RUNNABLE == NEEDS_GROWING_MAP == {"explore"}
    blind = Means(camera=True)
    assert blind.runnable - RUNNABLE - TOOL_CALLS == {"go_to_point", "go_to_pose"}
    assert Means(camera=True, model=True).runnable - blind.runnable == {"look"}
    assert blind.plannable == RUNNABLE, "who sees no picture can't point at it"
    assert Means(camera=True, detector=True).lacks("explore") is Code.NOT_MAPPING
    assert [m.lacks("find") for m in (Means(), blind)] == [Code.NO_CAMERA, Code.NO_DETECTOR]


@pytest.mark.parametrize(
    ("kind", "step", "more", "act"),
    [
        ("go_to", {"place": "hall"}, {}, DriveLeg(HALL, heading=False, target="hall")),
        ("go_to", {"place": "dock"}, {}, DriveLeg(DOCK, heading=True, target="dock")),
        ("go_to", {"place": "hall"}, {"part": 1}, Finish()),
        ("return_home", {}, {}, DriveLeg(DOCK, heading=True, target="dock")),
        ("return_home", {}, {"part": 1}, Finish()),
        ("come_back", {}, {"accepted": BACK}, DriveLeg(BACK, heading=True)),
        ("come_back", {}, {"accepted": BACK, "part": 1}, Finish()),
        ("come_back", {}, {"accepted": None}, Fail(Code.NO_ROUTE, "no_route")),
        ("patrol", {"places": ("hall", "dock")}, {}, DriveLeg(HALL, heading=False, target="hall")),
        ("patrol", {"places": ("hall", "dock")}, {"part": 1}, DriveLeg(DOCK, True, target="dock")),
        ("patrol", {"places": ("hall", "dock")}, {"part": 2}, Finish({"visited": 2})),
        ("wait", {"seconds": 3.0}, {}, Stand(3.0)),
        ("say", {"text": "hi"}, {}, Speak("hi")),
        ("say", {"text": "hi", "state": StepState.RUNNING}, {}, Skip("perhaps_said")),
        ("ask", {"text": "who?"}, {}, Question(say_same("who?"))),
        ("ask", {"text": "who?", "answer": "me"}, {}, Finish()),
        ("decide", {"text": "where?"}, {}, Think()),
    ],
)
def test_each_skill_asks_for_one_thing(
    kind: str, step: dict[str, Any], more: dict[str, Any], act: SkillAction
) -> None:
    assert act_of(scene(kind, step=step, **more)) == act


@pytest.mark.parametrize(
    ("kind", "step"),
    [("go_to", {"place": "attic"}), ("patrol", {"places": ("hall", "attic")}), ("return_home", {})],
)
def test_a_place_that_is_gone_is_not_driven_to(kind: str, step: dict[str, Any]) -> None:
    facts = replace(FACTS, home="attic")
    act = act_of(scene(kind, step=step, facts=facts, part=1 if kind == "patrol" else 0))
    assert isinstance(act, Fail)
    assert (act.code, act.reason) == (Code.UNKNOWN_PLACE, "place_gone")
    assert "attic" in said_of(act).en
    assert "hall" in said_of(act).zh


@pytest.mark.parametrize("kind", sorted(NEEDS_CAMERA))
def test_what_needs_a_camera_says_so(kind: str) -> None:
    act = act_of(scene(kind))
    assert isinstance(act, Fail)
    assert act.code is Code.NO_CAMERA


@pytest.mark.parametrize("kind", sorted(STATES))
def test_a_skill_remembers_nothing_that_is_anothers(kind: str) -> None:
    mine = STATES[kind]()
    for foreign in {name for state in STATES.values() for name in state.model_fields}:
        if foreign not in STATES[kind].model_fields:
            with pytest.raises(
                TypeError, match=f"{STATES[kind].__name__} has no {foreign}; it has"
            ):
                mine.but(**{foreign: None})


@pytest.mark.parametrize("kind", sorted(SKILLS))
def test_a_skill_is_asked_with_its_own_state_alone(kind: str) -> None:
    own = begin_state(kind)
    for other in (None, *(state() for state in STATES.values())):
        if type(other) is not type(own):
            with pytest.raises(TypeError, match=f"the step '{kind}' needs the state"):
                act_of(scene(kind, state=other))
