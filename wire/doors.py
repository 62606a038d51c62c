"""List every door: a socket at which one process listens, and the keys that pass there each way.

Each door is a zenoh session of its own in its listener and in each process that dials it, and no
session relays to another. Who reaches a door can therefore say what that door hears and nothing
else, to its listener and nobody else. Doors where the planner or an operator may knock never hear
what the bridge drives by; doors that others only look through hear nothing at all.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from wire import keys
from wire.keys import Party

if TYPE_CHECKING:
    from wire.base import Record
    from wire.keys import Key

    Keys = tuple[Key[Record], ...]


@dataclass(frozen=True, slots=True, eq=False)
class Door:
    """Describe one listening socket: ``$PONS_HOME/run/<name>/<name>.sock``."""

    name: str
    listener: Party
    dialled_by: tuple[Party, ...]
    hears: Keys
    """What the listener takes from those who dial."""
    says: Keys
    """What the listener gives to those who dial."""
    purpose: str

    def inward(self, party: Party, path: str) -> bool:
        """Return whether a party that listens or dials here receives a key here."""
        said = self.hears if party is self.listener else self.says
        return any(key.path == path for key in said)

    def outward(self, party: Party, path: str) -> bool:
        """Return whether a party that listens or dials here may send a key here."""
        said = self.says if party is self.listener else self.hears
        return any(key.path == path for key in said)


def _keys(*some: Any) -> Keys:
    return some


BRIDGE_DOOR = Door(
    "bridge", Party.BRIDGE, (Party.PLANNER, Party.OPERATOR, Party.JUDGE),
    _keys(*keys.COMMANDS, *keys.OPS, keys.FENCE, keys.MARKS, keys.TRIAL_ORDER),
    _keys(keys.STATUS, keys.EVENT, keys.ODOM, keys.DRIVE_COMMAND, keys.TRIAL_STATE),
    "orders: planner and operators ask here; of what the bridge drives by it hears nothing",
)  # fmt: skip
SENSES_DOOR = Door(
    "senses", Party.BRIDGE, (Party.LOCALIZATION, Party.BUTTON),
    _keys(keys.LOCALIZATION, keys.ESTOP_LINK, keys.STOP),
    _keys(keys.ODOM),
    "where the robot is, and a wired stop button",
)  # fmt: skip
DRIVE_DOOR = Door(
    "drive", Party.ROBOT, (Party.BRIDGE,),
    _keys(keys.DRIVE_COMMAND),
    _keys(keys.DRIVE_STATE, keys.SCAN, keys.IMU, keys.STOP),
    "wheels and sensors, for the bridge alone",
)  # fmt: skip
ROBOT_DOOR = Door(
    "robot", Party.ROBOT, (Party.PLANNER, Party.LOCALIZATION, Party.CAMERA, Party.JUDGE),
    (),
    _keys(keys.DRIVE_STATE, keys.SCAN, keys.IMU, keys.SIM_TRUTH, keys.SIM_SCENE),
    "a copy of what the robot says; it hears nothing",
)  # fmt: skip
LIDAR_DOOR = Door(
    "lidar", Party.LIDAR, (Party.BRIDGE,),
    (),
    _keys(keys.SCAN, keys.STOP),
    "a real lidar's scans, for the bridge alone",
)  # fmt: skip
SCANS_DOOR = Door(
    "scans", Party.LIDAR, (Party.PLANNER, Party.LOCALIZATION, Party.JUDGE),
    (),
    _keys(keys.SCAN, keys.LIDAR_STATE),
    "a copy of what a real lidar says; it hears nothing",
)  # fmt: skip
IMU_DOOR = Door(
    "imu", Party.IMU, (Party.BRIDGE,),
    (),
    _keys(keys.IMU, keys.STOP),
    "a gyro of its own, for the bridge alone",
)  # fmt: skip
IMU_COPY_DOOR = Door(
    "imu_copy", Party.IMU, (Party.PLANNER, Party.LOCALIZATION, Party.JUDGE),
    (),
    _keys(keys.IMU, keys.IMU_STATE),
    "a copy of what a gyro of its own says; it hears nothing",
)  # fmt: skip
ROS2_DOOR = Door(
    "ros2", Party.ROS2, (Party.BRIDGE,),
    _keys(keys.DRIVE_COMMAND),
    _keys(keys.DRIVE_STATE, keys.SCAN, keys.IMU, keys.STOP),
    "wheels and sensors of a ROS 2 base, for the bridge alone",
)  # fmt: skip
ROS2_COPY_DOOR = Door(
    "ros2_copy", Party.ROS2, (Party.PLANNER, Party.LOCALIZATION, Party.JUDGE),
    (),
    _keys(keys.DRIVE_STATE, keys.SCAN, keys.IMU, keys.ROS2_STATE),
    "a copy of what a ROS 2 base says; it hears nothing",
)  # fmt: skip
NAV2_DOOR = Door(
    "nav2", Party.ROS2, (Party.PLANNER, Party.JUDGE),
    _keys(keys.NAV2_GOAL, keys.PLAN_VIEW),
    _keys(keys.NAV2_STATE),
    "where Nav2 is to go, and its twists, which move nothing unless the planner asks the bridge; "
    "what RViz may show",
)  # fmt: skip
SIM_DOOR = Door(
    "sim", Party.ROBOT, (Party.JUDGE,),
    _keys(keys.SIM_CONTROL),
    (),
    "tests move and break the simulated robot",
)  # fmt: skip
LOCALIZATION_DOOR = Door(
    "localization", Party.LOCALIZATION, (Party.PLANNER, Party.JUDGE),
    (),
    _keys(keys.LOCALIZATION, keys.LOC_STATE),
    "a copy of what localization says; it hears nothing",
)  # fmt: skip
HINT_DOOR = Door(
    "hint", Party.LOCALIZATION, (Party.PLANNER,),
    _keys(keys.LOC_HINT),
    (),
    "where a person says the robot is, which scans judge; it moves nothing by itself",
)  # fmt: skip
CAMERA_DOOR = Door(
    "camera", Party.CAMERA, (Party.PLANNER, Party.JUDGE),
    (),
    _keys(keys.CAMERA_COLOR, keys.CAMERA_DEPTH, keys.CAMERA_STATE),
    "pictures; it hears nothing",
)  # fmt: skip

DOORS = (
    DRIVE_DOOR, ROS2_DOOR, BRIDGE_DOOR, SENSES_DOOR, LIDAR_DOOR, IMU_DOOR, ROBOT_DOOR,
    ROS2_COPY_DOOR, SCANS_DOOR, IMU_COPY_DOOR, SIM_DOOR, LOCALIZATION_DOOR, HINT_DOOR, CAMERA_DOOR,
    NAV2_DOOR,
)  # fmt: skip
"""In the order in which a message that passes several is said: the wheels first."""


def doors_of(party: Party) -> tuple[Door, ...]:
    """Return the doors at which a party listens or which it dials."""
    return tuple(door for door in DOORS if party is door.listener or party in door.dialled_by)


def access_control(hears: Keys, says: Keys) -> dict[str, object]:
    """Return zenoh's access control: messages of these keys each way, nothing else of any kind.

    A peer relays between the clients that dial it; what may not leave by ``says`` is not relayed.
    """
    rules = [
        {
            "id": f"{flow}_{message}",
            "permission": "allow",
            "flows": [flow],
            "messages": [message],
            "key_exprs": [key.expression(keys.ANY_ROBOT) for key in some],
        }
        for flow, message, some in (
            ("ingress", "put", hears),
            ("egress", "declare_subscriber", hears),
            ("egress", "put", says),
            ("ingress", "declare_subscriber", says),
        )
        if some
    ]
    return {
        "enabled": True,
        "default_permission": "deny",
        "rules": rules,
        "subjects": [{"id": "anybody"}],
        "policies": [{"rules": [rule["id"] for rule in rules], "subjects": ["anybody"]}],
    }
