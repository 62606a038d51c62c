"""Hold which horizon is followed, what it leaves of the one before, and when a leg is done."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.authority import leg_tracking
from bridge.core.authority.leg_tracking import has_arrived, hear_waypoints, residual
from bridge.core.motion.wheel_command import take_horizon
from bridge.core.state_motion import NEW, FollowState
from bridge.core.tick_context import TickContext
from tests.bridge.core.fake_planner import MAP_ID
from tests.bridge.core.reached import at, reached
from tests.bridge.core.table import table
from tests.bridge.core.windows import dropped
from wire import Owner, Pose2, Waypoint, Waypoints

FOLLOWED = FollowState(0.4, turning=True, settled=True, tries=2)


def driving() -> TickContext:
    """Return a tick of a robot on its way, at (1, 0) of its map."""
    tick = at()
    tick.robot_in_map = Pose2(1.0, 0.0, 0.0)
    tick.s.motion.follow = FOLLOWED
    tick.s.bad_bucket = 3.0
    return tick


def horizon(tick: TickContext, *xs: float, **more: object) -> Waypoints:
    seq = (tick.s.ownership.waypoints_seq or 0) + 1
    points = tuple(Waypoint(x_m=x, y_m=0.0, speed_mps=0.3) for x in xs)
    made = {
        "planner_id": "p1", "epoch": tick.epoch, "seq": seq, "seen": tick.s.voice.status_seq,
        "mission": "m1", "leg": 1, "map_id": MAP_ID, "ttl_s": 0.5, "points": points,
        "final": False,
    }  # fmt: skip
    return Waypoints.model_validate(made | more)


@table(
    ("more", "code", "score", "refusal"),
    [
        ({"planner_id": "p2"}, "not_owner", 3.0, None),
        ({"mission": "m2"}, "no_grant", 3.0, None),
        ({"seq": 1}, "seq_backwards", 4.0, None),
        ({"leg": 0}, "old_leg", 3.0, None),
        ({"map_id": "b" * 16}, "wrong_map", 4.0, "wrong_map"),
        ({"points": (Waypoint(x_m=3.0, y_m=0.0, speed_mps=0.3),)}, "first_point_far", 4.0,
         "first_point_far"),
    ],
)  # fmt: skip
def test_what_is_not_followed_leaves_what_is(
    more: dict[str, object], code: str, score: float, refusal: str | None
) -> None:
    tick = driving()
    before = tick.s.leg
    hear_waypoints(tick, horizon(tick, 1.1, 1.2, **more))
    assert tick.reasons == [code]
    assert tick.s.bad_bucket == score
    assert tick.s.leg == replace(before, refusal=refusal)
    assert tick.s.motion.follow == FOLLOWED


def test_the_same_number_again_and_another_brain_are_not_followed() -> None:
    tick = driving()
    hear_waypoints(tick, horizon(tick, 1.1, 1.2, seq=tick.s.ownership.waypoints_seq))
    assert (tick.reasons, tick.s.bad_bucket) == (["repeated"], 3.0)
    tick = driving()
    owner = Owner(planner_id="p1", kind="external")
    tick.s.ownership = replace(tick.s.ownership, owner=owner)
    hear_waypoints(tick, horizon(tick, 1.1, 1.2))
    assert tick.reasons == ["no_grant"]


def test_every_fault_is_told_but_scored_once() -> None:
    tick = driving()
    hear_waypoints(tick, horizon(tick, 3.0, 3.9))
    assert tick.reasons == ["first_point_far", "bad_spacing"]
    assert tick.s.bad_bucket == 4.0
    assert tick.s.leg.refusal == "first_point_far"
    tick = driving()
    tick.robot_in_map = None
    hear_waypoints(tick, horizon(tick, 1.1, 1.2))
    assert (tick.reasons, tick.s.bad_bucket, tick.s.leg.refusal) == (["no_pose"], 3.0, "no_pose")
    tick = driving()
    tick.robot_in_map = None
    hear_waypoints(tick, horizon(tick))
    assert tick.reasons == [], "no points need no pose"


@table(
    ("had_horizon", "had_goal", "final", "follow"),
    [
        (True, None, False, FollowState(turning=True)),
        (True, 1.2, False, FollowState(0.0, turning=True, settled=True, tries=2)),
        (True, 1.2, True, FollowState(0.0, turning=True, settled=True, tries=2)),
        (True, 9.0, True, FollowState(turning=True)),
        (True, 9.0, False, FollowState(0.0, turning=True, settled=True, tries=2)),
        (False, 1.2, True, NEW),
    ],
)
def test_a_horizon_of_the_same_leg_goes_on_where_the_last_one_was(
    had_horizon: bool, had_goal: float | None, final: bool, follow: FollowState
) -> None:
    tick = driving()
    goal = None if had_goal is None else Waypoint(x_m=had_goal, y_m=0.0, speed_mps=0.3)
    kept = tick.s.leg.horizon if had_horizon else None
    tick.s.leg = replace(tick.s.leg, goal=goal, horizon=kept, refusal="wrong_map")
    new = horizon(tick, 1.1, 1.15, 1.2, final=final)
    before = tick.s.leg
    hear_waypoints(tick, new)
    take_horizon(tick, before)
    leg = tick.s.leg
    assert tick.s.motion.follow == follow
    assert (leg.horizon, leg.refusal, leg.sent_s) == (new, None, tick.s.voice.ring[-1])
    assert leg.goal == (new.points[-1] if final else goal)
    assert leg.path is not None
    assert leg.path.length_m == pytest.approx(0.1)
    assert tick.s.bad_bucket == 2.0
    assert tick.s.ownership.waypoints_seq == new.seq


def test_a_new_leg_begins_with_nothing_of_the_old() -> None:
    tick = driving()
    tick.s.leg = replace(tick.s.leg, reached=True, goal=Waypoint(x_m=9.0, y_m=0.0, speed_mps=0.3))
    before = tick.s.leg
    hear_waypoints(tick, horizon(tick, 1.1, 1.2, leg=2))
    take_horizon(tick, before)
    leg = tick.s.leg
    assert (leg.leg, leg.mission, leg.reached, leg.goal) == (2, "m1", False, None)
    assert tick.s.motion.follow == NEW
    hear_waypoints(tick, horizon(tick, 3.0, 3.1, leg=3))
    take_horizon(tick, leg)
    assert tick.s.motion.follow == NEW, "nothing was taken"
    leg = tick.s.leg
    assert (leg.leg, leg.refusal, leg.horizon, leg.path) == (3, "first_point_far", None, None)


@table(
    ("points", "final", "at_end", "stands", "arrived", "reached_leg"),
    [
        (True, True, True, True, True, True),
        (True, True, True, False, False, False),
        (True, True, False, True, False, False),
        (True, False, True, True, False, False),
        (False, False, False, True, True, False),
        (False, True, True, False, False, False),
    ],
)
def test_a_leg_is_done_where_it_ends_and_stands(
    points: bool, final: bool, at_end: bool, stands: bool, arrived: bool, reached_leg: bool
) -> None:
    tick = driving()
    tick.s.drive.still_since_s = tick.now_s if stands else None
    new = horizon(tick, *((1.1, 1.2) if points else ()), final=final)
    tick.s.leg = replace(tick.s.leg, horizon=new)
    assert has_arrived(tick, at_end=at_end) is arrived
    assert tick.s.leg.reached is reached_leg
    assert tick.events == [("reached", "m1 leg 1")] * reached_leg
    tick.s.leg = replace(tick.s.leg, horizon=None)
    assert not has_arrived(tick, at_end=True)


def test_what_is_left_is_told_where_it_is_known() -> None:
    tick = driving()
    goal = Waypoint(x_m=4.0, y_m=4.0, speed_mps=0.3, heading_rad=0.5)
    tick.s.leg = replace(tick.s.leg, goal=goal)
    assert residual(tick) == pytest.approx((5.0, 0.5))
    tick.robot_in_map = None
    assert residual(tick) == (0.0, 0.0)
    tick = driving()
    tick.s.leg = replace(tick.s.leg, goal=None)
    assert residual(tick) == (0.0, 0.0)


@table("against", ["", "none", "empty", "reached", "mission", "old"])
def test_a_horizon_calls_only_where_it_asks_for_motion(against: str) -> None:
    tick = driving()
    new = horizon(tick, *(() if against == "empty" else (1.1, 1.2)))
    tick.s.leg = replace(
        tick.s.leg,
        horizon=None if against == "none" else new,
        reached=against == "reached",
        sent_s=9.5 - 1e-6 * (against == "old"),
    )
    if against == "mission":
        tick.s.grants = replace(tick.s.grants, mission="m2")
    assert tick.s.leg.has_usable_horizon(tick.s.grants.mission, 10.0) is (against == "")


@table(("sent_s", "lateness"), [(0.0, "before_jump"), (0.1, None)])
def test_a_message_of_the_very_moment_of_a_jump_is_of_before(
    sent_s: float, lateness: str | None
) -> None:
    tick = at()
    tick.now_s = 0.5
    tick.s.pose = replace(tick.s.pose, jumped_s=0.0)
    horizon = tick.s.leg.horizon
    assert horizon is not None
    assert horizon.ttl_s == 0.5
    assert leg_tracking._lateness(tick, horizon, sent_s) == lateness
    tick.s.pose = replace(tick.s.pose, jumped_s=None)
    assert leg_tracking._lateness(tick, horizon, 0.0) is None
    assert leg_tracking._lateness(tick, horizon, -1e-9) == "too_old"


def test_a_horizon_of_before_a_jump_is_named() -> None:
    world = reached("active")
    world.state.pose = replace(world.state.pose, jumped_s=world.now_s)
    world.brain.next_horizon_s = 0.0
    assert dropped(world, "before_jump")
    assert world.state.leg.refusal == "before_jump"
