"""Hold what a touched input shuts."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.motion.motion_gates import contact_gate, touched_input
from tests.bridge.core.fake_planner import FakeDrive
from tests.bridge.core.reached import reached
from tests.bridge.core.scripted import World
from wire import STILL, DriveState, Mode, Twist2

speeds = st.floats(-2.0, 2.0)


def state(*pressed: str) -> DriveState:
    return FakeDrive().tick(0.0).model_copy(update=dict.fromkeys(pressed, True))


@pytest.mark.parametrize("unsaid", ["bumper_front", "bumper_rear", "cliff"])
@pytest.mark.parametrize("v_mps", [-0.4, 0.0, 0.4])
def test_an_input_that_is_not_told_counts_as_pressed(unsaid: str, v_mps: float) -> None:
    silent, felt = state().model_copy(update={unsaid: None}), state(unsaid)
    assert touched_input(silent, v_mps) == touched_input(felt, v_mps)
    assert contact_gate(silent, Twist2(v_mps, 1.0)) == contact_gate(felt, Twist2(v_mps, 1.0))


@given(speeds, speeds)
def test_untouched_everything_passes(v: float, w: float) -> None:
    assert contact_gate(state(), Twist2(v, w)) == Twist2(v, w)
    assert contact_gate(None, Twist2(v, w)) == Twist2(v, w)


@given(
    st.sets(st.sampled_from(["bumper_front", "bumper_rear", "cliff"]), min_size=1), speeds, speeds
)
def test_nothing_goes_on_into_it_and_nothing_else_is_fast(
    pressed: set[str], v: float, w: float
) -> None:
    felt = state(*pressed)
    passed = contact_gate(felt, Twist2(v, w))
    assert touched_input(felt, passed.v_mps) is None
    assert abs(passed.v_mps) <= 0.1 + 1e-12
    assert abs(passed.w_radps) <= 0.3 + 1e-12
    assert passed.v_mps * v >= 0.0
    assert passed.w_radps * w >= 0.0
    if touched_input(felt, v) is None and abs(v) > 1e-6:
        assert passed.w_radps * v == pytest.approx(w * passed.v_mps), "the curve stays"


@pytest.mark.parametrize("pressed", ["bumper_front", "cliff"])
def test_a_driving_robot_that_touches_stops_and_is_blocked_until_let_go(pressed: str) -> None:
    world = World().driving((5.0, 0.0))
    world.drive.pressed = (pressed,)
    world.run(0.4)
    assert world.sent.v_mps < 0.2
    assert world.state.motion.bound_by == "contact"
    world.run(1.0)
    assert world.sent == STILL
    assert world.state.gate.blocked
    assert world.is_in(Mode.HOLD)
    world.run(3.0)
    assert world.is_in(Mode.HOLD), "free space ahead is not enough"
    world.drive.pressed = ()
    world.until(Mode.ACTIVE, 2.0)


def test_a_hand_on_the_stick_may_back_away_slowly() -> None:
    world = World().armed()
    world.teleop(0.0, held=False)  # a stick is let go of first
    world.tick()
    world.drive.pressed = ("bumper_front",)
    fastest = 0.0
    for _ in range(150):
        world.teleop(-0.4, 0.0, held=True)
        world.tick()
        fastest = max(fastest, -world.sent.v_mps)
    assert world.is_in(Mode.TELEOP)
    assert fastest == pytest.approx(0.1)
    for _ in range(100):
        world.teleop(0.4, 0.0, held=True)
        world.tick()
    assert world.sent.v_mps <= 1e-9


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
    assert touched_input(None, v_mps) is None
    passed = contact_gate(state, Twist2(v_mps, 1.0))
    if name is not None:
        assert passed == Twist2(0.0, 0.3)
    elif v_mps:
        assert passed.v_mps == pytest.approx(v_mps / abs(v_mps) * 0.09)
        assert passed.w_radps == pytest.approx(0.3)
    else:
        assert passed == Twist2(0.0, 0.3)
