"""Take the corners of single functions that no run through a world reaches."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan

import pytest

from bridge.core.authority.requests import bad_proof
from bridge.core.geometry.kinematics import twist_of
from bridge.core.geometry.odometry import arc_end
from bridge.core.modes.arming import arm_lacks, reset_lacks
from bridge.core.modes.stop_monitor import _failure
from bridge.core.modes.transition import _begin_stop
from bridge.core.motion.contact_gate import contact_gate, touched_input
from bridge.core.motion.motion_gates import reconsider
from tests.bridge.core.reached import reached
from tests.bridge.core.test_quick_core import ROBOT, tick_of
from wire import IDENTITY, STILL, Action, Twist2


def test_every_reason_is_told_to_the_last() -> None:
    tick = tick_of(reached("active"))
    assert [code for code, _ in arm_lacks(tick)] == ["not_disarmed"]
    assert [code for code, _ in reset_lacks(tick)] == ["not_latched"]
    for nonce, authentic, code in ((None, True, "bad_proof"), ("b0.0", True, "old_nonce")):
        told = [one for one, _ in bad_proof(tick, "arm", "a1", nonce, authentic=authentic)]
        assert told == [code]


def test_without_a_stop_none_fails_and_a_row_in_a_stop_only_makes_it_harder() -> None:
    assert _failure(tick_of(reached("active"))) is None
    tick = tick_of(reached("stopping_by_row"))
    _begin_stop(tick, Action.STOP1, "stuck", Action.STOP1, reset_needed=False)
    assert tick.s.stopping is not None
    assert tick.s.stopping.action is Action.STOP1


def test_no_hand_on_the_stick_unblocks_a_way() -> None:
    world = reached("teleop")
    world.state.gate = replace(world.state.gate, blocked=True, free_scans=4)
    tick = tick_of(world)
    reconsider(tick, Twist2(0.3, 0.0))
    assert tick.s.gate.blocked
    assert tick.s.gate.free_scans == 4


def test_wheels_and_arcs_that_are_no_numbers_move_nothing() -> None:
    assert twist_of(nan, 1.0, ROBOT.base) == STILL
    assert arc_end(IDENTITY, 1.0, inf) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("pressed", "v_mps", "name"),
    [
        ("bumper_front", 0.3, "bumper_front"),
        ("bumper_front", -0.3, None),
        ("bumper_rear", -0.3, "bumper_rear"),
        ("bumper_rear", 0.3, None),
        ("cliff", 0.3, "cliff"),
        ("cliff", -0.3, None),
        ("cliff", 0.0, None),
        ("bumper_rear", 0.0, None),
    ],
)
def test_a_contact_shuts_the_way_it_faces(pressed: str, v_mps: float, name: str | None) -> None:
    state = reached("active").state.drive.newest
    assert state is not None
    state = state.model_copy(update={pressed: True})
    assert touched_input(state, v_mps) == name
    passed = contact_gate(state, Twist2(v_mps, 1.0))
    if name is not None:
        assert passed == Twist2(0.0, 0.3)
    elif v_mps:
        assert passed.v_mps == pytest.approx(v_mps / abs(v_mps) * 0.09)
        assert passed.w_radps == pytest.approx(0.3)
    else:
        assert passed == Twist2(0.0, 0.3)
