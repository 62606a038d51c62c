"""Make what a hostile or unlucky world may put in the inbox: late, reordered, repeated, foreign.

Drawn from a seed, so that a thousand ticks cost what ten would cost drawn one value at a time; most
values are plausible for the state of the moment, because noise alone never gets past the door.
Values that are no message (NaN, infinity, beyond bounds) never pass the codec: they arrive as
``rejected``, and that is how they come here.
"""

from __future__ import annotations

from random import Random
from typing import Any, TypeVar

from bridge.core import (
    ArrivedAt,
    BridgeState,
    CoreConfig,
    Inbox,
    LoopFacts,
    OperatorArrival,
    RejectedAt,
)
from tests.bridge.core.fake_planner import MAP_ID
from wire import (
    PROTOCOL,
    DecodeFailure,
    DriveState,
    EstopLink,
    Grant,
    Heartbeat,
    Hello,
    Localization,
    OpKind,
    OpRequest,
    Pose2,
    Proof,
    Scan,
    Stop,
    Velocity,
    Waypoint,
    Waypoints,
)

T = TypeVar("T")
HUGE = 2**53 - 1
OPS: tuple[OpKind, ...] = ("arm", "disarm", "estop", "reset", "resume")
KEYS = ("cmd/waypoints", "cmd/teleop", "cmd/external", "cmd/hello")


class Hostile:
    """Make inboxes and gaps from one seed; remembers messages to say them again later."""

    def __init__(self, seed: int, config: CoreConfig) -> None:
        self.random = Random(seed)
        self.seed = seed
        self.config = config
        self.past: list[Inbox] = []
        self.seq = 1_000  # beyond what the well-behaved world has said
        self.manners = {
            part: self.random.choice([0.5, 0.95, 0.999, 1.0, 1.0])
            for part in ("drive", "senses", "orders", "loop", "people")
        }
        """How often each part of the world says what a well-behaved one would. A world in which
        all is broken at once never gets anywhere that matters."""
        self.calm = 1.0

    def gap_s(self) -> float:
        usual = self.random.random() < max(0.9, self.manners["loop"])
        return 0.01 if usual else self.random.choice([0.0, 1e-9, 0.03, 0.2, 1.0, -1.0, 6.0, 1e6])

    def inbox(self, state: BridgeState, now_s: float) -> Inbox:
        if self.past and self.random.random() < 0.05 * (1.0 - self.manners["orders"]):
            return self.random.choice(self.past)
        self.state, self.now_s = state, now_s
        rude = 1.0 - self.manners["people"]
        self.calm = self.manners["people"]
        people: dict[str, Any] = {
            "stops": self._some(0.1 * rude, self._stop),
            "ops": self._some(0.1, self._op),
            "teleop": self._some(0.3 if self.seed % 3 == 0 else 0.0, self._velocity),
            "estop_link": self._maybe(
                0.1, lambda: EstopLink(seq=1, pressed=self.random.random() < rude)
            ),
            "recorder_ok": self._say(True, False),
        }
        self.calm = self.manners["orders"]
        orders: dict[str, Any] = {
            "hellos": self._some(0.2, self._hello),
            "grants": self._some(0.2, self._grant),
            "heartbeats": self._some(0.4, self._heartbeat),
            "external": self._some(0.1 * (1.0 - self.calm), self._velocity),
            "waypoints": self._some(0.4, self._waypoints),
            "rejected": self._some(0.3 * (1.0 - self.calm), self._rejected),
            "arrived": (ArrivedAt("cmd/hello", 1),),
        }
        self.calm = self.manners["senses"]
        senses: dict[str, Any] = {
            "localization": self._maybe(0.3, self._localization),
            "scan": self._maybe(0.2, self._scan),
        }
        self.calm = self.manners["drive"]
        drive = self._some(1.0, self._drive) if self.calm < 1.0 else (self._drive(),)
        self.calm = self.manners["loop"]
        loop: dict[str, Any] = {
            "loop": LoopFacts(
                late_s=self._say(0.0, 0.006, 10.0), missed_ticks=self._say(0, 2, 9999)
            ),
            "real_time": self._say(True, False),
            "sensors_same_host": self._say(True, False),
            "localization_same_host": self._say(True, False),
        }
        chance = f"{self.random.getrandbits(64):016x}"
        inbox = Inbox(**people, **orders, **senses, drive=drive, **loop, chance=chance)
        self.past = [*self.past[-8:], inbox]
        return inbox

    def _say(self, plausible: T, *others: T) -> T:
        return plausible if self.random.random() < self.calm else self.random.choice(others)

    def _some(self, share: float, make: object) -> tuple[T, ...]:
        count = self.random.choice([1, 1, 1, 2, 4]) if self.random.random() < share else 0
        return tuple(make() for _ in range(count))  # type: ignore[operator]

    def _maybe(self, share: float, make: object) -> T | None:
        return make() if self.random.random() < share else None  # type: ignore[operator]

    def _next(self) -> int:
        self.seq += 1
        return self._say(self.seq, max(0, self.seq - 3), self.seq + 50, 0)

    def _seen(self) -> int:
        newest = self.state.voice.status_seq
        return self._say(newest, max(0, newest - 3), max(0, newest - 300), newest + 9, HUGE)

    def _epoch(self) -> str:
        number = self.state.epoch_no
        boot = self.config.boot
        return self._say(f"{boot}-{number}", f"{boot}-{max(0, number - 1)}", "other-1")

    def _id(self) -> str:
        return f"x{self.random.randrange(200)}"

    def _stop(self) -> Stop:
        return Stop(id=self._id(), source="anyone")

    def _op(self) -> OperatorArrival:
        operator = self.state.operator
        number = self._say(operator.nonce_no, 0, operator.nonce_no - 1)
        nonce = f"{self.config.boot}.{number}.{self._say(operator.nonce_tag, '', operator.old_tag)}"
        proof = Proof(nonce=nonce.replace("-", ""), mac="0" * 64)
        request = OpRequest(id=self._id(), source="op", proof=self._say(proof, None))
        calm: tuple[OpKind, ...] = ("arm", "resume", "reset")
        kind = self.random.choice((*calm, *OPS) if self.calm < 1.0 else calm)
        return OperatorArrival(kind, request, self._say(True, False))

    def _hello(self) -> Hello:
        return Hello(
            planner_id=self._say("p1", "p2"),
            kind=self._say("planner", "external"),
            seen=self._seen(),
            protocol=self._say(PROTOCOL, PROTOCOL + 1),
            robot_hash=self._say(self.config.robot_hash, "0" * 16),
            fence_hash=self.config.fence_hash,
            map_id=self._say(MAP_ID, "0" * 16),
        )

    def _grant(self) -> Grant:
        return Grant(
            planner_id=self._say("p1", "p2"),
            epoch=self._epoch(),
            seen=self._seen(),
            mission=self._say("m1", "m2", f"m{self.random.randrange(99)}"),
            metres=self._say(30.0, 1e-3),
            seconds=self._say(60.0, 1e-3),
        )

    def _heartbeat(self) -> Heartbeat:
        seen = self._seen()
        return Heartbeat(
            planner_id=self._say("p1", "p2"),
            epoch=self._epoch(),
            seen=seen,
            used=self._say(seen, 0, HUGE),
        )

    def _velocity(self) -> Velocity:
        return Velocity(
            source_id=self._say("stick", "p1", "p2"),
            epoch=self._epoch(),
            seq=self._next(),
            seen=self._seen(),
            v_mps=self._say(self.random.uniform(-0.6, 0.6), 0.0, 10.0, -10.0, 5e-324),
            w_radps=self._say(self.random.uniform(-1.2, 1.2), 0.0, 20.0, -20.0),
            dead_man=self.random.random() < 0.7,
        )

    def _waypoints(self) -> Waypoints:
        here = self.state.odometry.base_in_odom
        step = self._say(0.1, 0.0, 0.01, 3.0, -0.1)
        speed = self._say(0.4, -0.4, 0.0, 10.0)
        count = self.random.choice([0, 1, 5, 20])
        points = tuple(
            Waypoint(
                x_m=_within(here.x_m + index * step),
                y_m=_within(here.y_m + self._say(0.0, 0.6, -9_000.0)),
                speed_mps=speed,
                heading_rad=self._say(None, 1.0) if index == count - 1 else None,
            )
            for index in range(count)
        )
        return Waypoints(
            planner_id=self._say("p1", "p2"),
            epoch=self._epoch(),
            seq=self._next(),
            seen=self._seen(),
            mission=self._say(self.state.grants.mission or "m1", "m2"),
            leg=self._say(max(1, self.state.leg.leg), 0, self.state.leg.leg + 1),
            map_id=self._say(MAP_ID, "0" * 16),
            ttl_s=self._say(0.5, 0.01, 2.0),
            points=points,
            final=self.random.random() < 0.5,
        )

    def _drive(self) -> DriveState:
        last = self.state.drive.newest
        seq = 0 if last is None else last.seq
        sent = self.state.motion.limiter.sent.v_mps / self.config.robot.base.wheel_radius_m
        left = 0.0 if last is None else last.left_rad
        right = 0.0 if last is None else last.right_rad
        return DriveState(
            boot_id=self._say("d0" if last is None else last.boot_id, "d1", "d2"),
            seq=min(HUGE, self._say(seq + 1, seq, seq + 5)),
            stamp_s=abs(self._say(self.now_s, self.now_s - 5.0, self.now_s + 5.0, 0.0)),
            echo_boot=self._say(self.config.boot, None, "other"),
            echo_seq=self._say(self.state.command_seq, 0, HUGE),
            enabled=self._say(True, False),
            timed_out=self._say(False, True, None),
            left_rad=_angle(self._say(left + 0.01 * sent, left, 1e9, -1e9)),
            right_rad=_angle(self._say(right + 0.01 * sent, right, 1e9, -1e9)),
            left_radps=self._say(sent, 0.0, 1_000.0, -1_000.0),
            right_radps=self._say(sent, 0.0, 1_000.0, -1_000.0),
            estop_pressed=self.random.random() < 0.1 * (1.0 - self.calm),
            bumper_front=self._say(False, True, None),
            bumper_rear=self._say(False, True, None),
            cliff=self._say(False, True, None),
        )

    def _localization(self) -> Localization:
        jump = self._say(0.0, 0.0, 0.5, 10_000.0)
        return Localization(
            odom_id=self._say(self.config.boot, "other"),
            seq=self._next(),
            stamp_s=abs(self._say(self.now_s, self.now_s - 5.0, 0.0)),
            odom_in_map=Pose2(jump, self._say(0.0, -10_000.0), self._say(0.0, 6.28)),
            quality=self._say(1.0, 0.0),
            map_id=self._say(MAP_ID, "0" * 16),
        )

    def _scan(self) -> Scan:
        last = self.state.lidar.newest
        beams = self.random.choice([0, 1, 36, 36, 36])
        ranges = tuple(self._say(5.0 + self.random.random(), None, 0.0, 0.4) for _ in range(beams))
        return Scan(
            boot_id=self._say("l0", "l1"),
            seq=0 if last is None else min(HUGE, last.seq + 1),
            stamp_s=abs(self._say(self.now_s, self.now_s - 5.0, 0.0)),
            angle_min_rad=self._say(-3.14159, 0.0, 6.28),
            angle_increment_rad=self._say(0.1745, 0.01, 1.0),
            range_min_m=0.12,
            range_max_m=8.0,
            ranges_m=ranges,
        )

    def _rejected(self) -> RejectedAt:
        why = DecodeFailure("invalid", "x_m: input should be a finite number")
        return RejectedAt(self.random.choice(KEYS), why)


def _within(metres: float) -> float:
    return metres if -10_000.0 <= metres <= 10_000.0 else 0.0


def _angle(angle: float) -> float:
    return angle if -1e9 <= angle <= 1e9 else 0.0
