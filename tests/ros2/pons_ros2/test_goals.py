"""Goals of the planner as Nav2 hears them, and what is made of what it answers."""

from __future__ import annotations

import json
import math
from types import SimpleNamespace as Made
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2.pons_ros2.pons_ros2.goals import (
    AGAIN_S,
    OLD_S,
    SETTLE_S,
    UNASKED_S,
    Nav2Dialogue,
    Pose,
    read_order,
    read_plan,
)
from ros2.pons_ros2.pons_ros2.readings import UnusableMessage
from tests.wire.examples import EXAMPLES
from wire import Nav2Goal, Nav2State, PlanView, Pose2, decode, encode, keys
from wire.nav2_dialogue import UNASKED_S as WIRE_UNASKED_S

GOAL, HERE = Pose2(2.0, 1.0, 0.5), Pose2(0.0, 0.0, 0.0)
AT_GOAL, AT_HERE = (2.0, 1.0, 0.5), (0.0, 0.0, 0.0)
BEGUN_S = SETTLE_S + 0.1


def order(leg: int | None = 1, here: Pose2 | None = HERE) -> str:
    wanted = leg is not None
    return encode(
        Nav2Goal(
            planner_id="p1", seen=1, mission="m1" if wanted else None, leg=leg or 0,
            goal=GOAL if wanted else None, here=here,
        )
    ).decode()  # fmt: skip


def begun() -> Nav2Dialogue:
    made = Nav2Dialogue(0.0)
    made.trouble = None
    return made


def sent(made: Nav2Dialogue, now_s: float, leg: int | None = 1) -> Pose | None:
    """Return the pose that is published when the planner wants this leg."""
    made.take(read_order(order(leg)), now_s)
    return made.due(now_s)


def state(made: Nav2Dialogue, now_s: float) -> Nav2State:
    """Return what the planner is told, as the wire carries it."""
    said = decode(keys.NAV2_STATE, json.dumps(made.state("relay-1", now_s)).encode())
    assert isinstance(said, Nav2State)
    return said


def tell(made: Nav2Dialogue, now_s: float, *goals: tuple[int, int, int]) -> str:
    """Say an array of goals (number, stamp, status); return the phase that comes of it."""
    made.hear_status(
        Made(
            status_list=[
                Made(
                    goal_info=Made(goal_id=Made(uuid=[n] * 16), stamp=Made(sec=s, nanosec=0)),
                    status=status,
                )
                for n, s, status in goals
            ]
        ),
        now_s,
    )
    return state(made, now_s).phase


def twist(v: float = 0.3, w: float = 0.0, sideways: float = 0.0) -> Any:
    return Made(linear=Made(x=v, y=sideways), angular=Made(z=w))


def test_a_goal_is_published_once_after_the_graph_has_settled() -> None:
    made = begun()
    assert sent(made, SETTLE_S / 2) is None
    assert sent(made, BEGUN_S) == AT_GOAL
    assert sent(made, BEGUN_S + 0.05) is None
    said = state(made, BEGUN_S)
    assert (said.phase, said.mission, said.leg) == ("sent", "m1", 1)


def test_the_goal_that_appears_after_it_is_ours_and_its_status_is_told() -> None:
    made = begun()
    assert tell(made, 0.5, (9, 1, 4)) == "idle"
    sent(made, BEGUN_S)
    assert tell(made, BEGUN_S + 0.1, (9, 1, 4)) == "sent", "of before"
    assert tell(made, BEGUN_S + 0.2, (9, 1, 4), (5, 2, 2)) == "driving"
    assert tell(made, BEGUN_S + 0.3, (9, 1, 4), (5, 2, 4)) == "succeeded"
    assert tell(made, BEGUN_S + 0.4, (5, 2, 6)) == "succeeded", "it has ended once"


def test_another_clients_goal_is_never_taken_for_ours() -> None:
    made = begun()
    sent(made, BEGUN_S)
    tell(made, BEGUN_S + 0.1, (5, 2, 2))
    assert tell(made, BEGUN_S + 0.2, (5, 2, 6), (6, 3, 2)) == "aborted"
    assert tell(made, BEGUN_S + 0.3, (6, 3, 4)) == "aborted"


def test_of_two_that_appear_at_once_the_younger_is_ours_and_an_unknown_status_is_no_phase() -> None:
    made = begun()
    sent(made, BEGUN_S)
    assert tell(made, BEGUN_S + 0.1, (7, 8, 0), (5, 3, 6)) == "sent"
    assert tell(made, BEGUN_S + 0.2, (7, 8, 2), (5, 3, 6)) == "driving"


def test_what_nav2_does_not_take_up_is_said_again() -> None:
    made = begun()
    sent(made, BEGUN_S)
    assert sent(made, BEGUN_S + AGAIN_S + 0.1) == AT_GOAL
    tell(made, BEGUN_S + AGAIN_S + 0.2, (5, 2, 2))
    assert sent(made, BEGUN_S + 3 * AGAIN_S) is None


@pytest.mark.parametrize("silent", [False, True], ids=["told to stand", "planner gone"])
def test_a_goal_that_is_wanted_no_more_is_replaced_by_where_the_robot_stands(
    *, silent: bool
) -> None:
    made = begun()
    sent(made, BEGUN_S)
    tell(made, BEGUN_S + 0.1, (5, 2, 2))
    now_s = BEGUN_S + 0.2 + (UNASKED_S if silent else 0.0)
    assert (made.due(now_s) if silent else sent(made, now_s, leg=None)) == AT_HERE
    assert state(made, now_s).phase == "cancelled"
    assert sent(made, now_s + 0.1, leg=None) is None, "not ten times"
    assert sent(made, now_s + AGAIN_S + 0.1, leg=None) == AT_HERE, "Nav2 drives on: once more"
    tell(made, now_s + AGAIN_S + 0.2, (5, 2, 6), (6, 3, 4))
    assert sent(made, now_s + 3 * AGAIN_S, leg=None) is None
    assert state(made, now_s + 3 * AGAIN_S).phase == "idle"


def test_another_leg_is_another_goal_though_it_leads_to_the_same_place() -> None:
    made = begun()
    sent(made, BEGUN_S)
    tell(made, BEGUN_S + 0.1, (5, 2, 6))
    assert sent(made, BEGUN_S + 0.2, leg=2) == AT_GOAL
    assert tell(made, BEGUN_S + 0.3, (5, 2, 6)) == "sent", "the aborted one is the former leg's"
    assert tell(made, BEGUN_S + 0.4, (5, 2, 6), (6, 3, 2)) == "driving"


def test_twists_are_numbered_and_dated_and_old_ones_are_none() -> None:
    made = begun()
    made.hear_twist(twist(0.3, -0.2), 0.0, 2.0)
    said = state(made, 2.1)
    assert (said.twist, said.v_mps, said.w_radps) == (1, 0.3, -0.2)
    assert said.twist_age_s == pytest.approx(0.1)
    assert state(made, 2.4).twist == 0
    made.hear_twist(twist(0.3), OLD_S + 0.01, 2.5)
    assert state(made, 2.5).twist == 0, "old by its own stamp"
    made.hear_twist(twist(0.3), 0.0, 2.5)
    assert state(made, 2.5).twist == 2


@pytest.mark.parametrize(
    "wrong", [twist(math.nan), twist(9.0), twist(0.1, 99.0), twist(0.1, sideways=0.2)]
)
def test_a_twist_that_is_none_is_told_and_ends_the_one_before(wrong: Any) -> None:
    made = begun()
    made.hear_twist(twist(), 0.0, 2.0)
    made.hear_twist(wrong, 0.0, 2.05)
    said = state(made, 2.06)
    assert (said.twist, said.v_mps, said.code) == (0, 0.0, "ros2_unreadable")


def test_a_topic_that_is_not_nav2s_velocity_is_told_and_gives_no_twist() -> None:
    made = begun()
    made.trouble = "ros2_two_robots", "2 publish on /cmd_vel_nav"
    made.hear_twist(twist(), 0.0, 2.0)
    said = state(made, 2.0)
    assert (said.twist, said.code) == (0, "ros2_two_robots")


@given(st.text(max_size=30) | st.dictionaries(st.text(max_size=8), st.integers()).map(str))
def test_what_is_no_order_is_refused(text: str) -> None:
    with pytest.raises(UnusableMessage):
        read_order(text)


def test_both_ends_wait_equally_long_for_a_planner() -> None:
    assert UNASKED_S == WIRE_UNASKED_S


def test_what_the_planner_shows_is_read() -> None:
    read = read_plan(encode(EXAMPLES[PlanView]).decode())
    assert (read.mode, read.held) == ("active", "")
    assert (read.path, read.places) == (((0.0, 1.0), (2.0, 1.0)), (("kitchen", 2.0, 1.0),))


@pytest.mark.parametrize(
    "change",
    [{"path": [[0.0]]}, {"path": [[0.0, math.nan]]}, {"path": None}, {"places": [{"name": "x"}]},
     {"places": [{"name": "x", "x_m": math.inf, "y_m": 0.0}]}],
)  # fmt: skip
def test_what_is_no_plan_is_refused(change: dict[str, Any]) -> None:
    raw = json.loads(encode(EXAMPLES[PlanView]).decode())
    with pytest.raises(UnusableMessage):
        read_plan(json.dumps(raw | change))
    with pytest.raises(UnusableMessage):
        read_plan("[" * 99_999)
