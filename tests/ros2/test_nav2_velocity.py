"""Nav2's twist is said once, fresh, owned and granted, or it is not said."""

from __future__ import annotations

from typing import Any

import pytest

from ros2.nav2_velocity import PAUSE_S, PERIOD_S, Nav2Velocity
from ros2.operations import (
    AskType,
    NoAnswer,
    Subscribe,
    TopicMessage,
    TopicType,
    UnreadableMessage,
)
from ros2.trouble import Ros2Trouble
from ros2.twist_topic import OLD_S
from tests.wire.examples import STATUS
from wire import Grant, Heartbeat, Hello, Mode, Status, Velocity
from wire.ros2_config import Ros2Config
from wire.status import GrantLeft, Owner

TOPIC, ME = "/cmd_vel_nav", "nav2-1"
TWIST, STAMPED = "geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"


def twist(v: float = 0.3, w: float = 0.1, **more: Any) -> dict[str, Any]:
    return {"linear": {"x": v, "y": 0.0, "z": 0.0}, "angular": {"z": w}} | more


def stamped(at_s: float, v: float = 0.3) -> dict[str, Any]:
    whole = int(at_s)
    stamp = {"sec": whole, "nanosec": int((at_s - whole) * 1e9)}
    return {"header": {"stamp": stamp}, "twist": twist(v)}


def link(kind: str = TWIST) -> Nav2Velocity:
    ros2 = Ros2Config.model_validate({"transport": "dds"})
    made = Nav2Velocity(ros2, TOPIC, ME, STATUS.robot_hash)
    made.open(0.0)
    assert made.subscribe(TopicType(TOPIC, kind)) == [Subscribe(TOPIC, kind)]
    return made


def status(mission: str | None = f"{ME}-1", **more: Any) -> Status:
    left = None if mission is None else GrantLeft(mission=mission, metres=9.0, seconds=9.0)
    given: dict[str, Any] = {
        "owner": Owner(planner_id=ME, kind="external"), "grant": left, "held": None,
        "mode": Mode.HOLD, "map_id": STATUS.robot_hash,
    }  # fmt: skip
    return STATUS.model_copy(update=given | more)


def said(made: Nav2Velocity, kind: type[Any], now: Status) -> list[Any]:
    return [message for _, message in made.answer(now) if isinstance(message, kind)]


def test_a_twist_is_said_once_with_the_newest_status_as_what_it_has_seen() -> None:
    made = link()
    made.hear(TopicMessage(TOPIC, twist()), 1.0)
    spoken = made.velocity(status(), 1.01)
    assert isinstance(spoken, Velocity)
    assert (spoken.source_id, spoken.epoch, spoken.seen) == (ME, STATUS.epoch, STATUS.seq)
    assert (spoken.v_mps, spoken.w_radps, spoken.dead_man, spoken.seq) == (0.3, 0.1, True, 1)
    assert made.velocity(status(), 1.2) is None, "an old twist is never repeated"


def test_twists_that_come_faster_than_the_bridge_hears_are_thinned_out_to_the_newest() -> None:
    made = link()
    spoken = []
    for tick in range(100):
        now_s = 1.0 + tick / 100
        made.hear(TopicMessage(TOPIC, twist(v=tick / 1000)), now_s)
        spoken += [one for one in [made.velocity(status(), now_s)] if one is not None]
    assert len(spoken) <= 1 + 1.0 / PERIOD_S
    assert [one.seq for one in spoken] == list(range(1, len(spoken) + 1))


def test_a_standstill_lets_the_dead_man_go_and_what_follows_is_another_mission() -> None:
    made = link()
    made.hear(TopicMessage(TOPIC, twist()), 1.0)
    (first,) = said(made, Grant, status(mission=None))
    made.velocity(status(), 1.01)
    made.hear(TopicMessage(TOPIC, twist(0.0, 0.0)), 1.1)
    spoken = made.velocity(status(), 1.1)
    assert spoken is not None
    assert (spoken.v_mps, spoken.dead_man) == (0.0, False)
    made.hear(TopicMessage(TOPIC, twist()), 1.2)
    assert said(made, Grant, status(mission=first.mission)) == [], "the same goal goes on"
    made.hear(TopicMessage(TOPIC, twist()), 1.3 + PAUSE_S)
    (second,) = said(made, Grant, status(mission=first.mission))
    assert second.mission != first.mission


def test_a_twist_that_waited_or_came_late_by_its_stamp_is_not_said() -> None:
    made = link()
    made.hear(TopicMessage(TOPIC, twist()), 1.0)
    assert made.velocity(status(), 1.01 + OLD_S) is None
    made = link(STAMPED)
    for tick in range(5):
        made.hear(TopicMessage(TOPIC, stamped(5000.0 + tick / 10)), 1.0 + tick / 10)
        assert made.velocity(status(), 1.0 + tick / 10) is not None
    made.hear(TopicMessage(TOPIC, stamped(5000.5)), 1.51 + OLD_S)
    assert made.velocity(status(), 1.51 + OLD_S) is None


@pytest.mark.parametrize(
    "without",
    [{"owner": None}, {"mission": None}, {"owner": Owner(planner_id="other", kind="planner")}],
)
def test_without_ownership_or_grant_nothing_is_said(without: dict[str, Any]) -> None:
    made = link()
    made.hear(TopicMessage(TOPIC, twist()), 1.0)
    assert made.velocity(status(**without), 1.0) is None


def test_it_asks_to_own_a_robot_that_nobody_owns_and_to_be_granted_when_nav2_moves() -> None:
    made = link()
    (hello,) = said(made, Hello, status(owner=None))
    assert (hello.planner_id, hello.kind, hello.seen) == (ME, "external", STATUS.seq)
    assert made.answer(status(owner=Owner(planner_id="other", kind="planner"))) == []
    (beat,) = said(made, Heartbeat, status(mission=None))
    assert (beat.seen, beat.used) == (STATUS.seq, STATUS.seq)
    assert said(made, Grant, status(mission=None)) == [], "Nav2 stands"
    made.hear(TopicMessage(TOPIC, twist()), 1.0)
    assert len(said(made, Grant, status(mission=None))) == 1
    assert said(made, Grant, status(mission=None, mode=Mode.DISARMED)) == []
    held = STATUS.model_validate(STATUS.model_dump()).held
    if held is not None:
        assert said(made, Grant, status(mission=None, held=held)) == []


@pytest.mark.parametrize(
    "wrong",
    [
        twist(v=float("nan")), twist(w=float("inf")), twist(v=99.0), {}, {"linear": None},
        twist() | {"linear": {"x": 0.1, "y": 0.2}}, twist() | {"angular": {"z": None}},
    ],
)  # fmt: skip
def test_what_is_no_twist_of_such_a_base_moves_nothing_and_is_told(wrong: dict[str, Any]) -> None:
    made = link()
    made.hear(TopicMessage(TOPIC, twist()), 1.0)
    made.hear(TopicMessage(TOPIC, wrong), 1.01)
    assert made.velocity(status(), 1.02) is None
    assert made.refusal_count == 1
    trouble = made.trouble(1.02)
    assert trouble is not None
    assert trouble.code == "ros2_unreadable"


@pytest.mark.parametrize(
    ("answer", "code"),
    [
        (TopicType(TOPIC, ""), "ros2_topic_missing"),
        (TopicType(TOPIC, "std_msgs/msg/String"), "ros2_cmd_vel_type"),
        (TopicType(TOPIC, f"{TWIST} and {STAMPED}"), "ros2_cmd_vel_type"),
        (TopicType(TOPIC, TWIST, publishers=2), "ros2_two_robots"),
        (NoAnswer(TOPIC, "no service"), "ros2_no_rosapi"),
    ],
)
def test_a_topic_that_is_none_is_named_and_not_subscribed(
    answer: TopicType | NoAnswer, code: str
) -> None:
    made = Nav2Velocity(Ros2Config.model_validate({"transport": "dds"}), TOPIC, ME, "0" * 16)
    assert made.due(0.0) == [], "not reached"
    made.open(0.0)
    assert made.due(0.0) == [AskType(TOPIC)]
    assert made.due(0.1) == []
    assert made.subscribe(answer) == []
    trouble = made.trouble(0.2)
    assert trouble is not None
    assert trouble.code == code


def test_a_connection_that_went_takes_the_twist_along() -> None:
    made = link()
    made.hear(TopicMessage(TOPIC, twist()), 1.0)
    made.close(Ros2Trouble("ros2_server_gone", "gone"))
    assert made.velocity(status(), 1.0) is None
    assert made.trouble(1.0) is not None
    made.open(2.0)
    made.hear(TopicMessage(TOPIC, twist()), 2.0)
    assert made.velocity(status(), 2.0) is None, "its type is asked anew first"
    made = link()
    made.hear(UnreadableMessage(TOPIC, "cut"), 3.0)
    assert made.refusal_count == 1


def test_a_second_publisher_that_comes_later_is_named_and_not_obeyed() -> None:
    made = link()
    made.hear(TopicMessage(TOPIC, twist()), 1.0)
    assert made.subscribe(TopicType(TOPIC, TWIST, publishers=2)) == []
    assert made.velocity(status(), 1.0) is None
    made.hear(TopicMessage(TOPIC, twist()), 1.1)
    assert made.velocity(status(), 1.1) is None
    assert made.subscribe(TopicType(TOPIC, TWIST, publishers=1)) == [], "it is subscribed already"
    made.hear(TopicMessage(TOPIC, twist()), 1.2)
    assert made.velocity(status(), 1.2) is not None
