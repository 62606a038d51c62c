"""Draw an episode from its number: mission, faults, moments, stop, and the last order. Pure."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from enum import StrEnum
from math import exp, log
from random import Random
from typing import Any

from pons.kept_sockets import LISTENING
from wire.doors import DOORS, HINT_DOOR, SIM_DOOR

PROCESSES = (
    "bridge", "planner", "sim", "localization", "camera", "recorder", "vision", "route", "voice",
)  # fmt: skip
_LATER = (HINT_DOOR,)
OWNER_OF = {
    door.name: child
    for child, party in LISTENING.items()
    for door in DOORS
    if child in PROCESSES and door.listener is party and door not in (SIM_DOOR, *_LATER)
} | {door.name: door.listener.value for door in _LATER}
"""Which process listens at each door, but for the tests' own; the simulated
robot has no lidar of metal. Their order is part of a draw, so
doors that came later stand last; numbers of before they came mean other draws."""
LIDAR = ("lidar_off", "lidar_stuck", "lidar_blind", "lidar_intermittent")
FREEZE_S, STALL_S, OTHER_S = (0.15, 5.0), (0.2, 3.0), (0.5, 7.0)
TWO_AT_ONCE, STOPPED, GOES_ON = 0.25, 1 / 3, 0.15


class FaultKind(StrEnum):
    """Name what can happen to a robot."""

    KILL = "kill -9"
    FREEZE = "freeze"
    MEMORY = "no more memory"
    LIDAR = "lost lidar"
    DISK_FULL = "full disk"
    READ_ONLY = "read-only home"
    SLOW_DISK = "slow disk"
    STALL = "host stall"
    SOCKET = "socket removed"


WEIGHTS = {
    FaultKind.KILL: 4,
    FaultKind.FREEZE: 4,
    FaultKind.MEMORY: 3,
    FaultKind.LIDAR: 1,
    FaultKind.DISK_FULL: 1,
    FaultKind.READ_ONLY: 1,
    FaultKind.SLOW_DISK: 1,
    FaultKind.STALL: 1,
    FaultKind.SOCKET: 1,
}
OF_A_PROCESS = frozenset({FaultKind.KILL, FaultKind.FREEZE, FaultKind.MEMORY})


@dataclass(frozen=True, slots=True)
class Breakage:
    """Describe one fault; moments count from the mission's acceptance [s]."""

    kind: FaultKind
    target: str
    """A process, a fault of the simulated lidar, a listener, or nothing."""
    at_s: float
    for_s: float
    """Zero where there is nothing to end: a kill, a removed socket."""

    @property
    def name(self) -> str:
        """Return what it is called in a table."""
        return f"{self.kind.value} {self.target}".rstrip()


@dataclass(frozen=True, slots=True)
class StopDrawn:
    """Describe how and when a person says stop."""

    way: str
    """``http`` or ``cli``; a person who gets no answer goes on with the second."""
    at_s: float


@dataclass(frozen=True, slots=True)
class Episode:
    """Hold one episode whole."""

    number: int
    mission: str
    says: tuple[str, ...]
    """Sentences that the mission is to say, each once."""
    faults: tuple[Breakage, ...]
    stop: StopDrawn | None
    goes_on: bool
    """The person resumes the mission afterwards; else it is cancelled."""
    last: str
    """What is said to the recovered robot."""

    def record(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        return asdict(self)


def draw(number: int) -> Episode:
    """Return the episode of a number: the same one every time."""
    chance = Random(number)
    mission, says = _mission(chance, number)
    first = _fault(chance, chance.uniform(0.3, 6.0))
    faults = [first]
    if chance.random() < TWO_AT_ONCE:
        faults.append(_fault(chance, first.at_s + chance.uniform(0.0, 1.5)))
    stop = None
    if chance.random() < STOPPED:
        at_s = max(0.1, first.at_s + chance.uniform(-1.5, 2.5))
        stop = StopDrawn(chance.choice(("http", "cli")), round(at_s, 3))
    goes_on = chance.random() < GOES_ON or bool(says)
    return Episode(number, mission, says, tuple(faults), stop, goes_on, _last(chance))


def _fault(chance: Random, at_s: float) -> Breakage:
    kind = chance.choices(list(WEIGHTS), list(WEIGHTS.values()))[0]
    target, span_s = "", OTHER_S
    if kind in OF_A_PROCESS:
        target = chance.choice(PROCESSES)
    if kind is FaultKind.LIDAR:
        target = chance.choice(LIDAR)
    if kind is FaultKind.SOCKET:
        target = chance.choice(tuple(OWNER_OF))
    if kind in (FaultKind.FREEZE, FaultKind.STALL):
        span_s = FREEZE_S if kind is FaultKind.FREEZE else STALL_S
    for_s = exp(chance.uniform(log(span_s[0]), log(span_s[1])))
    if kind in (FaultKind.KILL, FaultKind.SOCKET):
        for_s = 0.0
    return Breakage(kind, target, round(at_s, 3), round(for_s, 3))


ROOMS = {
    "living room": "客厅", "kitchen": "厨房", "bedroom": "卧室", "bathroom": "卫生间",
    "study": "书房", "hallway": "走廊", "entrance": "玄关",
}  # fmt: skip


def _mission(chance: Random, number: int) -> tuple[str, tuple[str, ...]]:
    """Draw a sentence in one of two languages, and what it is to say."""
    (a, a_zh), (b, b_zh) = chance.sample(sorted(ROOMS.items()), 2)
    degrees, metres = chance.choice((45, 90, 135)), chance.choice((0.3, 0.5, 0.8))
    one, two = f"message {number} one", f"message {number} two"
    one_zh, two_zh = f"第{number}号消息甲", f"第{number}号消息乙"
    drawn: list[tuple[str, tuple[str, ...]]] = [
        (f"go to the {a}", ()),
        (f"去{a_zh}", ()),
        (f"go to the {a}, then go to the {b}", ()),
        (f"去{a_zh}，然后去{b_zh}", ()),
        (f"find the cup in the {a}", ()),
        ("look around", ()),
        ("看看周围", ()),
        (f"turn left {degrees} degrees, then move forward {metres} m", ()),
        (f"右转{degrees}度，然后前进{metres}米", ()),
        (f"wait 2 seconds, then go to the {a}", ()),
        (f'say "{one}", then turn left {degrees} degrees, then say "{two}"', (one, two)),
        (f'wait 3 seconds, then say "{one}", then move forward {metres} m', (one,)),
        (f"说“{one_zh}”，然后右转{degrees}度，然后说“{two_zh}”", (one_zh, two_zh)),
    ]
    return chance.choice(drawn)


def _last(chance: Random) -> str:
    room, room_zh = chance.choice(sorted(ROOMS.items()))
    turn = chance.choice(("turn left 90 degrees", "turn right 60 degrees", "左转90度", "右转60度"))
    return chance.choice((turn, turn, turn, turn, f"go to the {room}", f"去{room_zh}"))
