"""Bring Nav2's velocity to the bridge as an external brain's: owned, granted, never repeated. Pure.

Each twist is said at most once, with the newest status as what it has seen: silence is how Nav2
says that it has died, and the bridge's lease of 0.25 s then stops the robot. A standstill that Nav2
asks for lets the dead-man go; what moves after a pause is a mission of its own.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from wire import Grant, Heartbeat, Hello, Mode, Velocity, VelocitySequence, keys

if TYPE_CHECKING:
    from wire import Nav2State, Record, Status
    from wire.keys import Key

PERIOD_S = 0.045
"""20 Hz and its jitter: the bridge counts seven in 250 ms as a flood."""
OLD_S = 0.25
"""A twist that is older is not said: by then Nav2 would have said another, or has died."""
SILENT_S = 1.0
"""The process beside us speaks ten times a second; one that is silent for so long is not heard."""
PAUSE_S = 1.0
"""After so long without motion what comes is another goal of Nav2's."""
METRES, SECONDS = 60.0, 600.0
_STILL = 1e-4


class Nav2Velocity:
    """Hear what Nav2 says and say what an external brain says to the bridge. Told the time."""

    def __init__(self, planner_id: str, robot_hash: str) -> None:
        self._me, self._robot_hash = planner_id, robot_hash
        self._state: Nav2State | None = None
        self._heard_s = self._said_s = self._moved_s = -inf
        self._heard_twist = self._said_twist = ("", 0)
        self._missions = 0
        self._numbers = VelocitySequence()

    def hear(self, state: Nav2State, now_s: float) -> None:
        """Take the newest word of Nav2."""
        self._state, self._heard_s = state, now_s
        twist = (state.boot_id, state.twist)
        came = state.twist > 0 and twist != self._heard_twist
        self._heard_twist = twist
        if came and not _is_still(state) and now_s - self._moved_s > PAUSE_S:
            self._missions += 1
            self._moved_s = now_s

    def trouble(self, now_s: float) -> str | None:
        """Return what keeps velocities away; None while they come, or Nav2 is silent."""
        state = self._state
        if state is None or now_s - self._heard_s > SILENT_S:
            return "nav2_not_heard: the ROS 2 process says nothing of Nav2: look at logs/ros2.log"
        return None if state.code is None else f"{state.code}: {state.detail}"

    def answer(self, status: Status) -> list[tuple[Key[Record], Record]]:
        """Return what an owner says on each status."""
        said: list[tuple[Key[Record], Record]] = []
        owner = status.owner
        if owner is None or owner.planner_id != self._me:
            if owner is None and status.map_id is not None:
                said.append((_widened_key(keys.HELLO), self._hello(status, status.map_id)))
            return said
        now = {"planner_id": self._me, "epoch": status.epoch, "seen": status.seq}
        said.append((_widened_key(keys.HEARTBEAT), Heartbeat(**now, used=status.seq)))
        state = self._state
        wants = state is not None and state.twist > 0 and not _is_still(state)
        is_new = status.grant is None or status.grant.mission != self._mission()
        free = status.held is None and status.mode in (Mode.HOLD, Mode.ACTIVE)
        if wants and is_new and free:
            grant = Grant(**now, mission=self._mission(), metres=METRES, seconds=SECONDS)
            said.append((_widened_key(keys.GRANT), grant))
        return said

    def velocity(self, status: Status, now_s: float) -> Velocity | None:
        """Return the newest twist as the bridge hears it, once; None: nothing is to be said."""
        state = self._state
        owned = status.owner is not None and status.owner.planner_id == self._me
        if state is None or not owned or status.grant is None or now_s - self._said_s < PERIOD_S:
            return None
        twist, age_s = (state.boot_id, state.twist), state.twist_age_s + now_s - self._heard_s
        if not (state.twist > 0 and twist != self._said_twist and age_s <= OLD_S):
            return None
        still = _is_still(state)
        self._said_twist, self._said_s = twist, now_s
        if not still:
            self._moved_s = now_s
        return Velocity(
            source_id=self._me,
            epoch=status.epoch,
            seq=self._numbers.take_next(status.epoch),
            seen=status.seq,
            v_mps=state.v_mps,
            w_radps=state.w_radps,
            dead_man=not still,
        )

    def _mission(self) -> str:
        return f"{self._me}-{self._missions}"

    def _hello(self, status: Status, map_id: str) -> Hello:
        return Hello(
            planner_id=self._me,
            kind="external",
            seen=status.seq,
            protocol=status.protocol,
            robot_hash=self._robot_hash,
            fence_hash=status.fence_hash,
            map_id=map_id,
        )


def _is_still(state: Nav2State) -> bool:
    return abs(state.v_mps) < _STILL and abs(state.w_radps) < _STILL


def _widened_key(key: object) -> Key[Record]:
    return key  # type: ignore[return-value]  # a Key only ever produces its message
