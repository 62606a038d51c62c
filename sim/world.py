"""Simulate floor, walls, furniture and a differential robot in MuJoCo.

The only file that calls MuJoCo. Knows metres, radians and newtons; no messages, no noise, no clock
beyond the step. Frame: ``map`` is the world frame.
"""

from __future__ import annotations

import logging
from copy import copy
from math import atan2
from typing import TYPE_CHECKING, Any, Self

import mujoco
import numpy as np
from numpy.typing import NDArray

from sim.mjcf import OBSTACLES, PARKED_Z_M, SETTLE_STEPS, quaternion, world_mjcf
from wire import ConfigError, Pose2, Twist2
from wire.geometry import MAX_SPEED_MPS, MAX_TURN_RADPS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from sim.hardware import Hardware
    from sim.site import Solid
    from sim.site.objects import Upright
    from wire.robot import Base

log = logging.getLogger("sim")
# MuJoCo would write its warnings to a file in the working directory.
mujoco.set_mju_user_warning(lambda text: log.error("physics: %s", text))

_JAMMED_NM = 200.0
_ICE = 0.02  # Coulomb friction: 0.2 m/s2 at most
_SEEN_BY_LIDAR = np.array([1, 0, 0, 0, 0, 0], dtype=np.uint8)  # geom groups, see sim.mjcf


class PhysicsWorld:
    """Hold one MuJoCo model and its state."""

    def __init__(
        self,
        solids: Iterable[Solid],
        base: Base,
        hardware: Hardware,
        step_s: float,
        uprights: Iterable[Upright] = (),
    ) -> None:
        standing = list(uprights)
        self.carried = (*OBSTACLES, *(thing.id for thing in standing))
        """What may be moved about, by name."""
        xml = world_mjcf(solids, base, hardware, step_s, standing)
        # mujoco-core carries no type information: Any ends at this class.
        self._model: Any = mujoco.MjModel.from_xml_string(xml)
        self._data: Any = mujoco.MjData(self._model)
        self._chassis: int = self._model.geom("chassis").id
        self._base: int = int(self._model.geom_bodyid[self._chassis])
        self._wheels = [self._model.joint(f"wheel_{side}").id for side in ("left", "right")]
        self._angle_at = [int(self._model.jnt_qposadr[joint]) for joint in self._wheels]
        self._height_m = hardware.lidar_height_m
        mujoco.mj_forward(self._model, self._data)  # places the solids: rays work from the start
        grips = ("floor", "wheel_left", "wheel_right")
        self._grips = [self._model.geom(name).id for name in grips]
        self._left_dof = int(self._model.jnt_dofadr[self._wheels[0]])
        self._look()

    def _look(self) -> None:
        """Take views into MuJoCo's memory: reading them costs no call."""
        self._qpos: NDArray[np.float64] = self._data.qpos
        self._qvel: NDArray[np.float64] = self._data.qvel
        self._ctrl: NDArray[np.float64] = self._data.ctrl
        self._act: NDArray[np.float64] = self._data.act
        self._touching: Any = self._data.contact

    def __deepcopy__(self, _memo: dict[int, Any]) -> Self:
        """Return a world that goes on from here by itself."""
        other = copy(self)
        vars(other).update(_model=copy(self._model), _data=copy(self._data))
        other._look()  # noqa: SLF001  # one of us
        return other

    def step(self, left_radps: float, right_radps: float, *, braked: bool, steps: int) -> None:
        """Advance by whole physics steps under one wish for the wheels; braked ignores the wish."""
        self._ctrl[0] = 0.0 if braked else left_radps
        self._ctrl[1] = 0.0 if braked else right_radps
        if braked:
            self._act[:] = 0.0  # a brake grips without the motor's lag
        mujoco.mj_step(self._model, self._data, steps)

    def pose(self) -> Pose2:
        """Return the robot's pose in ``map``."""
        x_m, y_m, _, w, x, y, z = self._qpos[:7].tolist()
        return Pose2(x_m, y_m, atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)))

    def twist(self) -> Twist2:
        """Return the robot's forward speed and rate of turn, within what the wire can carry."""
        w, x, y, z = self._qpos[3:7].tolist()
        vx, vy, _, _, _, turn_radps = self._qvel[:6].tolist()
        # The first two elements of the rotation's first column: cos and sin of the heading.
        forward_mps = vx * (1.0 - 2.0 * (y * y + z * z)) + vy * 2.0 * (w * z + x * y)
        return Twist2(
            max(-MAX_SPEED_MPS, min(MAX_SPEED_MPS, forward_mps)),
            max(-MAX_TURN_RADPS, min(MAX_TURN_RADPS, turn_radps)),
        )

    def wheel_angles(self) -> tuple[float, float]:
        """Return how far the left and right wheel have turned [rad]."""
        left, right = self._angle_at
        return float(self._qpos[left]), float(self._qpos[right])

    def contacts(self) -> int:
        """Count the robot's contacts with anything but the floor, now."""
        pairs: list[list[int]] = self._touching.geom.tolist()  # two or three: no arithmetic
        return sum([self._chassis in pair for pair in pairs])

    def place_robot(self, pose: Pose2) -> None:
        """Put the robot down at rest. Wheels keep their angles, as when it is carried.

        Inside of a solid it is pushed out while it settles, which spins its wheels; encoders must
        not be told of half a second that passes within no time.
        """
        angles = self._qpos[self._angle_at]
        self._qpos[0:3] = (pose.x_m, pose.y_m, 0.0)
        self._qpos[3:7] = quaternion(pose.yaw_rad)
        self._rest()
        self.step(0.0, 0.0, braked=True, steps=SETTLE_STEPS)
        self._qpos[self._angle_at] = angles
        self._rest()

    def _rest(self) -> None:
        self._qvel[:] = 0.0
        self._act[:] = 0.0

    def block_left_wheel(self, *, blocked: bool) -> None:
        """Jam the left wheel, or let it go: friction in its bearing that no motor overcomes."""
        self._model.dof_frictionloss[self._left_dof] = _JAMMED_NM if blocked else 0.0

    def make_slippery(self, *, left: bool, right: bool) -> None:
        """Put each wheel on ice, or back on the floor. Of two materials the rougher one counts."""
        slips = (left or right, left, right)
        self._model.geom_friction[self._grips, 0] = [_ICE if slip else 1.0 for slip in slips]

    def push(self, force_n: tuple[float, float]) -> None:
        """Lean on the robot from now on, x and y in ``map`` [N]; zero lets it be."""
        self._data.xfrc_applied[self._base, :2] = force_n

    def place_obstacle(self, name: str, x_m: float, y_m: float, yaw_rad: float) -> None:
        """Stand a movable obstacle on the floor."""
        self._move(name, (x_m, y_m, 0.0), yaw_rad)

    def remove_obstacle(self, name: str) -> None:
        """Park a movable obstacle below the floor."""
        self._move(name, (0.0, 0.0, PARKED_Z_M), 0.0)

    def _move(self, name: str, at: tuple[float, float, float], yaw_rad: float) -> None:
        if name not in self.carried:
            known = ", ".join(self.carried)
            raise ConfigError("obstacle_unknown", f"no obstacle {name!r}; there are: {known}")
        slot = int(self._model.body(name).mocapid[0])
        self._data.mocap_pos[slot] = at
        self._data.mocap_quat[slot] = quaternion(yaw_rad)
        mujoco.mj_kinematics(self._model, self._data)  # rays see it before the next step

    def rays(
        self,
        origin: tuple[float, float],
        directions: NDArray[np.float64],
        cutoff_m: float,
        patches: NDArray[np.float64] | None = None,
    ) -> NDArray[np.float64]:
        """Cast horizontal rays at lidar height; -1 where nothing lies within the cutoff.

        Args:
            origin: x and y in ``map`` [m].
            directions: unit vectors in ``map``, shape (n, 3).
            cutoff_m: longest distance of interest [m].
            patches: discs (x, y, radius) of walls and furniture that return nothing, shape (n, 3).
        """
        count = len(directions)
        found = np.empty(count)
        hit = np.empty(count, dtype=np.int32)
        start = np.array([origin[0], origin[1], self._height_m])
        mujoco.mj_multiRay(
            self._model, self._data, start, directions.reshape(-1),
            _SEEN_BY_LIDAR, True, -1, hit, found, None, count, cutoff_m,
        )  # fmt: skip
        if patches is not None:
            points = start[:2] + directions[:, :2] * found[:, np.newaxis]
            away_m = np.linalg.norm(points[:, np.newaxis] - patches[:, :2], axis=2)
            still = self._model.geom_bodyid[hit] == 0  # people and leaves always return
            found[still & (away_m < patches[:, 2]).any(axis=1)] = -1.0
        return found
