"""Define what the package pons_ros2 says on a robot of ROS 2, and how it is commanded. Pure.

JSON by pydantic, strict and bounded as all of Pons' wire: who speaks may be a stranger.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, TypeVar

from pydantic import ConfigDict, Field, TypeAdapter, ValidationError

from ros2.pons_ros2.pons_ros2.dead_man import sign
from wire.base import Record
from wire.bounded_types import MAX_BEAMS, Code, Count, Name, Ratio, Seconds, Text

if TYPE_CHECKING:
    from wire import DriveCommand

RosSeconds = Annotated[float, Field(ge=-1e12, le=1e12)]
"""On the robot's ROS clock."""
Frame = Annotated[str, Field(max_length=64)]
Unit = Annotated[float, Field(ge=-1.1, le=1.1)]
Metres = Annotated[float, Field(ge=-1e6, le=1e6)]
Range = Annotated[float, Field(ge=0.0, le=1000.0)]
Angle = Annotated[float, Field(ge=-7.0, le=7.0)]
Rate = Annotated[float, Field(ge=-1e6, le=1e6)]
Accel = Annotated[float, Field(ge=-1e3, le=1e3)]


class Unreadable(Exception):
    """A message that cannot be used; says what it holds."""


class RobotRecord(Record):
    """Ignore what a newer package says more."""

    model_config = ConfigDict(extra="ignore", frozen=True, allow_inf_nan=False)


class RelayState(RobotRecord):
    """Say which command the robot obeys, and what its graph lacks."""

    relay: Name
    """Which run of the node this is."""
    seq: Count
    t: Seconds
    """On the node's monotonic clock."""
    ros: RosSeconds
    """The same instant on the robot's ROS clock."""
    echo_boot: Name | None
    echo_seq: Count
    timed_out: bool
    on: bool
    """Whether the obeyed command asked for torque."""
    cmd_vel: Text
    """The type that it publishes; empty while nobody listens there."""
    others: Count
    """Who else publishes there: any at all is one too many."""
    keyed: bool = False
    """It obeys only commands signed with the key that it shares with Pons."""
    code: Code | None = None
    """Why the node does not drive this graph."""
    found: Text = ""
    wrong: Text = ""
    """Which message could not be read lately, and why."""


class OdometryWords(RobotRecord):
    """Give one pose of the base in its odometry frame, its twist and its inputs."""

    stamp_s: RosSeconds
    x_m: Metres
    y_m: Metres
    yaw_rad: Angle
    v_mps: Rate
    w_radps: Rate
    battery: Ratio | None = None
    estop: bool | None
    bumper_front: bool | None
    bumper_rear: bool | None
    cliff: bool | None


class ScanWords(RobotRecord):
    """Give one planar scan, counter-clockwise; a beam is null where nothing came back."""

    stamp_s: RosSeconds
    frame: Frame = ""
    angle_min_rad: Angle
    angle_increment_rad: Annotated[float, Field(gt=0.0, le=7.0)]
    time_increment_s: Annotated[float, Field(ge=0.0, le=0.01)]
    range_min_m: Range
    range_max_m: Range
    ranges_m: Annotated[tuple[Range | None, ...], Field(min_length=1, max_length=MAX_BEAMS)]
    clockwise: bool


class ImuWords(RobotRecord):
    """Give the rate of turn and the acceleration."""

    stamp_s: RosSeconds
    yaw_rate_radps: Annotated[float, Field(ge=-100.0, le=100.0)]
    accel_x_mps2: Accel
    accel_y_mps2: Accel


class FrameWords(RobotRecord):
    """Give where one frame sits in another, as /tf_static says it."""

    parent: Frame
    child: Frame
    at_m: tuple[Metres, Metres, Metres]
    turned: tuple[Unit, Unit, Unit, Unit]
    """A quaternion: x, y, z, w."""


class BytesHead(RobotRecord):
    """Say what bytes are, or by which code there are none."""

    code: Code | None = None
    found: Text = ""


class PictureHead(BytesHead):
    """Say what a picture's bytes are."""

    kind: Annotated[str, Field(pattern=r"^(packed|raw)$")] = "packed"
    format: Annotated[str, Field(max_length=80)] = ""
    """Of packed bytes as image_transport says it; of raw ones sensor_msgs/Image's encoding."""
    width: Annotated[int, Field(ge=0, le=8192)] = 0
    height: Annotated[int, Field(ge=0, le=8192)] = 0
    stamp_s: RosSeconds | None = None


class MapHead(BytesHead):
    """Say how a map's cells lie; they are percentages, from the lowest y on, 255 is unknown."""

    topic: Text
    resolution_m: Annotated[float, Field(gt=0.0, le=10.0)] = 1.0
    width: Annotated[int, Field(ge=0, le=1 << 20)] = 0
    height: Annotated[int, Field(ge=0, le=1 << 20)] = 0
    x_m: Metres = 0.0
    y_m: Metres = 0.0
    yaw_rad: Angle = 0.0


M = TypeVar("M", bound=RobotRecord)
FRAMES = TypeAdapter(Annotated[tuple[FrameWords, ...], Field(max_length=1024)])


def read_frames(payload: bytes) -> tuple[FrameWords, ...]:
    """Return the frames that a robot's node says.

    Raises:
        Unreadable: they are none.
    """
    try:
        return FRAMES.validate_json(payload, strict=True)
    except (ValidationError, RecursionError) as error:
        raise Unreadable(_shorten(error)) from None


def read_words(kind: type[M], payload: bytes) -> M:
    """Return a message of the robot.

    Raises:
        Unreadable: it is none.
    """
    try:
        return kind.model_validate_json(payload, strict=True)
    except (ValidationError, RecursionError) as error:
        raise Unreadable(_shorten(error)) from None


def _shorten(error: Exception) -> str:
    return " ".join(str(error).splitlines()[:3])[:160]


@dataclass(frozen=True, slots=True)
class RelayCommand:
    """Hold what one command carries."""

    command: DriveCommand
    relay: str
    seen_s: float
    ttl_s: float
    v_mps: float
    w_radps: float


def encode_command(command: RelayCommand, key: bytes = b"") -> bytes:
    """Return a command as it is sent.

    The words bind the node's run, its clock and a number, so that none counts a second time.
    """
    on = command.command.enable
    words = {
        "boot": command.command.boot,
        "seq": command.command.seq,
        "relay": command.relay,
        "seen": command.seen_s,
        "ttl": command.ttl_s,
        "on": on,
        "v": command.v_mps if on else 0.0,
        "w": command.w_radps if on else 0.0,
    }
    return sign(json.dumps(words, separators=(",", ":"), allow_nan=False), key).encode()
