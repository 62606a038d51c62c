"""Define the simulator's own messages: the truth, the scene, and requests to break the robot.

Nothing here is spoken by or to a real robot; no safety function reads any of it.
"""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

from pydantic import Field

from wire.base import Record
from wire.bounded_types import Count, Name, Seconds
from wire.geometry import Metres, Pose2, Twist2


class SimFault(StrEnum):
    """Name the faults that can be simulated; beside each stands the hardware's reaction."""

    DRIVE_DEAF = "drive_deaf"  # no command arrives: a broken cable forth
    DRIVE_OFF = "drive_off"  # no state arrives: a broken cable back
    ENCODER_STUCK = "encoder_stuck"  # angle and speed of both wheels stay what they were
    ENCODER_GARBAGE = "encoder_garbage"  # any angle, any speed
    ENCODER_DELAYED = "encoder_delayed"  # states arrive 0.3 s late, stamped when they were made
    ENCODER_INTERMITTENT = "encoder_intermittent"  # 0.4 s of every 0.8 s are missing
    LIDAR_OFF = "lidar_off"
    LIDAR_STUCK = "lidar_stuck"  # one picture again and again, freshly stamped and numbered
    LIDAR_BLIND = "lidar_blind"  # no beam comes back: a cover, fog, a black room
    LIDAR_SECTOR = (
        "lidar_sector"  # no beam of one sector comes back: tape, dirt, a lidar bent aside
    )
    LIDAR_GARBAGE = "lidar_garbage"  # any range
    LIDAR_DELAYED = "lidar_delayed"
    LIDAR_INTERMITTENT = "lidar_intermittent"
    CAMERA_OFF = "camera_off"
    CAMERA_STUCK = "camera_stuck"  # one picture again and again, freshly stamped and numbered
    CAMERA_BLIND = "camera_blind"  # black, and no depth: a cover, a dead lamp
    CAMERA_DELAYED = "camera_delayed"  # pictures arrive 1 s late, stamped when they were taken
    GYRO_OFF = "gyro_off"
    GYRO_STUCK = "gyro_stuck"
    GYRO_GARBAGE = "gyro_garbage"
    GYRO_DELAYED = "gyro_delayed"
    GYRO_INTERMITTENT = "gyro_intermittent"
    WHEEL_STUCK = "wheel_stuck"  # the left wheel is blocked
    SLIP = "slip"  # wheels on ice
    RUNAWAY = "runaway"  # both wheels at 1.2 m/s whatever is asked, while there is torque
    REVERSED = "reversed"  # both wheels turn the other way
    BATTERY_LOW = "battery_low"  # 15 %
    BATTERY_SAG = "battery_sag"  # 5 % as soon as a wheel is asked to turn
    BUMPER_FRONT = "bumper_front"  # pressed
    BUMPER_REAR = "bumper_rear"
    CLIFF = "cliff"
    ESTOP_PRESSED = "estop_pressed"


Faults = Annotated[tuple[SimFault, ...], Field(max_length=len(SimFault))]


class SimTruth(Record):
    """Tell judges, tests and the localization stand-in where the simulated robot really is."""

    boot_id: Name
    seq: Count
    stamp_s: Seconds
    base_in_map: Pose2
    twist: Twist2
    contacts: Annotated[int, Field(ge=0, le=10_000)]
    """Contacts of the robot with anything but the floor, at this instant."""
    contacts_total: Count
    """Contact episodes since start."""
    real_time_factor: Annotated[float, Field(ge=0.0, le=1_000.0)]
    faults: Faults = ()
    """What is broken now, by wish."""


class SimThing(Record):
    """Say where one movable thing of the home stands now, in ``map``: a person, an obstacle, a cup.

    How high it lies follows from what stands there: on furniture, or on the floor.
    """

    name: Name
    pose: Pose2 | None
    """Null: it is nowhere in the home."""


class SimScene(Record):
    """Give the simulated camera its scene: where the robot and all movable things are."""

    boot_id: Name
    seq: Count
    stamp_s: Seconds
    base_in_map: Pose2
    things: Annotated[tuple[SimThing, ...], Field(max_length=64)] = ()
    """Those that stand elsewhere than the home declares."""
    faults: Faults = ()


class SimControl(Record):
    """Let a test move the simulated robot or a thing of its home, or break it."""

    id: Name
    place_robot: Pose2 | None = None
    place_obstacle: tuple[Metres, Metres] | None = None
    remove_obstacle: bool = False
    place_thing: SimThing | None = None
    """Any person or object of the home, or a spare obstacle, by its name."""
    faults: Faults | None = None
    """All that is to be broken from now on; empty mends everything, null changes nothing."""
