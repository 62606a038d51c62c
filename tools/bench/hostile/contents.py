"""Make dangerous messages of every key, out of what was heard and a seeded chance. Pure.

All are in schema, so that nothing but the listener's judgement stands between them and the wheels;
proofs are made without the operator's key. The published key of a simulated drive is left unused:
whoever signs with it is the operator.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, pi, sin
from typing import TYPE_CHECKING, Any

from tools.bench.hostile.draw import Mood
from wire import (
    PROTOCOL,
    Answer,
    DriveCommand,
    EstopLink,
    Event,
    FenceRequest,
    Grant,
    Heartbeat,
    Hello,
    LocalizerStatus,
    Mode,
    OpRequest,
    Pose2,
    PoseHint,
    Proof,
    Record,
    SimControl,
    SimFault,
    Stop,
    Twist2,
    Velocity,
    Waypoint,
    Waypoints,
    encode,
    keys,
)

if TYPE_CHECKING:
    from collections.abc import Callable
    from random import Random

    from wire import OwnerKind, Status
    from wire.keys import Key

    Said = list[tuple[str, bytes]]
    """Key path and payload."""

FARTHEST = 9_007_199_254_740_991
AHEAD = (1, 2, 100, 10**6)
POINTS, STEP_M = 30, 0.1
CREEP_M = 0.02
ANSWERED, GARBAGE_KEYS = 8, 4
FENCE = '{"allowed": [[[-100, -100], [100, -100], [100, 100], [-100, 100]]], "keep_out": []}'
PLACES = (Pose2(2.5, 4.75, 0.0), Pose2(9.0, 4.75, 0.0))
"""In the hallway of the home: a wish that counts leaves the robot free to move."""


@dataclass
class Liar:
    """Hold what one hostile client knows, and make what it says."""

    chance: Random
    heard: dict[str, Any] = field(default_factory=dict)
    """The newest message of each key that it was told."""
    count: int = 0
    heading_rad: float = 0.0

    def say(self, moods: tuple[Mood, ...]) -> Said:
        """Return one turn's messages."""
        self.count += 1
        if self.count % 40 == 1:
            self.heading_rad = self.chance.uniform(-pi, pi)
        said: Said = []
        for mood in moods:
            said += MOODS[mood](self)
        return said

    @property
    def status(self) -> Status | None:
        """Return the bridge's newest word, where one was heard."""
        status: Status | None = self.heard.get(keys.STATUS.path)
        return status

    @property
    def name(self) -> str:
        """Return a name that is nobody's."""
        return "hostile"

    def number(self, key: Key[Any]) -> int:
        """Return a sequence number that comes after the newest of a key."""
        newest = getattr(self.heard.get(key.path), "seq", 10**6 + self.count)
        return int(min(FARTHEST, newest + self.chance.choice(AHEAD) + self.count))


def of(key: Key[Any], *messages: Record) -> Said:
    """Return messages of a key as they are sent."""
    return [(key.path, encode(message)) for message in messages]


# Orders -----------------------------------------------------------------------------------------


def take_over(liar: Liar) -> Said:
    """Ask to own the robot, and lead it through walls."""
    return _hello(liar, "planner") + _lead(liar, liar.name)


def impersonate(liar: Liar) -> Said:
    """Speak in the owner's name."""
    status = liar.status
    owner = status.owner.planner_id if status and status.owner else liar.name
    return _lead(liar, owner)


def external(liar: Liar) -> Said:
    """Own it as an external brain, and push on."""
    return _hello(liar, "external") + _beat(liar, liar.name) + _push(liar, keys.EXTERNAL)


def stick(liar: Liar) -> Said:
    """Hold a stick at full speed, let go now and then as a stick must be."""
    return _push(liar, keys.TELEOP)


def proofs(liar: Liar) -> Said:
    """Ask for all that lets a robot move, with proofs that are wrong."""
    nonce = liar.status.nonce if liar.status else "boot.1"
    proof = Proof(nonce=nonce, mac=f"{liar.chance.getrandbits(256):064x}")
    request = OpRequest(id=_id(liar), source="cli", proof=proof)
    fence = FenceRequest(id=_id(liar), source="cli", fence=FENCE, proof=proof)
    said = of(keys.FENCE, fence)
    for key in (keys.ARM, keys.RESET, keys.RESUME):
        said += of(key, request, request.model_copy(update={"id": _id(liar), "proof": None}))
    return said


def nuisance(liar: Liar) -> Said:
    """Stop and disarm, as anybody may."""
    request = OpRequest(id=_id(liar), source="cli")
    stop = Stop(id=_id(liar), source="cli")
    return of(keys.STOP, stop) + of(keys.ESTOP, request) + of(keys.DISARM, request)


def _id(liar: Liar) -> str:
    return f"h{liar.chance.getrandbits(40)}"


def _hello(liar: Liar, kind: OwnerKind) -> Said:
    status = liar.status
    if status is None or (status.owner and status.owner.planner_id == liar.name):
        return []
    hello = Hello(
        planner_id=liar.name, kind=kind, seen=status.seq, protocol=PROTOCOL,
        robot_hash=status.robot_hash, fence_hash=status.fence_hash,
        map_id=status.map_id or "0" * 16,
    )  # fmt: skip
    return of(keys.HELLO, hello)


def _beat(liar: Liar, owner: str) -> Said:
    status = liar.status
    if status is None:
        return []
    beat = Heartbeat(planner_id=owner, epoch=status.epoch, seen=status.seq, used=status.seq)
    return of(keys.HEARTBEAT, beat)


def _lead(liar: Liar, owner: str) -> Said:
    """Say a heartbeat, a grant and a straight way in the mission that is under way."""
    status = liar.status
    if status is None or status.base_in_map is None:
        return []
    mission = status.grant.mission if status.grant else "hostile"
    grant = Grant(
        planner_id=owner, epoch=status.epoch, seen=status.seq, mission=mission, metres=60.0,
        seconds=600.0,
    )  # fmt: skip
    here, way = status.base_in_map, liar.heading_rad
    speed = liar.chance.choice((0.5, 2.0))
    points = tuple(
        Waypoint(x_m=here.x_m + n * STEP_M * cos(way), y_m=here.y_m + n * STEP_M * sin(way),
                 speed_mps=speed)
        for n in range(POINTS)
    )  # fmt: skip
    leg = status.leg.leg if status.leg else 1
    horizon = Waypoints(
        planner_id=owner, epoch=status.epoch, seq=liar.number(keys.STATUS), seen=status.seq,
        mission=mission, leg=leg + liar.chance.choice((0, 1)), map_id=status.map_id or "0" * 16,
        ttl_s=2.0, points=points, final=False,
    )  # fmt: skip
    return _beat(liar, owner) + of(keys.GRANT, grant) + of(keys.WAYPOINTS, horizon)


def _push(liar: Liar, key: Key[Velocity]) -> Said:
    status = liar.status
    if status is None:
        return []
    held = liar.count % 60 > 4
    speed = liar.chance.choice((0.5, 10.0, -10.0)) if held else 0.0
    velocity = Velocity(
        source_id=liar.name, epoch=status.epoch, seq=liar.count, seen=status.seq, v_mps=speed,
        w_radps=liar.chance.choice((0.0, 0.0, 20.0)) if held else 0.0, dead_man=held,
    )  # fmt: skip
    return of(key, velocity)


# What the bridge drives by ----------------------------------------------------------------------


def senses(liar: Liar) -> Said:
    """Say that all is free, that nothing turns, and that the robot is where it began."""
    said: Said = []
    for key, changes in (
        (keys.SCAN, {"ranges_m": lambda ranges: tuple(None for _ in ranges)}),
        (keys.DRIVE_STATE, {"left_radps": lambda _: 0.0, "right_radps": lambda _: 0.0,
                            "estop_pressed": lambda _: False, "bumper_front": lambda _: False}),
        (keys.IMU, {"yaw_rate_radps": lambda _: 0.0}),
        (keys.ODOM, {"base_in_odom": lambda _: Pose2(0.0, 0.0, 0.0)}),
        (keys.LIDAR_STATE, {"code": lambda _: None, "rate_hz": lambda _: 10.0}),
        (keys.CAMERA_STATE, {"code": lambda _: None, "rate_hz": lambda _: 10.0}),
        (keys.IMU_STATE, {"code": lambda _: None, "rate_hz": lambda _: 100.0}),
        (keys.ROS2_STATE, {"code": lambda _: None, "odom_hz": lambda _: 50.0}),
        (keys.NAV2_STATE, {"phase": lambda _: "driving", "v_mps": lambda _: 5.0}),
        (keys.NAV2_GOAL, {"goal": lambda _: Pose2(0.0, 0.0, 0.0)}),
        (keys.SIM_TRUTH, {"base_in_map": lambda _: Pose2(0.0, 0.0, 0.0)}),
    ):  # fmt: skip
        said += _forge(liar, key, changes)
    return said


def leap(liar: Liar) -> Said:
    """Say a pose somewhere else, that a person says so, and that all is well with it."""
    x_m, y_m = liar.chance.uniform(-1.0, 12.0), liar.chance.uniform(-1.0, 10.0)
    pose = Pose2(x_m, y_m, liar.chance.uniform(-pi, pi))
    hint = PoseHint(id=_id(liar), pose=pose, radius_m=15.0, any_heading=True)
    well = LocalizerStatus(
        boot_id=liar.name, seq=liar.number(keys.LOC_STATE), stamp_s=0.0, state="tracking", score=1.0
    )
    said = _forge(liar, keys.LOCALIZATION, {"odom_in_map": lambda _: pose})
    return said + of(keys.LOC_HINT, hint) + of(keys.LOC_STATE, well)


def creep(liar: Liar) -> Said:
    """Say a pose that goes away by two centimetres a turn."""
    away_m = CREEP_M * (liar.count % 200)
    return _forge(
        liar, keys.LOCALIZATION,
        {"odom_in_map": lambda at: Pose2(
            at.x_m + away_m * cos(liar.heading_rad), at.y_m + away_m * sin(liar.heading_rad),
            at.yaw_rad)},
    )  # fmt: skip


def _forge(liar: Liar, key: Key[Any], changes: dict[str, Callable[[Any], Any]]) -> Said:
    """Return the newest message of a key, some of it changed, numbered as the next one."""
    newest = liar.heard.get(key.path)
    if newest is None:
        return []
    told = {name: change(getattr(newest, name)) for name, change in changes.items()}
    stamp = {"stamp_s": newest.stamp_s + 0.05} if hasattr(newest, "stamp_s") else {}
    return of(key, newest.model_copy(update={**told, **stamp, "seq": liar.number(key)}))


def wheels(liar: Liar) -> Said:
    """Command the drive in the bridge's place."""
    status, newest = liar.status, liar.heard.get(keys.DRIVE_COMMAND.path)
    boot = newest.boot if newest else status.boot if status else "boot"
    fast = liar.chance.choice((10.0, 1000.0))
    command = DriveCommand(
        boot=boot, seq=liar.number(keys.DRIVE_COMMAND), left_radps=fast, right_radps=fast,
        enable=True,
    )  # fmt: skip
    return of(keys.DRIVE_COMMAND, command)


def button(liar: Liar) -> Said:
    """Say that nobody presses the wired button."""
    return of(keys.ESTOP_LINK, EstopLink(seq=liar.number(keys.ESTOP_LINK), pressed=False))


# What a person is told --------------------------------------------------------------------------


def answers(liar: Liar) -> Said:
    """Say in the bridge's place that the robot stands and every stop was taken."""
    status = liar.status
    if status is None:
        return []
    around = liar.chance.sample(range(1, 65_536), ANSWERED)
    accepted = tuple(
        Answer(id=f"cli-{pid}-direct", kind="stop", accepted=True, code="ok", detail="")
        for pid in around
    )
    still = Twist2(0.0, 0.0)
    forged = status.model_copy(
        update={
            "seq": min(FARTHEST, status.seq + liar.chance.choice(AHEAD)), "mode": Mode.HOLD,
            "answers": accepted, "measured": still, "sent": still,
        }
    )  # fmt: skip
    event = Event(
        boot=status.boot, seq=liar.number(keys.EVENT), tick=0, at_s=status.at_s, code="stop_taken",
        mode=Mode.HOLD, detail="",
    )  # fmt: skip
    return of(keys.STATUS, forged) + of(keys.EVENT, event)


def simulator(liar: Liar) -> Said:
    """Wish the robot elsewhere, running away, its lidar stuck."""
    faults = (liar.chance.choice((SimFault.RUNAWAY, SimFault.LIDAR_STUCK, SimFault.LIDAR_BLIND)),)
    place = liar.chance.choice(PLACES) if liar.count % 20 == 0 else None
    return of(keys.SIM_CONTROL, SimControl(id=_id(liar), faults=faults, place_robot=place))


def garbage(liar: Liar) -> Said:
    """Say bytes that are no messages, some too many, on some keys."""
    size = liar.chance.choice((0, 3, 300, 40_000))
    some = liar.chance.sample(keys.KEYS, GARBAGE_KEYS)
    return [(key.path, liar.chance.randbytes(size)) for key in some]


MOODS: dict[Mood, Callable[[Liar], Said]] = {
    Mood.TAKE_OVER: take_over,
    Mood.IMPERSONATE: impersonate,
    Mood.STICK: stick,
    Mood.EXTERNAL: external,
    Mood.PROOFS: proofs,
    Mood.SENSES: senses,
    Mood.CREEP: creep,
    Mood.LEAP: leap,
    Mood.WHEELS: wheels,
    Mood.ANSWERS: answers,
    Mood.SIMULATOR: simulator,
    Mood.BUTTON: button,
    Mood.NUISANCE: nuisance,
    Mood.GARBAGE: garbage,
}
