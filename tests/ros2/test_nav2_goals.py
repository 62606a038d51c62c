"""Goals of the planner as Nav2 hears them, and what is made of what it answers."""

from __future__ import annotations

import base64
from math import atan2
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2.nav2_goals import (
    AGAIN_S,
    POSE_STAMPED,
    SETTLE_S,
    STATUS_ARRAY,
    Nav2Goals,
    pose_stamped,
    read_goals,
)
from ros2.operations import (
    Advertise,
    AskType,
    Publish,
    Subscribe,
    TopicMessage,
    TopicType,
    UnreadableMessage,
)
from ros2.trouble import Ros2Trouble
from tests.ros2.test_nav2_velocity import TWIST, twist
from wire import Nav2Goal, Nav2State, Pose2
from wire.nav2_dialogue import UNASKED_S
from wire.ros2_config import Nav2Config, Ros2Config

NAV2 = Nav2Config()
GOAL, HERE = Pose2(2.0, 1.0, 0.5), Pose2(0.0, 0.0, 0.0)
BEGUN_S = SETTLE_S + 0.1


def order(leg: int | None = 1, here: Pose2 | None = HERE) -> Nav2Goal:
    wanted = leg is not None
    return Nav2Goal(
        planner_id="p1", seen=1, mission="m1" if wanted else None, leg=leg or 0,
        goal=GOAL if wanted else None, here=here,
    )  # fmt: skip


def joined() -> Nav2Goals:
    made = Nav2Goals(Ros2Config(transport="dds", nav2=NAV2), NAV2, "ros2-1")
    made.open(0.0)
    assert made.due(0.0) == [
        AskType(NAV2.cmd_vel),
        Advertise(NAV2.goal_pose, POSE_STAMPED),
        Subscribe(NAV2.status, STATUS_ARRAY, keeps=True),
    ]
    assert made.hear(TopicType(NAV2.cmd_vel, TWIST, 1), 0.0) == [Subscribe(NAV2.cmd_vel, TWIST)]
    return made


def sent(made: Nav2Goals, now_s: float, leg: int | None = 1) -> list[Pose2]:
    """Return the poses that were published when the planner wants this leg."""
    made.take(order(leg), now_s)
    return [pose_of(one) for one in made.due(now_s) if isinstance(one, Publish)]


def pose_of(request: Publish) -> Pose2:
    assert request.topic == NAV2.goal_pose
    position, turn = (request.message["pose"][name] for name in ("position", "orientation"))
    return Pose2(position["x"], position["y"], round(2.0 * atan2(turn["z"], turn["w"]), 9))


def statuses(*goals: tuple[int, int, int], as_text: bool = False) -> dict[str, Any]:
    """Return an array of goals: number, stamp, status."""

    def uuid(number: int) -> Any:
        raw = bytes([number] * 16)
        return base64.b64encode(raw).decode() if as_text else list(raw)

    return {
        "status_list": [
            {
                "goal_info": {"goal_id": {"uuid": uuid(n)}, "stamp": {"sec": s, "nanosec": 0}},
                "status": status,
            }
            for n, s, status in goals
        ]
    }


def tell(made: Nav2Goals, now_s: float, *goals: tuple[int, int, int], text: bool = False) -> str:
    made.hear(TopicMessage(NAV2.status, statuses(*goals, as_text=text)), now_s)
    return made.state(now_s).phase


def test_a_goal_is_published_once_after_the_graph_has_settled() -> None:
    made = joined()
    assert sent(made, SETTLE_S / 2) == []
    assert sent(made, BEGUN_S) == [GOAL]
    assert sent(made, BEGUN_S + 0.05) == []
    assert made.state(BEGUN_S).phase == "sent"
    assert made.state(BEGUN_S).leg == 1


@pytest.mark.parametrize("text", [False, True], ids=["numbers", "base64"])
def test_the_goal_that_appears_after_it_is_ours_and_its_status_is_told(text: bool) -> None:
    made = joined()
    assert tell(made, 0.5, (9, 1, 4), text=text) == "idle"
    sent(made, BEGUN_S)
    assert tell(made, BEGUN_S + 0.1, (9, 1, 4), text=text) == "sent", "of before"
    assert tell(made, BEGUN_S + 0.2, (9, 1, 4), (5, 2, 2), text=text) == "driving"
    assert tell(made, BEGUN_S + 0.3, (9, 1, 4), (5, 2, 4), text=text) == "succeeded"
    assert tell(made, BEGUN_S + 0.4, (5, 2, 6), text=text) == "succeeded", "it has ended once"


def test_another_clients_goal_is_never_taken_for_ours() -> None:
    made = joined()
    sent(made, BEGUN_S)
    tell(made, BEGUN_S + 0.1, (5, 2, 2))
    assert tell(made, BEGUN_S + 0.2, (5, 2, 6), (6, 3, 2)) == "aborted"
    assert tell(made, BEGUN_S + 0.3, (6, 3, 4)) == "aborted"


def test_of_two_that_appear_at_once_the_younger_is_ours() -> None:
    made = joined()
    sent(made, BEGUN_S)
    assert tell(made, BEGUN_S + 0.1, (7, 8, 2), (5, 3, 6)) == "driving"


def test_what_nav2_does_not_take_up_is_said_again() -> None:
    made = joined()
    sent(made, BEGUN_S)
    assert sent(made, BEGUN_S + AGAIN_S + 0.1) == [GOAL]
    tell(made, BEGUN_S + AGAIN_S + 0.2, (5, 2, 2))
    assert sent(made, BEGUN_S + 3 * AGAIN_S) == []


@pytest.mark.parametrize("silent", [False, True], ids=["told to stand", "planner gone"])
def test_a_goal_that_is_wanted_no_more_is_replaced_by_where_the_robot_stands(silent: bool) -> None:
    made = joined()
    sent(made, BEGUN_S)
    tell(made, BEGUN_S + 0.1, (5, 2, 2))
    now_s = BEGUN_S + 0.2
    if silent:
        now_s += UNASKED_S
        published = [pose_of(one) for one in made.due(now_s) if isinstance(one, Publish)]
    else:
        published = sent(made, now_s, leg=None)
    assert published == [HERE]
    assert made.state(now_s).phase == "cancelled"
    assert sent(made, now_s + 0.1, leg=None) == [], "not ten times"
    assert sent(made, now_s + AGAIN_S + 0.1, leg=None) == [HERE], "Nav2 drives on: once more"
    tell(made, now_s + AGAIN_S + 0.2, (5, 2, 6), (6, 3, 4))
    assert sent(made, now_s + 3 * AGAIN_S, leg=None) == []
    assert made.state(now_s + 3 * AGAIN_S).phase == "idle"


def test_another_leg_is_another_goal_though_it_leads_to_the_same_place() -> None:
    made = joined()
    sent(made, BEGUN_S)
    tell(made, BEGUN_S + 0.1, (5, 2, 6))
    assert sent(made, BEGUN_S + 0.2, leg=2) == [GOAL]
    assert tell(made, BEGUN_S + 0.3, (5, 2, 6)) == "sent", "the aborted one is the former leg's"
    assert tell(made, BEGUN_S + 0.4, (5, 2, 6), (6, 3, 2)) == "driving"


def test_on_a_connection_made_anew_the_goal_is_said_anew() -> None:
    made = joined()
    sent(made, BEGUN_S)
    made.close(Ros2Trouble("ros2_server_gone", "gone"))
    assert made.due(BEGUN_S + 0.1) == []
    assert made.state(BEGUN_S + 0.1).code == "ros2_server_gone"
    made.open(10.0)
    assert Advertise(NAV2.goal_pose, POSE_STAMPED) in made.due(10.0)
    assert sent(made, 10.0 + BEGUN_S) == [GOAL]


def test_twists_are_numbered_and_dated_and_old_ones_are_none() -> None:
    made = joined()
    made.hear(TopicMessage(NAV2.cmd_vel, twist(0.3, -0.2)), 2.0)
    state = made.state(2.1)
    assert (state.twist, state.v_mps, state.w_radps) == (1, 0.3, -0.2)
    assert state.twist_age_s == pytest.approx(0.1)
    assert made.state(2.4).twist == 0
    made.hear(TopicMessage(NAV2.cmd_vel, twist(0.3)), 2.5)
    assert made.state(2.5).twist == 2


@pytest.mark.parametrize(
    ("kind", "publishers", "code"),
    [
        ("", None, "ros2_topic_missing"),
        ("sensor_msgs/msg/LaserScan", 1, "ros2_cmd_vel_type"),
        (TWIST, 2, "ros2_two_robots"),
    ],
)
def test_a_topic_that_is_not_nav2s_velocity_is_told(
    kind: str, publishers: int | None, code: str
) -> None:
    made = Nav2Goals(Ros2Config(transport="dds", nav2=NAV2), NAV2, "ros2-1")
    made.open(0.0)
    assert made.hear(TopicType(NAV2.cmd_vel, kind, publishers), 0.0) == []
    made.hear(TopicMessage(NAV2.cmd_vel, twist()), 0.1)
    assert made.state(0.1).code == code
    assert made.state(0.1).twist == 0


@pytest.mark.parametrize(
    "message",
    [
        {},
        {"status_list": None},
        {"status_list": [None]},
        {"status_list": [{"goal_info": {}, "status": 2}]},
        {"status_list": [{"goal_info": {"goal_id": {"uuid": [999]}, "stamp": None}, "status": 2}]},
        {"status_list": [statuses((5, 2, 2))["status_list"][0] | {"status": None}]},
        {"status_list": [statuses((5, 2, 2))["status_list"][0] | {"status": float("inf")}]},
    ],
)
def test_a_status_with_holes_is_told_and_changes_nothing(message: dict[str, Any]) -> None:
    made = joined()
    sent(made, BEGUN_S)
    made.hear(TopicMessage(NAV2.status, message), BEGUN_S + 0.1)
    assert made.state(BEGUN_S + 0.1).phase == "sent"
    assert made.state(BEGUN_S + 0.1).code == "ros2_unreadable"
    made.hear(UnreadableMessage(NAV2.status, "cut"), BEGUN_S + 0.2)
    assert "cut" in made.state(BEGUN_S + 0.2).detail


ANYTHING = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(
            st.sampled_from(
                ["status_list", "goal_info", "goal_id", "uuid", "stamp", "sec", "nanosec", "status"]
            ),
            inner,
            max_size=4,
        )
    ),
    max_leaves=12,
)


@given(st.dictionaries(st.just("status_list"), ANYTHING))
def test_nothing_that_comes_as_a_status_breaks_the_process(message: dict[str, Any]) -> None:
    made = joined()
    sent(made, BEGUN_S)
    made.hear(TopicMessage(NAV2.status, message), BEGUN_S + 0.1)
    assert isinstance(made.state(BEGUN_S + 0.1), Nav2State)


def test_an_unknown_status_is_no_phase() -> None:
    (goal,) = read_goals(statuses((1, 1, 0)))
    assert goal.phase is None


def test_a_pose_is_written_in_navs_frame() -> None:
    message = pose_stamped("world", Pose2(1.0, -2.0, 3.0))
    assert message["header"]["frame_id"] == "world"
    assert message["pose"]["position"] == {"x": 1.0, "y": -2.0, "z": 0.0}
