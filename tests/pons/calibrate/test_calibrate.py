"""Calibration finds the simulated metal that robot.toml is wrong about, and leaves it standing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import cos, sin

import pytest

from pons.calibrate import runs, session
from pons.calibrate.clearance import SHORTEST_M
from pons.calibrate.errors import CalibrationRefusal
from pons.calibrate.findings import CalibrationFinding, findings, of_straight
from pons.calibrate.procedure import CalibrationPlan
from pons.calibrate.reference import TRUTH, went_m
from pons.calibrate.runs import straight
from tests.known import known
from tests.pons.calibrate.metal import FACING, TRUE, Bench, gone_through
from tools.lockstep import LockstepWorld
from wire import Mode, Pose2, SimFault, distance

pytestmark = pytest.mark.nightly(keep=4)


TIGHT = Pose2(0.38, 1.8, 1.5708)
"""Beside a wall: the disc fits, the margin for turning does not."""


@pytest.fixture(scope="module")
def driven() -> tuple[Bench, dict[str, CalibrationFinding]]:
    """Calibrate by truth; what was heard is then read by others, who drive nothing."""
    bench = Bench()
    return bench, bench.calibrate(CalibrationPlan(None, shuttles=1, turns=2))


def test_a_wrong_description_is_found_out(
    driven: tuple[Bench, dict[str, CalibrationFinding]],
) -> None:
    bench, found = driven
    is_right(found, "the simulator's truth")
    assert bench.world.standing
    assert bench.world.contacts == 0
    assert bench.world.status.mode is Mode.HOLD
    assert any("m ahead of the robot's edge" in line for line in bench.said)


def test_the_lidar_finds_the_same(driven: tuple[Bench, dict[str, CalibrationFinding]]) -> None:
    bench, by_truth = driven
    said: list[str] = []
    plan = CalibrationPlan("lidar", shuttles=1, turns=2)
    by_lidar = gone_through(bench.tape.again(), bench.robot, plan, said.append)
    is_right(by_lidar, "the lidar")
    assert by_lidar["base.wheel_radius_m"].value != by_truth["base.wheel_radius_m"].value
    assert any("distances by the lidar" in line for line in said)


def is_right(found: dict[str, CalibrationFinding], spoken: str) -> None:
    values = {name: one.value for name, one in found.items()}
    assert values["base.wheel_radius_m"] == pytest.approx(0.1, rel=0.005)
    assert values["base.wheel_separation_m"] == pytest.approx(0.5, rel=0.005)
    assert values["drive.dead_zone_radps"] == pytest.approx(0.05, abs=0.005)
    assert 0.06 <= values["drive.lag_s"] <= 0.09
    assert 0.04 <= values["drive.response_s"] <= 0.06
    assert 0.9 <= values["limits.max_decel_mps2"] <= 1.0
    assert spoken in found["base.wheel_radius_m"].evidence


def test_unequal_motors_are_told_of() -> None:
    unequal = replace(TRUE, left_gain=0.95, right_gain=1.08, dead_zone_radps=0.1)
    bench = Bench(hardware=unequal, start=FACING)
    bench.rig.listen()
    seen = []
    for metres in (SHORTEST_M, -SHORTEST_M):
        run = straight(bench.rig, bench.robot, metres)
        seen.append(of_straight(run, went_m(TRUTH, run.before, run.after, bench.robot, float)))
    apart_m = (bench.robot.base.wheel_separation_m,)  # turns tell nothing of motors
    found = {one.name: one for one in findings(seen, apart_m, bench.robot, "truth", "now")}
    assert found["drive.dead_zone_radps"].value == pytest.approx(0.1, abs=0.01)
    assert "left 0.95" in found["drive.dead_zone_radps"].evidence
    assert "right 1.08" in found["drive.dead_zone_radps"].evidence


def test_a_person_measures_with_a_tape(driven: tuple[Bench, dict[str, CalibrationFinding]]) -> None:
    bench, _ = driven
    heard = bench.tape.again()
    began = bench.start or bench.world.scene.site.home.pose
    at: list[Pose2] = [began]

    def measure() -> float:
        here = known(heard.truth).base_in_map
        apart_m = distance(here, at[-1])
        at.append(here)
        return round(apart_m, 2)  # as a tape is read

    plan = CalibrationPlan("measured", shuttles=1, turns=1)
    found = gone_through(heard, bench.robot, plan, bench.said.append, measure)
    assert found["base.wheel_radius_m"].value == pytest.approx(0.1, rel=0.015)
    assert "a person's measure of distances and the lidar in turns" in (
        found["base.wheel_radius_m"].evidence
    )
    assert len(at) == 3


# Refusals ---------------------------------------------------------------------------------------


def refusal(bench: Bench) -> str:
    with pytest.raises(CalibrationRefusal) as refused:
        bench.calibrate()
    assert bench.world.standing
    assert refused.value.lines()[-1].isascii()
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("LC_ALL", "zh_CN.UTF-8")
        assert any("一" <= character <= "鿿" for character in refused.value.lines()[-1])
    return refused.value.code


@pytest.mark.parametrize(
    ("act", "code"),
    [
        (lambda world: (world.operate("disarm"), world.run(1.0)), "not_armed"),
        (lambda world: world.operate("estop"), "estopped"),
        (lambda world: world.sim.break_down(SimFault.LIDAR_BLIND), "no_lidar"),
    ],
)
def test_a_robot_that_may_not_drive_is_left_alone(
    act: Callable[[LockstepWorld], object], code: str
) -> None:
    bench = Bench()
    act(bench.world)
    assert refusal(bench) == code


def test_a_planner_that_drives_is_left_alone() -> None:
    bench = Bench()
    bench.world.say("go to the living room")
    bench.world.run_until(lambda w: w.status.mode is Mode.ACTIVE, 20.0)
    with pytest.raises(CalibrationRefusal, match="is driving") as refused:
        bench.calibrate()
    assert refused.value.code == "busy"
    bench.world.run(0.5)
    assert bench.world.status.mode is Mode.ACTIVE


def test_too_little_room_is_said_with_figures() -> None:
    bench = Bench(start=TIGHT)
    with pytest.raises(CalibrationRefusal, match=r"turning needs 0\.35 m") as refused:
        bench.calibrate()
    assert refused.value.code == "no_room"
    assert bench.world.standing


def test_another_robot_toml_is_refused() -> None:
    bench = Bench()
    bench.robot = bench.robot.model_copy(update={"id": "r2"})
    assert refusal(bench) == "other_robot_toml"


@pytest.fixture
def hurried(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave out most of a run's slow part, in which nothing happens that these tests look at."""
    monkeypatch.setattr(runs, "SLOW_S", 0.3)


def under_way(bench: Bench, act: Callable[[LockstepWorld], None]) -> None:
    """Do something as soon as the first run is fast."""

    def later(world: LockstepWorld) -> None:
        if world.status.mode is Mode.TELEOP and world.twist.v_mps > 0.2:
            act(world)
        else:
            world.at(world.tick_count + 1, later)

    bench.world.at(bench.world.tick_count + 1, later)


@pytest.mark.usefixtures("hurried")
@pytest.mark.parametrize("fault", [SimFault.DRIVE_OFF, SimFault.ENCODER_STUCK])
def test_encoders_that_fail_during_a_run_end_it(
    fault: SimFault, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(session, "STAND_S", 2.0)  # in vain: without encoders nobody sees it stand
    monkeypatch.setattr(session, "QUIET_S", 1.0)  # likewise: they stay broken
    bench = Bench(start=FACING)
    under_way(bench, lambda world: world.sim.break_down(fault))
    assert refusal(bench) == "encoder_fault"
    assert bench.world.contacts == 0


@pytest.mark.usefixtures("hurried")
def test_a_stop_pressed_during_a_run_ends_it() -> None:
    bench = Bench(start=FACING)
    under_way(bench, lambda world: world.sim.break_down(SimFault.ESTOP_PRESSED))
    assert refusal(bench) == "estopped"


@pytest.mark.usefixtures("hurried")
def test_somebody_in_the_way_ends_it() -> None:
    bench = Bench(start=FACING)

    def step_in(world: LockstepWorld) -> None:
        here, ahead = world.truth, 1.0
        world.sim.place_obstacle(
            here.x_m + ahead * cos(here.yaw_rad), here.y_m + ahead * sin(here.yaw_rad)
        )

    under_way(bench, step_in)
    assert refusal(bench) in {"blocked", "no_room", "run_lost"}
    assert bench.world.contacts == 0


@pytest.mark.usefixtures("hurried")
def test_ctrl_c_during_a_run_leaves_it_standing() -> None:
    bench = Bench(start=FACING)

    def interrupt(world: LockstepWorld) -> None:
        raise KeyboardInterrupt

    under_way(bench, interrupt)
    with pytest.raises(KeyboardInterrupt):
        bench.calibrate()
    assert bench.world.standing
    assert bench.world.status.mode is Mode.HOLD
