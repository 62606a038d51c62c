"""Stamps are dated by the relay's clock, and those of another clock are refused."""

from __future__ import annotations

import pytest

from ros2.robot_words import Unreadable
from ros2.ros_clock import RosClock

ROS_S = 1.8e9


def test_a_stamp_is_dated_by_the_least_delayed_state() -> None:
    clock = RosClock()
    for at_s, delay_s in ((1.0, 0.03), (1.1, 0.002), (1.2, 0.05)):
        clock.note(ROS_S + at_s, at_s + delay_s)
    assert clock.date(ROS_S + 1.15, 1.3) == pytest.approx(1.152, abs=1e-6)


def test_nothing_is_dated_later_than_it_came() -> None:
    clock = RosClock()
    clock.note(ROS_S + 1.0, 1.0)
    assert clock.date(ROS_S + 1.02, 1.0) == 1.0


@pytest.mark.parametrize("off_s", [-1.1, 0.1, 3600.0, -ROS_S])
def test_a_stamp_of_another_clock_is_refused(off_s: float) -> None:
    clock = RosClock()
    clock.note(ROS_S + 1.0, 1.0)
    with pytest.raises(Unreadable, match="relay's clock"):
        clock.date(ROS_S + 1.0 + off_s, 1.0)


def test_before_the_relay_spoke_nothing_can_be_dated() -> None:
    clock = RosClock()
    with pytest.raises(Unreadable, match="before the relay"):
        clock.date(ROS_S, 1.0)
    clock.note(ROS_S, 1.0)
    clock.reset()
    with pytest.raises(Unreadable, match="before the relay"):
        clock.date(ROS_S, 1.0)
