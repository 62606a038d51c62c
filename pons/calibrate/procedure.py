"""Go through a calibration: look for room, drive every run, repeat what was lost, read it all.

Knows the rig and the runs; no terminal, no file. What it tells a person goes through ``say``, what
a person measures comes through ``ask_m``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from math import pi
from typing import TYPE_CHECKING, TypeVar

from pons.calibrate.clearance import best_way, clear_to_turn, free_m, needed_m, points_of
from pons.calibrate.errors import CalibrationRefusal, RunLost
from pons.calibrate.findings import StraightRun, findings, of_straight, radius_of, separation_m
from pons.calibrate.reference import LIDAR, MEASURED, SPOKEN, TRUTH, turned_rad, went_m
from pons.calibrate.runs import ROUND_RAD, straight, turn
from wire import Mode

if TYPE_CHECKING:
    from collections.abc import Callable

    from pons.calibrate.clearance import ClearWay
    from pons.calibrate.findings import CalibrationFinding
    from pons.calibrate.session import CalibrationRig
    from pons.calibrate.wall import Points
    from wire import RobotDescription, Status

R = TypeVar("R")

TRIES = 3
TURNS = 6
"""At most, until it faces its way; then the way ahead serves if it is long enough."""
FEWEST_RUNS = 2

_MODES = {
    Mode.ESTOPPED: "estopped",
    Mode.FAULT: "fault",
    Mode.DISARMED: "not_armed",
    Mode.BOOT: "not_ready",
    Mode.SELFTEST: "not_ready",
    Mode.ACTIVE: "busy",
    Mode.TELEOP: "busy",
    Mode.STOPPING: "busy",
}

_AFTERMATH = {"not_armed", "fault", "no_room"}
"""What a lost run may lead to; the run's own trouble is what a person must hear."""


@dataclass(frozen=True, slots=True)
class CalibrationPlan:
    """Hold the options of a calibration."""

    reference: str | None
    """None: truth where a simulator tells it, else the lidar."""
    shuttles: int = 3
    turns: int = 4
    patience_s: float = 0.0
    """How long to wait for a person to arm again where a lost run disarmed the robot."""


def calibrate(
    rig: CalibrationRig,
    robot: RobotDescription,
    plan: CalibrationPlan,
    when: str,
    say: Callable[[str], None],
    ask_m: Callable[[], float],
) -> list[CalibrationFinding]:
    """Drive and measure; the robot stands when this returns or raises.

    Raises:
        CalibrationRefusal: nothing was measured that may be believed.
    """
    status = rig.listen()
    ready(status, robot)
    reference = plan.reference or (TRUTH if rig.truth is not None else LIDAR)
    if reference == TRUTH and not (status.drive.virtual and rig.truth is not None):
        raise CalibrationRefusal("no_truth")
    run_m = _face_the_way(rig, robot, plan, say)
    say(f"runs of {run_m:.2f} m; distances by {SPOKEN[reference]}")
    straights = take_runs(
        rig, plan, say, "run", 2 * plan.shuttles,
        lambda sign: _straight(rig, robot, sign * run_m, reference, ask_m), _run_line,
    )  # fmt: skip
    radius_m = radius_of(straights, robot)  # before the turns, which a wrong one would spoil
    separations = take_runs(
        rig, plan, say, "turn", plan.turns,
        lambda sign: _turn(rig, robot, sign * ROUND_RAD, reference, radius_m),
        lambda separation_m: f"separation {separation_m:.4f} m",
    )  # fmt: skip
    by = SPOKEN[reference]
    if reference == MEASURED:
        by = f"{by} of distances and {SPOKEN[LIDAR]} in turns"
    return findings(straights, separations, robot, by, when)


def ready(status: Status, robot: RobotDescription) -> None:
    """See that the robot is this one, armed, standing and nobody else's.

    Raises:
        CalibrationRefusal: it is not.
    """
    if status.mode in _MODES:
        who = f"mode {status.mode.value}"
        if status.mode is Mode.ACTIVE and status.grant is not None:
            who = f"mission {status.grant.mission} is driving"
        raise CalibrationRefusal(_MODES[status.mode], who)
    if status.robot_hash != robot.hash:
        text = f"the bridge has {status.robot_hash[:12]}, the file {robot.hash[:12]}"
        raise CalibrationRefusal("other_robot_toml", text)


def _face_the_way(
    rig: CalibrationRig, robot: RobotDescription, plan: CalibrationPlan, say: Callable[[str], None]
) -> float:
    """Look, choose and turn until it faces what it chose; return how long a run may be.

    A turn by a robot.toml that is wrong ends some degrees off: each look chooses anew.
    """
    for _ in range(TURNS):
        way = retry_lost(rig, plan, say, lambda: _turn_nearer(rig, robot, say))
        if not way.turns_rad:
            return way.run_m
    return best_way(points_ahead(rig, robot), robot.base.radius_m, (0.0,)).run_m


def _turn_nearer(
    rig: CalibrationRig, robot: RobotDescription, say: Callable[[str], None]
) -> ClearWay:
    """Look, choose a way and, unless it is ahead, take the first turn that leads there."""
    way = best_way(points_ahead(rig, robot), robot.base.radius_m)
    say(
        f"needs {needed_m(way.run_m):.2f} m ahead of the robot's edge and a turn of "
        f"{way.heading_rad * 180 / pi:.0f} degrees to face it"
    )
    for angle_rad in way.turns_rad[:1]:
        turn(rig, robot, angle_rad)
    return way


def points_ahead(rig: CalibrationRig, robot: RobotDescription) -> Points:
    """Return where beams of a fresh scan came back, in ``base`` [m]."""
    return points_of(rig.look().scans[-1], robot)


def clear_metres(rig: CalibrationRig, robot: RobotDescription, metres: float) -> float:
    """Return a run for which there is room: this one, or back where one was cut short.

    Raises:
        CalibrationRefusal: ``no_room``.
    """
    ahead, behind = free_m(points_ahead(rig, robot), robot.base.radius_m)
    run_m, needs_m = abs(metres), needed_m(abs(metres))
    if metres > 0.0 and not ahead >= needs_m:
        # After a run that was cut short the robot is somewhere on its way: drive it back.
        if not behind >= run_m:
            text = f"{ahead:.2f} m are free, the run needs {needs_m:.2f} m"
            raise CalibrationRefusal("no_room", text)
        metres = -run_m
    elif metres < 0.0 and not behind >= run_m:
        if not ahead >= needs_m:
            text = f"{behind:.2f} m are free behind, the way back needs {run_m:.2f} m"
            raise CalibrationRefusal("no_room", text)
        metres = run_m
    return metres


def _straight(
    rig: CalibrationRig,
    robot: RobotDescription,
    metres: float,
    reference: str,
    ask_m: Callable[[], float],
) -> StraightRun:
    run = straight(rig, robot, clear_metres(rig, robot, metres))
    return of_straight(run, went_m(reference, run.before, run.after, robot, ask_m))


def _turn(
    rig: CalibrationRig, robot: RobotDescription, angle_rad: float, reference: str, radius_m: float
) -> float:
    clear_to_turn(points_ahead(rig, robot), robot.base.radius_m)
    run = turn(rig, robot, angle_rad)
    left, right = run.track.turned_rad()
    by_wheels = (right - left) * radius_m / robot.base.wheel_separation_m
    kind = TRUTH if reference == TRUTH else LIDAR
    turned = turned_rad(kind, run.track, run.before, run.after, robot, by_wheels)
    return separation_m(run, turned, radius_m)


def take_runs(  # what is driven, and how it is told
    rig: CalibrationRig,
    plan: CalibrationPlan,
    say: Callable[[str], None],
    name: str,
    count: int,
    take: Callable[[float], R],
    tell: Callable[[R], str],
) -> list[R]:
    """Take so many runs, forth (1.0) and back (-1.0) in turn, and tell what each showed.

    Raises:
        CalibrationRefusal: one was lost each time, or cannot be taken.
    """
    found: list[R] = []
    for number in range(count):
        found.append(retry_lost(rig, plan, say, partial(take, 1.0 if number % 2 == 0 else -1.0)))
        say(f"{name} {number + 1}/{count}: {tell(found[-1])}")
    return found


def retry_lost(
    rig: CalibrationRig, plan: CalibrationPlan, say: Callable[[str], None], take: Callable[[], R]
) -> R:
    """Take a run; one that was lost is taken again, a few times.

    Raises:
        CalibrationRefusal: it was lost each time, or cannot be taken.
    """
    before = RunLost("run_lost", "")
    for _ in range(TRIES):
        try:
            return take()
        except RunLost as lost:
            say(f"lost a run ({lost}); pons arm, if that disarmed it, after pons reset, if FAULT")
            before = lost
            if not rig.settle(plan.patience_s):
                break
        except CalibrationRefusal as refused:
            if refused.code in _AFTERMATH and before.detail:  # what the lost run led to
                raise CalibrationRefusal(before.code, before.detail) from None
            raise
    raise CalibrationRefusal(before.code, before.detail)


def _run_line(run: StraightRun) -> str:
    left, right = run.gains
    return (
        f"radius {run.radius_m:.4f} m, dead zone {run.dead_zone_radps:.3f} rad/s, "
        f"lag {run.lag_s:.3f} s, gains {left:.3f} {right:.3f}, "
        f"braking {run.braking_radps2:.2f} rad/s2"
    )
