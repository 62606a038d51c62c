"""Define the key table: senders, receivers, rate, size and buffer of every key."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Generic, TypeVar

from wire.base import Record
from wire.commands import (
    EstopLink,
    FenceRequest,
    Grant,
    Heartbeat,
    Hello,
    MarksRequest,
    OpRequest,
    Stop,
    Velocity,
    Waypoints,
)
from wire.nav2_dialogue import Nav2Goal, Nav2State, PlanView
from wire.sensors import (
    CameraStatus,
    DriveCommand,
    DriveState,
    ImageHeader,
    Imu,
    ImuStatus,
    LidarStatus,
    Localization,
    LocalizerStatus,
    Odometry,
    PoseHint,
    Ros2Status,
    Scan,
)
from wire.simulation import SimControl, SimScene, SimTruth
from wire.status import Event, Status
from wire.trial_dialogue import TrialOrder, TrialState

LATEST = 1
"""Ring size for state: only the newest counts."""
SEQUENCED = 64
"""Ring size for what is numbered or must each be answered."""
FEW = 4
"""Ring size for what is long, rare and repeated."""

SMALL = 4_096
MEDIUM = 32_768
IMAGE = 4_194_304


class Party(StrEnum):
    """Name the processes of the key table."""

    PLANNER = "planner"
    BRIDGE = "bridge"
    LOCALIZATION = "localization"
    ROBOT = "robot"
    CAMERA = "camera"
    BUTTON = "button"
    OPERATOR = "operator"
    JUDGE = "judge"
    LIDAR = "lidar"
    ROS2 = "ros2"
    IMU = "imu"


M = TypeVar("M", bound=Record)

ANY_ROBOT = "*"
"""In a robot's place in a key: whichever robot speaks there. No robot's id may be this."""


@dataclass(frozen=True, slots=True)
class Key(Generic[M]):
    """Describe one key expression below ``pons/<robot>/``."""

    path: str
    message: type[M]
    senders: frozenset[Party]
    receivers: frozenset[Party]
    rate: str
    ring: int
    max_bytes: int
    purpose: str

    def expression(self, robot_id: str) -> str:
        """Return the full key expression for one robot."""
        return f"pons/{robot_id}/{self.path}"


_P, _B, _L, _R, _C, _S, _O, _J, _LI, _RO, _IM = Party  # short, for the table below
_WHO_ASKS = frozenset({_P, _O, _J})
"""Receivers of the bridge's status and events."""


def _op(kind: str, purpose: str) -> Key[OpRequest]:
    senders = frozenset({_O, _P})
    rate = "20 Hz until echoed or 2 s"
    return Key(f"op/{kind}", OpRequest, senders, frozenset({_B}), rate, SEQUENCED, SMALL, purpose)


def _from(
    sender: Party,
    path: str,
    message: type[M],
    receivers: frozenset[Party],
    rate: str,
    purpose: str,
    *,
    ring: int = LATEST,
    max_bytes: int = SMALL,
) -> Key[M]:
    others = receivers - {sender}
    return Key(path, message, frozenset({sender}), others, rate, ring, max_bytes, purpose)


_TO_B = frozenset({_B})

HELLO = _from(_P, "cmd/hello", Hello, _TO_B, "on each status until answered",
              "ask to own the robot", ring=SEQUENCED)  # fmt: skip
GRANT = _from(_P, "cmd/grant", Grant, _TO_B, "on each status until answered",
              "allow one mission so many metres and seconds", ring=SEQUENCED)  # fmt: skip
WAYPOINTS = _from(_P, "cmd/waypoints", Waypoints, _TO_B, "10 Hz while moving",
                  "rolling horizon of one leg", ring=SEQUENCED, max_bytes=MEDIUM)  # fmt: skip
HEARTBEAT = _from(_P, "cmd/heartbeat", Heartbeat, _TO_B, "on each status",
                  "the owner lives and thinks", ring=SEQUENCED)  # fmt: skip
STOP = Key("cmd/stop", Stop, frozenset(Party) - {_B, _C}, _TO_B, "20 Hz until echoed or 2 s",
           SEQUENCED, SMALL, "stop now and hold; never refused")  # fmt: skip
TELEOP = Key("cmd/teleop", Velocity, frozenset({_P, _O}), _TO_B, "20 Hz while held", SEQUENCED,
             SMALL, "steer by hand")  # fmt: skip
EXTERNAL = Key("cmd/external", Velocity, frozenset({_P}), _TO_B, "20 Hz while held", SEQUENCED,
               SMALL, "another brain steers by velocity")  # fmt: skip

ARM = _op("arm", "power the drive, standing")
DISARM = _op("disarm", "ramp to zero, then torque off")
ESTOP = _op("estop", "protective stop, latched until reset")
RESET = _op("reset", "leave a latched state; never moves the robot")
RESUME = _op("resume", "clear held; an operator act")
FENCE = Key("op/fence", FenceRequest, frozenset({_O, _P}), frozenset({_B}),
            "20 Hz until echoed or 2 s", FEW, MEDIUM,
            "put another fence in force; only while DISARMED")  # fmt: skip
MARKS = Key("op/marks", MarksRequest, frozenset({_O, _P}), frozenset({_B}),
            "20 Hz until echoed or 2 s", FEW, MEDIUM,
            "put other marks of the map in force; they only take away from the fence")  # fmt: skip
ESTOP_LINK = _from(_S, "op/estop_link", EstopLink, _TO_B, "10 Hz where configured",
                   "a wired stop button's state")  # fmt: skip

STATUS = _from(_B, "bridge/status", Status, _WHO_ASKS, "20 Hz and on change, at most 40/s",
               "the only word on what really happened", max_bytes=MEDIUM)  # fmt: skip
EVENT = _from(_B, "bridge/event", Event, _WHO_ASKS, "on each event",
              "transitions and refusals, for people", ring=SEQUENCED)  # fmt: skip
ODOM = _from(_B, "bridge/odom", Odometry, _WHO_ASKS | {_L}, "50 Hz", "base in odom",
             ring=SEQUENCED)  # fmt: skip
LOC_STATE = _from(_L, "loc/state", LocalizerStatus, frozenset({_P, _J}), "5 Hz and on change",
                  "what the localizer does, and its word on a hint")  # fmt: skip
LOC_HINT = _from(_P, "loc/hint", PoseHint, frozenset({_L}), "20 Hz until answered or 6 s",
                 "a person says where the robot is", ring=FEW)  # fmt: skip
LOCALIZATION = _from(_L, "localization", Localization, frozenset({_B, _P, _J}), "10 Hz or more",
                     "odom in map")  # fmt: skip
DRIVE_COMMAND = _from(_B, "drive/command", DriveCommand, frozenset({_R, _RO, _J}), "100 Hz",
                      "wheel speeds, one per tick")  # fmt: skip
_WHO_DRIVES = frozenset({_R, _RO})
DRIVE_STATE = Key("drive/state", DriveState, _WHO_DRIVES, frozenset({_B, _J}),
                  "100 Hz; over ROS 2 as odometry comes", SEQUENCED, SMALL,
                  "what the drive does")  # fmt: skip
_HEARERS = frozenset({_B, _P, _L, _J})
SCAN = Key("scan", Scan, frozenset({_R, _LI, _RO}), _HEARERS,
           "10 Hz; more of a lidar that turns slowly", LATEST, MEDIUM,
           "planar lidar, of the simulator or of a real one's process")  # fmt: skip
LIDAR_STATE = _from(_LI, "lidar/state", LidarStatus, frozenset({_P, _J}), "2 Hz and on change",
                    "how well a real lidar is read")  # fmt: skip
IMU = Key("imu", Imu, _WHO_DRIVES | {_IM}, _HEARERS, "100 Hz", LATEST, SMALL,
          "rate of turn, acceleration")  # fmt: skip
IMU_STATE = _from(_IM, "imu/state", ImuStatus, frozenset({_P, _J}), "2 Hz and on change",
                  "how well a gyro on an I2C bus is read")  # fmt: skip
ROS2_STATE = _from(_RO, "ros2/state", Ros2Status, frozenset({_P, _J}), "2 Hz and on change",
                   "how well a ROS 2 base is heard")  # fmt: skip
NAV2_GOAL = _from(_P, "nav2/goal", Nav2Goal, frozenset({_RO}), "on each status where Nav2 drives",
                  "where Nav2 is to bring the robot; moves nothing by itself")  # fmt: skip
NAV2_STATE = _from(_RO, "nav2/state", Nav2State, frozenset({_P, _J}), "10 Hz and on each twist",
                   "what became of Nav2's goal, and its newest twist")  # fmt: skip
PLAN_VIEW = _from(_P, "plan/view", PlanView, frozenset({_RO}), "2 Hz where a base is of ROS 2",
                  "way and places, for RViz to show; moves nothing", max_bytes=MEDIUM)  # fmt: skip
CAMERA_COLOR = _from(_C, "camera/color", ImageHeader, frozenset({_P, _J}), "10 Hz",
                     "JPEG, header attached", max_bytes=IMAGE)  # fmt: skip
CAMERA_DEPTH = _from(_C, "camera/depth", ImageHeader, frozenset({_P, _J}), "10 Hz",
                     "16-bit PNG in millimetres, header attached", max_bytes=IMAGE)  # fmt: skip
CAMERA_STATE = _from(_C, "camera/state", CameraStatus, frozenset({_P, _J}), "2 Hz and on change",
                     "what a real camera gives")  # fmt: skip
SIM_TRUTH = _from(_R, "sim/truth", SimTruth, frozenset({_L, _J}), "50 Hz",
                  "where the simulated robot really is", ring=SEQUENCED)  # fmt: skip
SIM_SCENE = _from(_R, "sim/scene", SimScene, frozenset({_C, _J}), "25 Hz where a camera is",
                  "what the simulated camera is to draw", max_bytes=MEDIUM)  # fmt: skip
SIM_CONTROL = Key("sim/control", SimControl, frozenset({_J}), frozenset({_R}), "by tests",
                  SEQUENCED, SMALL,
                  "a test moves the simulated robot or a thing of its home")  # fmt: skip

TRIAL_ORDER = _from(_P, "trial/order", TrialOrder, _TO_B, "3 Hz while a page watches a trial",
                    "a person at the page tries the robot; heard while no bridge drives",
                    ring=SEQUENCED)  # fmt: skip
TRIAL_STATE = _from(_B, "trial/state", TrialState, frozenset({_P, _J}), "10 Hz in set-up",
                    "what the trial asks, saw and found", max_bytes=MEDIUM)  # fmt: skip

OPS = (ARM, DISARM, ESTOP, RESET, RESUME)
COMMANDS = (HELLO, GRANT, WAYPOINTS, HEARTBEAT, STOP, TELEOP, EXTERNAL)
KEYS: tuple[Key[Record], ...] = (  # type: ignore[assignment]  # a Key only ever produces its M
    *COMMANDS, *OPS, FENCE, MARKS, ESTOP_LINK, STATUS, EVENT, ODOM, LOCALIZATION, LOC_STATE,
    LOC_HINT, DRIVE_COMMAND, DRIVE_STATE, SCAN, LIDAR_STATE, IMU, IMU_STATE, ROS2_STATE,
    NAV2_GOAL, NAV2_STATE, PLAN_VIEW,
    CAMERA_COLOR, CAMERA_DEPTH, CAMERA_STATE, SIM_TRUTH, SIM_SCENE, SIM_CONTROL, TRIAL_ORDER,
    TRIAL_STATE,
)  # fmt: skip
