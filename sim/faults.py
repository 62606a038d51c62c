"""Break the robot on demand, in one place. A set of switches that tick() looks at; off by default.

A fault changes what hardware does or says, never what the simulator knows: truth stays true.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(slots=True)
class Faults:
    """Hold the switches; a story turns them while it runs."""

    drive_silent: bool = False  # no drive/state: a broken cable back
    deaf: bool = False  # no command arrives: a broken cable forth
    lidar_silent: bool = False
    imu_silent: bool = False
