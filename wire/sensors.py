"""Define the messages of robot and localization; ``stamp_s`` is the sender's own clock."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from wire.base import Record
from wire.bounded_types import (
    MAX_BEAMS,
    Code,
    Count,
    Fingerprint,
    Name,
    Ratio,
    Seconds,
    Text,
    WheelAngle,
    WheelSpeed,
)
from wire.geometry import Metres, Pose2, Radps, Twist2, Yaw

Range = Annotated[float, Field(ge=0.0, le=1_000.0)]


class DriveState(Record):
    """Report the drive's motion and the inputs that are wired to it."""

    boot_id: Name
    seq: Count
    stamp_s: Seconds
    echo_boot: Name | None
    """Which bridge the echoed command came from; none since this boot if null."""
    echo_seq: Count
    enabled: bool
    timed_out: bool | None
    """The drive's own dead-man has fired: it had no command for its time-out. Null: it has one that
    it does not report; row DEAD_MAN says what follows."""
    left_rad: WheelAngle
    right_rad: WheelAngle
    left_radps: WheelSpeed
    right_radps: WheelSpeed
    current_a: Annotated[float, Field(ge=-1_000.0, le=1_000.0)] | None = None
    battery: Ratio | None = None
    estop_pressed: bool | None = None
    """Null, in this and the next three: not told, or not readable. It counts as pressed, and a self
    test waits until all are told: what has no such input says false."""
    bumper_front: bool | None = None
    bumper_rear: bool | None = None
    cliff: bool | None = None
    """In front: the floor ends."""


class DriveCommand(Record):
    """Set both wheel speeds [rad/s]; ``enable`` false takes the torque away."""

    boot: Name
    seq: Count
    left_radps: WheelSpeed
    right_radps: WheelSpeed
    enable: bool


class Scan(Record):
    """Give one planar scan, beam by beam from ``angle_min_rad``, in the lidar's frame.

    A beam is null where nothing came back; a value under ``range_min_m`` means too near to measure.
    """

    boot_id: Name
    seq: Count
    stamp_s: Seconds
    angle_min_rad: Yaw
    angle_increment_rad: Annotated[float, Field(gt=0.0, le=1.0)]
    range_min_m: Range
    range_max_m: Range
    ranges_m: Annotated[tuple[Range | None, ...], Field(max_length=MAX_BEAMS)]
    time_increment_s: Annotated[float, Field(ge=0.0, le=0.01)] = 0.0
    """Between two beams, as in sensor_msgs/LaserScan; ``stamp_s`` is the first beam's. 0: all beams
    were taken at one instant."""
    clockwise: bool = False
    """The lidar turns clockwise: it took the last beam listed first, at ``stamp_s``, and the first
    listed last."""


class LidarStatus(Record):
    """Say what a lidar's own process reads at its port, for people; the bridge needs none of it."""

    boot_id: Name
    seq: Count
    stamp_s: Seconds
    model: Name
    """Kind and model of robot.toml."""
    code: Code | None
    """What is wrong, None where nothing is: of the port (``port_gone``) or of the lidar
    (``lidar_silent``); docs/lidars.md lists them."""
    detail: Text = ""
    """What came, what was expected and what cures it; empty where nothing is wrong."""
    rate_hz: Annotated[float, Field(ge=0.0, le=1_000.0)]
    """Whole turns a second, of the last seconds."""
    frames: Count
    """Good ones since the process began, as the next four are."""
    spoilt: Count
    """Frames that failed their check."""
    lost_bytes: Count
    """Bytes that belonged to no good frame."""
    broken_turns: Count
    """Turns with a gap or too slow, of which no scan was made."""
    opened: Count
    """How often the port was opened."""


class CameraStatus(Record):
    """Say what a camera's own process gets of it, for people; nobody drives by it."""

    boot_id: Name
    seq: Count
    stamp_s: Seconds
    model: Name
    """Kind of robot.toml."""
    code: Code | None
    """What is wrong, None where nothing is; docs/sensors.md lists them."""
    detail: Text = ""
    """What came, what was expected and what cures it; empty where nothing is wrong."""
    rate_hz: Annotated[float, Field(ge=0.0, le=1_000.0)]
    """Pictures a second that the camera gave, of the last seconds."""
    width: Annotated[int, Field(ge=0, le=8192)]
    """Of its newest picture; 0 before the first."""
    height: Annotated[int, Field(ge=0, le=8192)]
    sent: Count
    """Pictures since the process began; none is packed that nobody listens for."""
    opened: Count
    """How often the camera was opened."""


class Ros2Status(Record):
    """Say how well a ROS 2 base is heard, for people; the bridge needs none of it."""

    boot_id: Name
    seq: Count
    stamp_s: Seconds
    code: Code | None
    """What is wrong, None where nothing is; docs/ros2.md lists them."""
    detail: Text = ""
    """What came, what was expected and what cures it; empty where nothing is wrong."""
    cmd_vel: Text = ""
    """The type of what the base obeys, as the graph says; empty where nobody listens."""
    odom_hz: Annotated[float, Field(ge=0.0, le=100_000.0)]
    """Of the last seconds, as the next two."""
    relay_hz: Annotated[float, Field(ge=0.0, le=100_000.0)]
    scan_hz: Annotated[float, Field(ge=0.0, le=100_000.0)]
    sent: Count
    """Commands since the process began, as the next three."""
    unsent: Count
    """Commands that found the line full, or nobody to hear them."""
    unreadable: Count
    """Messages that were refused."""
    opened: Count
    """How often the server was reached."""


class Imu(Record):
    """Give rate of turn and acceleration in ``base``."""

    boot_id: Name
    seq: Count
    stamp_s: Seconds
    yaw_rate_radps: Radps
    accel_x_mps2: Annotated[float, Field(ge=-1_000.0, le=1_000.0)]
    accel_y_mps2: Annotated[float, Field(ge=-1_000.0, le=1_000.0)]


class ImuStatus(Record):
    """Say how well a gyro's own process reads it, for people; the bridge needs none of it."""

    boot_id: Name
    seq: Count
    stamp_s: Seconds
    model: Name
    """Kind of robot.toml."""
    code: Code | None
    """What is wrong, None where nothing is; docs/sensors.md lists them."""
    detail: Text = ""
    """What came, what was expected and what cures it; empty where nothing is wrong."""
    rate_hz: Annotated[float, Field(ge=0.0, le=1_000.0)]
    """Readings a second, of the last seconds."""
    bias_radps: Radps | None
    """What it says standing, which is taken away; None where it is not known, or the chip's own."""
    readings: Count
    """Since the process began, as the next two."""
    errors: Count
    """Transfers that failed."""
    opened: Count
    """How often the chip was set."""


class Odometry(Record):
    """Integrate the wheels: ``base`` in ``odom``, continuous within one ``odom_id``."""

    odom_id: Name
    seq: Count
    stamp_s: Seconds
    base_in_odom: Pose2
    twist: Twist2
    yaw_rate_radps: Radps | None
    """The gyro's, where there is one."""


class Localization(Record):
    """Place ``odom`` in ``map``, for one ``odom_id``."""

    odom_id: Name
    seq: Count
    stamp_s: Seconds
    odom_in_map: Pose2
    quality: Ratio
    map_id: Fingerprint


Score = Annotated[float, Field(ge=-1.0, le=1.0)]


class PoseHint(Record):
    """Tell localization where a person says the robot is. Scans judge it before it counts."""

    id: Name
    pose: Pose2
    """Of ``base`` in ``map``."""
    radius_m: Annotated[float, Field(ge=0.1, le=15.0)]
    """It is nearer to ``pose`` than this."""
    any_heading: bool = False
    """The person said where, not which way it looks."""
    outline: Annotated[tuple[tuple[Metres, Metres], ...], Field(max_length=128)] = ()
    """In ``map`` [m]: it is inside this room; empty: anywhere in the circle."""


HintCode = Literal[
    "accepted", "moving", "no_scan", "does_not_fit", "ambiguous", "busy", "no_answer"
]


class HintVerdict(Record):
    """Answer a hint."""

    id: Name
    code: HintCode
    score: Score | None
    """How well the newest scan fits where the hint led; None where none was held against it."""


class PoseCandidate(Record):
    """Hold a place where a search found that a scan fits."""

    pose: Pose2
    score: Score


LocalizerTrouble = Literal[
    "carried_while_mapping", "search_unavailable", "search_died", "search_timed_out"
]


class LocalizerStatus(Record):
    """Say what the localizer does, for people and for the planner; the bridge needs none of it."""

    boot_id: Name
    seq: Count
    stamp_s: Seconds
    state: Literal["searching", "tracking", "coasting", "lost"]
    """No pose since the start; a pose that scans confirm; newest scans do not fit; no pose now."""
    score: Score
    """Of the newest scan at the pose: the share of returns that the map explains, less the share of
    beams that pass through its walls."""
    candidates: Annotated[tuple[PoseCandidate, ...], Field(max_length=5)] = ()
    """While it searches: what the newest search found, best first."""
    hint: HintVerdict | None = None
    """On the newest hint."""
    trouble: LocalizerTrouble | None = None
    """Why it has no pose, where it knows that."""


class ImageHeader(Record):
    """Accompany picture bytes (JPEG colour, 16-bit PNG depth in millimetres) as attachment.

    Colour and depth of one instant carry the same boot, seq and stamp; depth 0 means none was
    measured. Pinhole without distortion: x right, y down from the upper left corner, the centre of
    the first pixel at (0.5, 0.5).
    """

    boot_id: Name
    seq: Count
    stamp_s: Seconds
    width: Annotated[int, Field(ge=1, le=8192)]
    height: Annotated[int, Field(ge=1, le=8192)]
    focal_px: Annotated[float, Field(gt=0.0, le=100_000.0)]
    center_x_px: Annotated[float, Field(ge=0.0, le=8192.0)]
    """Where the optical axis meets the picture."""
    center_y_px: Annotated[float, Field(ge=0.0, le=8192.0)]
