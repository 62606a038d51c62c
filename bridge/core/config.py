"""Hold the bridge's constants. Read once by ``__main__`` and bound to every step."""

from __future__ import annotations

from dataclasses import dataclass

from bridge.core.geometry.fence import FenceGrid
from bridge.core.state_motion import UNLEARNT, Learnt
from wire import RobotDescription


@dataclass(frozen=True, slots=True)
class CoreConfig:
    """Describe robot, site and run. No key material: proofs are verified where bytes are read."""

    robot: RobotDescription
    robot_hash: str
    fence: FenceGrid | None
    """None: nothing is fenced, which SELFTEST refuses."""
    fence_hash: str
    map_id: str
    """The map that the fence was drawn on; hello and waypoints must name it."""
    boot: str
    """This run's name, [A-Za-z0-9]{1,32}: prefix of epochs and nonces, and the odom_id."""
    period_s: float = 0.01
    dead_man_s: float | None = None
    """Silence after which this very base was seen to stop; None: nobody has tried. Counts only for
    a drive that does not report it."""
    marks: str = ""
    """The text of what people drew on the map, as an earlier run was left with; empty: nothing."""
    learnt: Learnt = UNLEARNT
    """What earlier runs learnt of this robot's brakes: the state goes on from there."""
    braking_trouble: str | None = None
    """Why what earlier runs learnt could not be read: a code for the status."""


PERIOD_S = 0.01
