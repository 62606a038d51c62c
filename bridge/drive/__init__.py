"""Turn wheel commands into motion and wheels into readings. One file per kind of drive."""

from bridge.drive.base import Braking, Drive, require_brakes
from bridge.drive.sim import SimDrive

__all__ = ["Braking", "Drive", "SimDrive", "require_brakes"]
