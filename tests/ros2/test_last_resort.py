"""Zeros go straight to cmd_vel while the relay is silent, and nothing else ever does."""

from __future__ import annotations

import pytest

from ros2.graph import TWIST, TWIST_STAMPED
from ros2.last_resort import EVERY_S, LastResort
from tests.ros2.frames import as_operations

STILL = {"x": 0.0, "y": 0.0, "z": 0.0}


def sent(resort: LastResort, now_s: float, *, silent: bool, kind: str = TWIST) -> list[str]:
    frames = as_operations(resort.due(kind, now_s, silent=silent))
    assert {frame["topic"] for frame in frames} <= {"/cmd_vel"}
    return [frame["op"] for frame in frames]


def test_it_begins_with_the_silence_and_ends_with_it() -> None:
    resort = LastResort("/cmd_vel")
    assert sent(resort, 1.0, silent=False) == []
    assert sent(resort, 2.0, silent=True) == ["advertise", "publish"]
    assert sent(resort, 2.0 + EVERY_S / 2, silent=True) == []
    assert sent(resort, 2.01 + EVERY_S, silent=True) == ["publish"]
    assert sent(resort, 3.0, silent=False) == ["unadvertise"]
    assert sent(resort, 3.1, silent=False) == []


def test_without_a_type_nobody_can_be_told_and_a_new_connection_is_told_anew() -> None:
    resort = LastResort("/cmd_vel")
    assert sent(resort, 1.0, silent=True, kind="") == []
    assert sent(resort, 1.0, silent=True) == ["advertise", "publish"]
    resort.begin()
    assert sent(resort, 1.01, silent=True) == ["advertise", "publish"]


@pytest.mark.parametrize("kind", [TWIST, "geometry_msgs/TwistStamped", TWIST_STAMPED])
def test_all_that_goes_this_way_is_zero(kind: str) -> None:
    said = as_operations(LastResort("/cmd_vel").due(kind, 1.0, silent=True))[1]["msg"]
    assert said.get("twist", said) == {"linear": STILL, "angular": STILL}
    assert ("header" in said) == (kind != TWIST)
    assert "stamp" not in said.get("header", {})
