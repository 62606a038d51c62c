"""Join a transport to the wire: what ROS says in, messages of the wire out, and back.

Told messages and the time; knows no socket, no clock and no thread. What it cannot stand for (a
graph that is not as robot.toml says, a relay that is silent or not alone, a message with holes)
gives no drive state, and without one the bridge stands.
"""

from __future__ import annotations

import logging
from math import inf
from typing import TYPE_CHECKING

from pydantic import ValidationError

from ros2 import graph, messages
from ros2.arrivals import TopicArrivals
from ros2.graph import GraphCheck
from ros2.last_resort import LastResort
from ros2.operations import (
    Advertise,
    AskType,
    NoAnswer,
    Publish,
    ServerWords,
    Subscribe,
    TopicMessage,
    TopicType,
    UnreadableMessage,
)
from ros2.relay import STRING, RelayCommand, decode_state, encode_command
from ros2.relay_watch import SILENT_S, RelayWatch
from ros2.robot_words import Unreadable
from ros2.ros_clock import OLDEST_S
from ros2.sensor_messages import SensorMessages
from ros2.transport import NOTHING_MADE, LinkMessages
from ros2.trouble import STARTING, Ros2Trouble
from ros2.virtual_wheels import VirtualWheels
from wire import DriveState, Ros2Status

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from ros2.operations import Answer, Message, Request
    from wire import DriveCommand, RobotDescription
    from wire.ros2_config import Ros2Config

log = logging.getLogger("ros2")

ASK_S = 2.0
"""The graph is asked so often while something is missing. Not while the relay speaks, which looks
at the graph itself: some versions of rosbridge take no command while a service answers."""
SCAN_SILENT_S = 1.0
SLOWEST_ODOM_HZ = 20.0
"""A state may be 80 ms old before the bridge holds (ENC_STALE)."""
YOUNG_S = 3.0
IMU_EVERY_MS = 20
"""A server in Python writes each message field by field."""
WORDS_S = 5.0


class BaseLink:
    """Hold all that is known of one ROS 2 base."""

    def __init__(self, robot: RobotDescription, boot_id: str, relay_key: bytes = b"") -> None:
        """Begin without a connection; ``relay_key`` signs the relay's commands."""
        if robot.ros2 is None:
            raise ValueError("ros2: robot.toml is refused without it")
        self._ros2: Ros2Config = robot.ros2
        self._ttl_s = robot.drive.timeout_s
        self._relay_key = relay_key
        self._wheels = VirtualWheels(
            robot.base, robot.limits.max_speed_mps, robot.limits.max_turn_radps
        )
        self._boot_id, self._lives, self._life_of = boot_id, 0, ""
        self._graph = GraphCheck(self._ros2)
        self._closed: Ros2Trouble | None = Ros2Trouble(
            STARTING, f"{self._ros2.peer}: not reached yet"
        )
        self._subscribed_s: float | None = None
        self._asked_s = -inf
        self._relay = RelayWatch(self._ros2.cmd_vel, self._ros2.state, has_key=bool(relay_key))
        self._last_resort = LastResort(self._ros2.cmd_vel)
        self._odom_stamp_s = -inf
        self._words: tuple[float, str] | None = None
        self._topics = {need.key: TopicArrivals() for need in self._graph.needs}
        self._readers: dict[str, Callable[[Message, float], LinkMessages]] = {
            self._ros2.state: self._hear_relay,
            self._ros2.odom: self._hear_odometry,
        }
        if self._ros2.scan is not None:
            self._readers[self._ros2.scan] = self._hear_scan
        if self._ros2.imu is not None:
            self._readers[self._ros2.imu] = self._hear_imu
        self._key_of = {need.topic: need.key for need in self._graph.needs}
        self._sensors, self._seq = SensorMessages(boot_id), 0
        self.sent = self.unsent = self.unreadable = self.reached = 0

    def open(self, now_s: float) -> None:
        """Begin anew on a connection that was just made; nothing on it is known yet."""
        self._closed = None
        self._graph.begin(now_s)
        self._subscribed_s, self._asked_s, self._words = None, -inf, None
        self._relay.forget()
        self._last_resort.begin()
        self.reached += 1

    def close(self, trouble: Ros2Trouble) -> None:
        """Note that there is no connection now, and why."""
        self._closed = trouble
        self._relay.forget()

    def due(self, now_s: float) -> list[Request]:
        """Return the operations that are due: questions to the graph, then what it allows."""
        if self._closed is not None:
            return []
        wanted: list[Request] = []
        if now_s - self._asked_s >= ASK_S and not self._is_driven(now_s):
            self._asked_s = now_s
            wanted += [AskType(need.topic) for need in self._graph.needs]
        if self._graph.is_sound and self._subscribed_s is None:
            self._subscribed_s = now_s
            wanted += self._subscriptions()
        silent = self._relay.state is not None and self._relay_silent_s(now_s) > SILENT_S
        kind = self._graph.kind_of(self._ros2.cmd_vel)
        return wanted + self._last_resort.due(kind, now_s, silent=silent)

    def hear(self, said: Answer | None, now_s: float) -> LinkMessages:
        """Take one answer of the transport; return what it makes."""
        if isinstance(said, TopicMessage):
            return self._hear_topic(said, now_s)
        if isinstance(said, TopicType | NoAnswer):
            self._graph.note(said)
        elif isinstance(said, ServerWords) and said.level == "error":
            self._words = now_s, said.text
            log.warning("rosbridge says: %s", said.text)
        elif isinstance(said, UnreadableMessage) and said.topic in self._key_of:
            self._refuse(said.topic, said.reason, now_s)
        return NOTHING_MADE

    def encode(self, command: DriveCommand, now_s: float) -> Publish | None:
        """Return what sends a command; None where nobody may be moved by it."""
        relay = self._relay.state
        if relay is None or self._refuse_relay(now_s) is not None:
            self.unsent += 1
            return None
        v_mps, w_radps = self._wheels.twist(command.left_radps, command.right_radps)
        words = RelayCommand(command, relay.relay, relay.t, self._ttl_s, v_mps, w_radps)
        key = self._relay_key if relay.keyed else b""
        return Publish(self._ros2.command, encode_command(words, key))

    def judge(self, now_s: float) -> Ros2Trouble | None:
        """Return what is wrong now; None where nothing is."""
        return next(self._troubles(now_s), None)

    def status(self, seq: int, now_s: float) -> Ros2Status:
        """Return what this process tells people."""
        trouble, rates = self.judge(now_s), self._rates_hz(now_s)
        return Ros2Status(
            boot_id=self._boot_id,
            seq=seq,
            stamp_s=now_s,
            code=trouble.code if trouble else None,
            detail=trouble.detail if trouble else "",
            cmd_vel=self._graph.kind_of(self._ros2.cmd_vel)[:400],
            odom_hz=rates["odom"],
            relay_hz=rates["relay"],
            scan_hz=rates.get("scan", 0.0),
            sent=self.sent,
            unsent=self.unsent,
            unreadable=self.unreadable,
            opened=self.reached,
        )

    def _rates_hz(self, now_s: float) -> dict[str, float]:
        return {key: round(topic.rate_hz(now_s), 1) for key, topic in self._topics.items()}

    def _subscriptions(self) -> list[Request]:
        ros2 = self._ros2
        wanted: list[Request] = [
            Advertise(ros2.command, STRING),
            Subscribe(ros2.state, STRING),
            Subscribe(ros2.odom, graph.ODOMETRY),
        ]
        if ros2.scan is not None:
            wanted.append(Subscribe(ros2.scan, graph.LASER_SCAN))
        if ros2.imu is not None:
            wanted.append(Subscribe(ros2.imu, graph.IMU, IMU_EVERY_MS))
        return wanted

    def _troubles(self, now_s: float) -> Iterator[Ros2Trouble]:
        """Yield all that is wrong, what must be mended first before the rest."""
        if self._closed is not None:
            yield self._closed
            return
        wrong = self._graph.trouble(now_s)
        since_s = self._subscribed_s
        if wrong is not None or since_s is None:
            yield wrong or Ros2Trouble(STARTING, f"{self._ros2.peer}: not subscribed yet")
            return
        if self._words is not None and now_s - self._words[0] <= WORDS_S:
            yield Ros2Trouble("ros2_server_refuses", f"rosbridge says: {self._words[1]}")
        young = now_s - since_s < YOUNG_S
        silent_s = self._topics["relay"].silent_s(since_s, now_s)
        if self._relay.state is None or silent_s > SILENT_S:
            code = STARTING if young and self._relay.state is None else "ros2_relay_silent"
            yield Ros2Trouble(code, f"{self._ros2.state} says nothing for {silent_s:.1f} s")
        refused = self._refuse_relay(now_s)
        if refused is not None:
            yield refused
        for need in self._graph.needs:
            topic = self._topics[need.key]
            if topic.is_refused(now_s):
                code = "ros2_clock" if " clock" in topic.wrong else "ros2_unreadable"
                yield Ros2Trouble(code, f"{need.topic}: {topic.wrong}")
        if not young:
            yield from self._slow_topics(since_s, now_s)

    def _slow_topics(self, since_s: float, now_s: float) -> Iterator[Ros2Trouble]:
        for need in self._graph.needs:
            if need.key not in ("odom", "scan", "imu"):
                continue
            silent_s = self._topics[need.key].silent_s(since_s, now_s)
            if silent_s > (SCAN_SILENT_S if need.key == "scan" else SILENT_S):
                yield Ros2Trouble(
                    "ros2_topic_silent", f"{need.topic} says nothing for {silent_s:.1f} s"
                )
        rate_hz = self._topics["odom"].rate_hz(now_s)
        if rate_hz < SLOWEST_ODOM_HZ:
            found = f"{self._ros2.odom} came {rate_hz:.1f} times a second"
            yield Ros2Trouble("ros2_odom_slow", f"{found}, expected {SLOWEST_ODOM_HZ:g} or more")

    def _is_driven(self, now_s: float) -> bool:
        """Return whether the relay speaks and may be driven by."""
        return (
            self._relay.state is not None
            and self._relay_silent_s(now_s) <= SILENT_S
            and self._refuse_relay(now_s) is None
        )

    def _relay_silent_s(self, now_s: float) -> float:
        return self._topics["relay"].silent_s(-inf, now_s)

    def _refuse_relay(self, now_s: float) -> Ros2Trouble | None:
        """Return why nobody may be driven by this graph and its relay."""
        if not self._graph.is_sound:
            return self._graph.trouble(now_s)
        return self._relay.refusal(now_s, self._graph.kind_of(self._ros2.cmd_vel))

    def _refuse(self, topic: str, why: str, now_s: float) -> None:
        self.unreadable += 1
        self._topics[self._key_of[topic]].refuse(why[:200], now_s)

    def _hear_topic(self, said: TopicMessage, now_s: float) -> LinkMessages:
        reader = self._readers.get(said.topic)
        if reader is None or self._closed is not None:
            return NOTHING_MADE
        try:
            heard = reader(said.message, now_s)
        except (Unreadable, ValidationError) as why:  # finite, and beyond what the wire carries
            self._refuse(said.topic, str(why), now_s)
            return NOTHING_MADE
        self._topics[self._key_of[said.topic]].note(now_s)
        return heard

    def _hear_relay(self, message: Message, now_s: float) -> LinkMessages:
        self._relay.hear(decode_state(message), now_s)
        return NOTHING_MADE

    def _hear_odometry(self, message: Message, now_s: float) -> LinkMessages:
        pose = messages.read_odometry(message)
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
        if self._refuse_relay(now_s) is not None or self._relay_silent_s(now_s) > SILENT_S:
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
                estop_pressed=False,  # no such inputs are wired to this drive
                bumper_front=False,
                bumper_rear=False,
                cliff=False,
            )
        )

    def _live(self, pose: messages.OdometryReading, relay: str) -> str:
        """Return the drive's boot id; another where relay or odometry began anew."""
        jumped = self._wheels.jumps(pose)
        if jumped or self._lives == 0 or relay != self._life_of:
            if jumped:
                log.warning("odometry jumped: the base counts anew")
            self._wheels.forget()
            self._lives += 1
            self._life_of = relay
        return f"{self._boot_id}-{self._lives}"

    def _hear_scan(self, message: Message, now_s: float) -> LinkMessages:
        reading = messages.read_scan(message, self._ros2.scan_zero)
        if self._relay.state is None:
            return NOTHING_MADE
        return LinkMessages(
            scan=self._sensors.scan(reading, self._relay.clock.date(reading.stamp_s, now_s))
        )

    def _hear_imu(self, message: Message, now_s: float) -> LinkMessages:
        reading = messages.read_imu(message)
        if self._relay.state is None:
            return NOTHING_MADE
        return LinkMessages(
            imu=self._sensors.imu(reading, self._relay.clock.date(reading.stamp_s, now_s))
        )
