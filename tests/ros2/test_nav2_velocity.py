"""Nav2's twist is said once, fresh, owned and granted, or it is not said."""

from __future__ import annotations

from typing import Any

import pytest

from ros2.nav2_velocity import OLD_S, PAUSE_S, PERIOD_S, SILENT_S, Nav2Velocity
from tests.known import known
from tests.ros2.words import nav2_state
from tests.wire.examples import STATUS
from wire import Grant, Heartbeat, Hello, Mode, Status, Velocity
from wire.status import GrantLeft, Owner

ME = "nav2-1"


def moving(at_s: float = 1.0, v_mps: float = 0.3, w_radps: float = 0.1) -> Nav2Velocity:
    """Return one that heard Nav2's first twist."""
    made = Nav2Velocity(ME, STATUS.robot_hash)
    made.hear(nav2_state(1, v_mps, w_radps), at_s)
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
    made = moving()
    spoken = made.velocity(status(), 1.01)
    assert isinstance(spoken, Velocity)
    assert (spoken.source_id, spoken.epoch, spoken.seen) == (ME, STATUS.epoch, STATUS.seq)
    assert (spoken.v_mps, spoken.w_radps, spoken.dead_man, spoken.seq) == (0.3, 0.1, True, 1)
    made.hear(nav2_state(1, 0.3, 0.1, twist_age_s=0.1), 1.1)
    assert made.velocity(status(), 1.2) is None, "an old twist is never repeated"


def test_twists_that_come_faster_than_the_bridge_hears_are_thinned_out_to_the_newest() -> None:
    made = Nav2Velocity(ME, STATUS.robot_hash)
    spoken = []
    for tick in range(1, 101):
        now_s = 1.0 + tick / 100
        made.hear(nav2_state(tick, tick / 1000), now_s)
        spoken += [one for one in [made.velocity(status(), now_s)] if one is not None]
    assert len(spoken) <= 1 + 1.0 / PERIOD_S
    assert [one.seq for one in spoken] == list(range(1, len(spoken) + 1))


def test_a_standstill_lets_the_dead_man_go_and_what_follows_is_another_mission() -> None:
    made = moving()
    (first,) = said(made, Grant, status(mission=None))
    made.velocity(status(), 1.01)
    made.hear(nav2_state(2, 0.0), 1.1)
    spoken = known(made.velocity(status(), 1.1))
    assert (spoken.v_mps, spoken.dead_man) == (0.0, False)
    made.hear(nav2_state(3, 0.3), 1.2)
    assert said(made, Grant, status(mission=first.mission)) == [], "the same goal goes on"
    made.hear(nav2_state(4, 0.3), 1.3 + PAUSE_S)
    (second,) = said(made, Grant, status(mission=first.mission))
    assert second.mission != first.mission


def test_a_twist_that_waited_here_or_on_the_robot_is_not_said() -> None:
    assert moving().velocity(status(), 1.01 + OLD_S) is None
    made = Nav2Velocity(ME, STATUS.robot_hash)
    made.hear(nav2_state(1, 0.3, twist_age_s=OLD_S), 1.0)
    assert made.velocity(status(), 1.01) is None


def test_a_node_that_began_again_is_heard_though_it_counts_from_one() -> None:
    made = moving()
    assert made.velocity(status(), 1.0) is not None
    made.hear(nav2_state(1, 0.3, boot_id="relay-2"), 1.1)
    assert made.velocity(status(), 1.1) is not None


@pytest.mark.parametrize(
    "without",
    [{"owner": None}, {"mission": None}, {"owner": Owner(planner_id="other", kind="planner")}],
)
def test_without_ownership_or_grant_nothing_is_said(without: dict[str, Any]) -> None:
    assert moving().velocity(status(**without), 1.0) is None


def test_it_asks_to_own_a_robot_that_nobody_owns_and_to_be_granted_when_nav2_moves() -> None:
    made = Nav2Velocity(ME, STATUS.robot_hash)
    (hello,) = said(made, Hello, status(owner=None))
    assert (hello.planner_id, hello.kind, hello.seen) == (ME, "external", STATUS.seq)
    assert made.answer(status(owner=Owner(planner_id="other", kind="planner"))) == []
    (beat,) = said(made, Heartbeat, status(mission=None))
    assert (beat.seen, beat.used) == (STATUS.seq, STATUS.seq)
    made.hear(nav2_state(0, 0.0), 0.9)
    assert said(made, Grant, status(mission=None)) == [], "Nav2 said no twist"
    made.hear(nav2_state(1, 0.3), 1.0)
    assert len(said(made, Grant, status(mission=None))) == 1
    assert said(made, Grant, status(mission=None, mode=Mode.DISARMED)) == []


def test_what_keeps_nav2_away_is_told_and_so_is_a_process_that_is_silent() -> None:
    made = Nav2Velocity(ME, STATUS.robot_hash)
    assert "nav2_not_heard" in (made.trouble(1.0) or "")
    made.hear(nav2_state(0, 0.0, code="ros2_topic_missing", detail="no /cmd_vel_nav"), 1.0)
    assert made.trouble(1.0) == "ros2_topic_missing: no /cmd_vel_nav"
    made.hear(nav2_state(1, 0.3), 1.1)
    assert made.trouble(1.2) is None
    assert "nav2_not_heard" in (made.trouble(1.11 + SILENT_S) or "")
