"""Find the wheel radius of a base that runs in the bridge: runs in a line, odometry against a wall.

Such a base tells nobody each state of its wheels, so no motor can be fitted; its own firmware
regulates its speed. What the bridge reckons of it is on the wire, and by which radius is known. It
faces the way itself no more than it fits motors: a person puts it before a wall.
"""

from __future__ import annotations

from math import copysign
from typing import TYPE_CHECKING

from pons.calibrate.clearance import SHORTEST_M, best_way
from pons.calibrate.errors import CalibrationRefusal, RunLost
from pons.calibrate.findings import (
    RADIUS_SPREAD,
    CalibrationFinding,
    check_limits,
    close,
    plausible,
)
from pons.calibrate.procedure import clear_metres, points_ahead, ready, take_runs
from pons.calibrate.reference import LIDAR, SPOKEN, TRUTH, went_m
from pons.calibrate.runs import FAST_MPS, FAST_SHARE, stopping_m
from wire import distance

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from pons.calibrate.procedure import CalibrationPlan
    from pons.calibrate.session import CalibrationRig
    from wire import Odometry, RobotDescription

SLOWEST_MPS = 0.1
"""A base with a slow dead-man is held to 0.15 m/s, whatever is asked."""


def find_radius(
    rig: CalibrationRig,
    robot: RobotDescription,
    plan: CalibrationPlan,
    when: str,
    say: Callable[[str], None],
    ask_m: Callable[[], float],
) -> list[CalibrationFinding]:
    """Drive to and fro and measure; the robot stands when this returns or raises.

    Raises:
        CalibrationRefusal: nothing was measured that may be believed.
    """
    status = rig.listen(needs_senses=False)
    ready(status, robot)
    reference = plan.reference or LIDAR
    if reference == TRUTH:
        raise CalibrationRefusal("no_truth")
    was_m = robot.base.wheel_radius_m
    run_m = best_way(points_ahead(rig, robot), robot.base.radius_m, (0.0,)).run_m
    say(f"runs of {run_m:.2f} m; distances by {SPOKEN[reference]}; the wheels by odometry")
    runs = take_runs(
        rig, plan, say, "run", 2 * plan.shuttles,
        lambda sign: _run(rig, robot, sign * run_m, reference, ask_m),
        lambda run: f"odometry {run[1]:.3f} m, truly {run[0]:.3f} m, "
        f"radius {was_m * run[0] / run[1]:.4f} m",
    )  # fmt: skip
    radii = [was_m * went / reckoned for went, reckoned in runs]
    radius_m = close("base.wheel_radius_m", radii, RADIUS_SPREAD)
    plausible("base.wheel_radius_m", radius_m, was_m)
    evidence = (
        f"calibrated {when}: median of {len(radii)} runs, {min(radii):.4f} to {max(radii):.4f}; "
        f"odometry against {SPOKEN[reference]}"
    )
    found = [CalibrationFinding("base", "wheel_radius_m", was_m, round(radius_m, 5), evidence)]
    check_limits(robot, found)
    return found


def reckoned_m(said: Sequence[Odometry]) -> float:
    """Return the way that odometry says, without sign [m]; it begins and ends standing.

    Raises:
        RunLost: it can't be read.
    """
    if len(said) < 3:
        raise RunLost("run_lost", "no odometry was heard")
    if any(one.odom_id != said[0].odom_id for one in said):
        raise RunLost("run_lost", "odometry began anew")
    return distance(said[0].base_in_odom, said[-1].base_in_odom)


def _run(
    rig: CalibrationRig,
    robot: RobotDescription,
    metres: float,
    reference: str,
    ask_m: Callable[[], float],
) -> tuple[float, float]:
    """Drive one run; return the way by the reference and by odometry [m].

    Raises:
        CalibrationRefusal, RunLost: it was none.
    """
    metres = clear_metres(rig, robot, metres)
    mps = max(SLOWEST_MPS, min(FAST_MPS, FAST_SHARE * robot.limits.max_speed_mps))
    target_m = abs(metres) - stopping_m(mps, robot)
    before, limit_s = rig.look(), 6.0 + 2.0 * abs(metres) / SLOWEST_MPS
    said: list[Odometry] = []
    with rig.hold(odometry=said):
        began_m = rig.way_m
        rig.steer(copysign(mps, metres), 0.0, lambda: rig.way_m - began_m >= target_m, limit_s)
    reckoned = reckoned_m(said)
    if not reckoned >= SHORTEST_M / 2:
        raise RunLost("run_lost", f"odometry says {reckoned:.2f} m")
    return went_m(reference, before, rig.look(), robot, ask_m), reckoned
