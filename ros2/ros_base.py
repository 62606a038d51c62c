"""Join the node on a robot of ROS 2 to the wire: what it says in, messages of the wire out.

Told messages and the time; knows no socket, no clock and no thread. What it cannot stand for (a
graph that is not as the node needs it, a node that is silent or not alone, a message with holes)
gives no drive state, and without one the bridge stands.
"""

from __future__ import annotations

import logging
from collections import deque
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

from pydantic import ValidationError

from ros2.relay_watch import OLDEST_S, SILENT_S, RelayWatch
from ros2.robot_words import (
    ImuWords,
    OdometryWords,
    RelayCommand,
    RelayState,
    ScanWords,
    Unreadable,
    encode_command,
    read_words,
)
from ros2.trouble import STARTING, Ros2Trouble
from ros2.virtual_wheels import VirtualWheels
from wire import DriveState, Imu, Ros2Status, Scan

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from wire import DriveCommand, RobotDescription

log = logging.getLogger("ros2")

SCAN_SILENT_S = 1.0
SLOWEST_ODOM_HZ = 20.0
"""A state may be 80 ms old before the bridge holds (ENC_STALE)."""
YOUNG_S = 3.0
WINDOW_S = 2.0
"""Arrivals are counted over so long, and a refused message is told of."""


class TopicArrivals:
    """Hold the arrivals of one key in the last seconds, and what was wrong with it."""

    def __init__(self) -> None:
        self._at_s: deque[float] = deque(maxlen=4096)
        self._newest_s: float | None = None
        self.wrong = ""
        """Why the newest that was refused could not be used."""
        self._wrong_s = -inf

    def note(self, now_s: float) -> None:
        """Count one good message."""
        self._at_s.append(now_s)
        self._newest_s = now_s

    def refuse(self, why: str, now_s: float) -> None:
        """Remember one that could not be used."""
        self.wrong, self._wrong_s = why, now_s

    def rate_hz(self, now_s: float) -> float:
        """Return how many a second came in the last two."""
        while self._at_s and now_s - self._at_s[0] > WINDOW_S:
            self._at_s.popleft()
        return len(self._at_s) / WINDOW_S

    def silent_s(self, since_s: float, now_s: float) -> float:
        """Return for how long nothing good came, counted from ``since_s`` at the earliest."""
        newest_s = self._newest_s if self._newest_s is not None else since_s
        return now_s - max(newest_s, since_s)

    def is_refused(self, now_s: float) -> bool:
        """Return whether a message was refused in the last two seconds."""
        return now_s - self._wrong_s <= WINDOW_S


@dataclass(frozen=True, slots=True)
class LinkMessages:
    """Hold the messages of the wire that one of the robot makes; None for each other."""

    state: DriveState | None = None
    scan: Scan | None = None
    imu: Imu | None = None


NOTHING_MADE = LinkMessages()


class RosBase:
    """Hold all that is known of one ROS 2 base."""

    def __init__(self, robot: RobotDescription, boot_id: str, relay_key: bytes = b"") -> None:
        """Begin without a connection; ``relay_key`` signs the commands."""
        if robot.ros2 is None:
            raise ValueError("ros2: robot.toml is refused without it")
        self.peer = robot.ros2.node
        self._ttl_s = robot.drive.timeout_s
        self._relay_key = relay_key
        limits = robot.limits
        self._wheels = VirtualWheels(robot.base, limits.max_speed_mps, limits.max_turn_radps)
        self._boot_id, self._lives, self._life_of = boot_id, 0, ""
        self._closed: Ros2Trouble | None = Ros2Trouble(STARTING, f"{self.peer}: not reached yet")
        self._opened_s = self._odom_stamp_s = -inf
        self._relay = RelayWatch(self.peer, has_key=bool(relay_key))
        self._readers: dict[str, Callable[[bytes, float], LinkMessages]] = {
            "state": self._hear_state,
            "odom": self._hear_odometry,
        }
        if robot.lidar.kind == "ros2":
            self._readers["scan"] = self._hear_scan
        if robot.inputs.imu and not robot.imu.is_on_i2c:
            self._readers["imu"] = self._hear_imu
        self._topics = {name: TopicArrivals() for name in self._readers}
        self._seq = self._scans = self._imus = 0
        self.sent = self.unsent = self.unreadable = self.reached = 0

    @property
    def names(self) -> tuple[str, ...]:
        """Return the keys that are to be heard."""
        return tuple(self._readers)

    def open(self, now_s: float) -> None:
        """Begin anew on a connection that was just made; nothing on it is known yet."""
        self._closed, self._opened_s = None, now_s
        self._relay.forget()
        self.reached += 1

    def close(self, trouble: Ros2Trouble) -> None:
        """Note that there is no connection now, and why."""
        self._closed = trouble
        self._relay.forget()

    def hear(self, name: str, payload: bytes, now_s: float) -> LinkMessages:
        """Take a message of the robot; return what it makes for the wire."""
        if self._closed is not None:
            return NOTHING_MADE
        try:
            heard = self._readers[name](payload, now_s)
        except (Unreadable, ValidationError) as why:  # finite, and beyond what the wire carries
            self.unreadable += 1
            self._topics[name].refuse(str(why)[:200], now_s)
            return NOTHING_MADE
        self._topics[name].note(now_s)
        return heard

    def encode(self, command: DriveCommand, now_s: float) -> bytes | None:
        """Return the words of a command; None where nobody may be moved by it."""
        relay = self._relay.state
        if self._closed is not None or relay is None or self._relay.refusal(now_s) is not None:
            self.unsent += 1
            return None
        v_mps, w_radps = self._wheels.twist(command.left_radps, command.right_radps)
        words = RelayCommand(command, relay.relay, relay.t, self._ttl_s, v_mps, w_radps)
        self.sent += 1
        return encode_command(words, self._relay_key if relay.keyed else b"")

    def judge(self, now_s: float) -> Ros2Trouble | None:
        """Return what is wrong now; None where nothing is."""
        return next(self._troubles(now_s), None)

    def status(self, seq: int, now_s: float) -> Ros2Status:
        """Return what this process tells people."""
        trouble, relay = self.judge(now_s), self._relay.state
        rates = {name: round(topic.rate_hz(now_s), 1) for name, topic in self._topics.items()}
        return Ros2Status(
            boot_id=self._boot_id,
            seq=seq,
            stamp_s=now_s,
            code=trouble.code if trouble else None,
            detail=trouble.detail if trouble else "",
            cmd_vel=relay.cmd_vel if relay else "",
            odom_hz=rates["odom"],
            relay_hz=rates["state"],
            scan_hz=rates.get("scan", 0.0),
            sent=self.sent,
            unsent=self.unsent,
            unreadable=self.unreadable,
            opened=self.reached,
        )

    def _troubles(self, now_s: float) -> Iterator[Ros2Trouble]:
        """Yield all that is wrong, what must be mended first before the rest."""
        if self._closed is not None:
            yield self._closed
            return
        young = now_s - self._opened_s < YOUNG_S
        silent_s, relay = self._silent_s("state", now_s), self._relay.state
        if relay is None or silent_s > SILENT_S:
            code = STARTING if young and relay is None else "ros2_relay_silent"
            yield Ros2Trouble(code, f"{self.peer} says nothing for {silent_s:.1f} s")
        refused = self._relay.refusal(now_s)
        if refused is not None:
            yield refused
        if relay is not None and relay.wrong:
            yield Ros2Trouble("ros2_unreadable", relay.wrong)
        for name, topic in self._topics.items():
            if topic.is_refused(now_s):
                code = "ros2_clock" if " clock" in topic.wrong else "ros2_unreadable"
                yield Ros2Trouble(code, f"{name}: {topic.wrong}")
        if not young:
            yield from self._slow_topics(now_s)

    def _slow_topics(self, now_s: float) -> Iterator[Ros2Trouble]:
        for name in ("odom", "scan", "imu"):
            if name in self._topics:
                silent_s = self._silent_s(name, now_s)
                if silent_s > (SCAN_SILENT_S if name == "scan" else SILENT_S):
                    found = f"{name} says nothing for {silent_s:.1f} s"
                    yield Ros2Trouble("ros2_topic_silent", found)
        rate_hz = self._topics["odom"].rate_hz(now_s)
        if rate_hz < SLOWEST_ODOM_HZ:
            found = f"odometry came {rate_hz:.1f} times a second"
            yield Ros2Trouble("ros2_odom_slow", f"{found}, expected {SLOWEST_ODOM_HZ:g} or more")

    def _silent_s(self, name: str, now_s: float) -> float:
        return self._topics[name].silent_s(self._opened_s, now_s)

    def _hear_state(self, payload: bytes, now_s: float) -> LinkMessages:
        self._relay.hear(read_words(RelayState, payload), now_s)
        return NOTHING_MADE

    def _hear_odometry(self, payload: bytes, now_s: float) -> LinkMessages:
        pose = read_words(OdometryWords, payload)
        relay = self._relay.state
        if relay is None:
            return NOTHING_MADE
        stamp_s = self._relay.clock.date(pose.stamp_s, now_s)
        if 0.0 <= self._odom_stamp_s - pose.stamp_s <= OLDEST_S:
            return NOTHING_MADE  # overtaken on its way
        self._odom_stamp_s = pose.stamp_s
        boot_id = self._live(pose, relay.relay)
        self._seq += 1
        wheels = self._wheels.turn(pose)
        silent = self._silent_s("state", now_s) > SILENT_S
        if silent or self._relay.refusal(now_s) is not None:
            return NOTHING_MADE
        return LinkMessages(
            state=DriveState(
                boot_id=boot_id,
                seq=self._seq,
                stamp_s=stamp_s,
                echo_boot=relay.echo_boot,
                echo_seq=relay.echo_seq,
                enabled=relay.on and not relay.timed_out,
                timed_out=relay.timed_out,
                left_rad=wheels.left_rad,
                right_rad=wheels.right_rad,
                left_radps=wheels.left_radps,
                right_radps=wheels.right_radps,
                battery=pose.battery,
                estop_pressed=pose.estop,
                bumper_front=pose.bumper_front,
                bumper_rear=pose.bumper_rear,
                cliff=pose.cliff,
            )
        )

    def _live(self, pose: OdometryWords, relay: str) -> str:
        """Return the drive's boot id; another where node or odometry began anew."""
        jumped = self._wheels.jumps(pose)
        if jumped or self._lives == 0 or relay != self._life_of:
            if jumped:
                log.warning("odometry jumped: the base counts anew")
            self._wheels.forget()
            self._lives += 1
            self._life_of = relay
        return f"{self._boot_id}-{self._lives}"

    def _hear_scan(self, payload: bytes, now_s: float) -> LinkMessages:
        said = read_words(ScanWords, payload)
        if self._relay.state is None:
            return NOTHING_MADE
        self._scans += 1
        words = said.model_dump(exclude={"stamp_s", "frame"})
        stamp_s = self._relay.clock.date(said.stamp_s, now_s)
        return LinkMessages(
            scan=Scan(boot_id=self._boot_id, seq=self._scans, stamp_s=stamp_s, **words)
        )

    def _hear_imu(self, payload: bytes, now_s: float) -> LinkMessages:
        said = read_words(ImuWords, payload)
        if self._relay.state is None:
            return NOTHING_MADE
        self._imus += 1
        words = said.model_dump(exclude={"stamp_s"})
        stamp_s = self._relay.clock.date(said.stamp_s, now_s)
        return LinkMessages(
            imu=Imu(boot_id=self._boot_id, seq=self._imus, stamp_s=stamp_s, **words)
        )
