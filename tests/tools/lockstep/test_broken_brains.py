"""A brain that drove well goes wrong in one way: the robot breaks no law, and stands where it must.

Bytes on the bus, so that what is no message at all is tried, too. Each way is tried as a planner by
horizons and as an external brain by velocities; afterwards the same brain, mended, drives again.
"""

from __future__ import annotations

import json
from collections import deque
from copy import deepcopy
from math import nan
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, cast

import pytest

from tools.lockstep import TICK_S, LockstepWorld
from tools.lockstep.constant_drive import ConstantDrive
from tools.lockstep.homes import hall, made_home
from tools.lockstep.hostile import HostilePlanner, TrustingOperator
from tools.lockstep.judge import Judge
from wire import Record, Velocity, encode, keys
from wire.keys import Party

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from tools.lockstep.hostile import Kind
    from wire import Status
    from wire.keys import Key

    Message = dict[str, Any]
    Breaker = Callable[["BrokenBrain", str, Message], list[tuple[str, object]]]

pytestmark = pytest.mark.nightly(keep=15)


COMMANDS = {"cmd/waypoints", "cmd/external"}
KEYS = {key.path: key for key in (keys.HELLO, keys.GRANT, keys.HEARTBEAT, keys.WAYPOINTS,
                                  keys.EXTERNAL)}  # fmt: skip
JUNK = (
    b"", b"null", b"[]", b"{}", b"{", b'{"v_mps":', b"\x00" * 64, b"\xff\xfe" * 32, b"[" * 3000,
    b'{"a":' * 600, b"1e400", b'"\\ud800"', b"9" * 4000,
)  # fmt: skip
DRIVES_MPS = 0.15
"""In a hall whose walls no lidar sees the bridge lets no robot go faster than 0.2 m/s."""
STANDS_S = 1.6
"""A path is followed for 0.5 s after its last word; the ramp with lag and jerk takes 0.85 s."""
BROKEN_S = 2.1
AGAIN_S = 9.0


class BrokenBrain(ConstantDrive):
    """Drive straight on, and let what is said be broken."""

    def __init__(self, world: LockstepWorld, kind: Kind) -> None:
        super().__init__(world)
        self.kind = kind
        self.breaker: Breaker | None = None
        self.before: deque[tuple[str, Message]] = deque(maxlen=80)
        """What was said while all was well."""
        self.kept: list[tuple[str, object]] = []
        self.mission, self.v_mps = "m", 0.4

    def _horizon(self, status: Status) -> None:
        if self.kind != "external":
            super()._horizon(status)
            return
        self.seq += 1
        self._say("cmd/external", Velocity(
            source_id=self.id, epoch=status.epoch, seq=self.seq, seen=status.seq,
            v_mps=self.v_mps, w_radps=0.0, dead_man=True,
        ))  # fmt: skip

    def _say(self, path: str, message: Record) -> None:
        whole = json.loads(encode(message))
        said: list[tuple[str, object]] = [(path, whole)]
        if self.breaker is None:
            self.before.append((path, whole))
        else:
            said = self.breaker(self, path, whole)
        for to, what in said:
            payload = what if isinstance(what, bytes) else json.dumps(what).encode()
            self._world.bus.send(Party.PLANNER, cast("Key[Record]", KEYS[to]), payload)


def commands(change: Callable[[BrokenBrain, Message], object]) -> Breaker:
    """Return a breaker of velocities and horizons alone; the rest is said as it is."""
    return lambda brain, path, message: [
        (path, change(brain, message) if path in COMMANDS else message)
    ]


def truncate(brain: BrokenBrain, message: Message) -> bytes:
    whole = json.dumps(message).encode()
    return whole[: brain.random.randrange(1, len(whole))]


def flip_bits(brain: BrokenBrain, message: Message) -> bytes:
    whole = bytearray(json.dumps(message).encode())
    for _ in range(brain.random.choice((1, 1, 2, 8))):
        whole[brain.random.randrange(len(whole))] ^= 1 << brain.random.randrange(8)
    return bytes(whole)


def poison(_brain: BrokenBrain, message: Message) -> Message:
    if "points" in message:
        return message | {"points": [point | {"speed_mps": nan} for point in message["points"]]}
    return message | {"v_mps": nan}


def replay(brain: BrokenBrain, _path: str, _message: Message) -> list[tuple[str, object]]:
    brain.before.rotate(-1)
    return [brain.before[0]]


def renumber(brain: BrokenBrain, message: Message) -> Message:
    """Say an old command with a fresh number."""
    brain.before.rotate(-1)
    old = next(said for path, said in brain.before if path in COMMANDS)
    return old | {"seq": message["seq"]}


def claim(**changed: object) -> Breaker:
    """Return a breaker of whatever has these fields, in all that is said."""
    return lambda _brain, path, message: [
        (path, message | {name: new for name, new in changed.items() if name in message})
    ]


def look_ahead(_brain: BrokenBrain, path: str, message: Message) -> list[tuple[str, object]]:
    return [(path, message | {"seen": message["seen"] + 3000})]


def hold_seen(brain: BrokenBrain, path: str, message: Message) -> list[tuple[str, object]]:
    """Name one status for ever, whatever was heard since."""
    return [(path, message | {"seen": brain.before[-1][1]["seen"]})]


def keep_back(brain: BrokenBrain, path: str, message: Message) -> list[tuple[str, object]]:
    """Keep back a second's words, then say them at once, as a link does that was stuck."""
    brain.kept.append((path, message))
    if len(brain.kept) < 30:
        return []
    told, brain.kept = brain.kept, []
    return told


def move_aside(_brain: BrokenBrain, message: Message) -> Message:
    points = [p | {"x_m": p["x_m"] + 1.0, "y_m": p["y_m"] + 1.0} for p in message["points"]]
    return message | {"points": points}


def lead_both_ways(_brain: BrokenBrain, message: Message) -> Message:
    points = [
        point | {"speed_mps": point["speed_mps"] * (-1) ** number}
        for number, point in enumerate(message["points"])
    ]
    return message | {"points": points}


STANDS: dict[str, Breaker] = {
    "silent": lambda _brain, _path, _message: [],
    "junk": commands(lambda brain, _message: brain.random.choice(JUNK)),
    "truncated": commands(truncate),
    "a number that is none": commands(poison),
    "a field twice": commands(lambda _b, m: json.dumps(m).encode()[:-1] + b',"seq":1,"seq":-5}'),
    "a field that the schema has not": commands(lambda _b, m: m | {"override_safety": 1}),
    "replayed": replay,
    "renumbered": commands(renumber),
    "a status that was not said yet": look_ahead,
    "one status named for ever": hold_seen,
    "another epoch": claim(epoch="0" * 16),
    "another's name": claim(planner_id="somebody", source_id="somebody"),
    "kept back": keep_back,
}
HORIZONS: dict[str, Breaker] = {
    "beside the robot": commands(move_aside),
    "both ways": commands(lead_both_ways),
    "another map": claim(map_id="0123456789abcdef"),
}


class Stage:
    """Hold a robot in a bare hall, its brain, a person beside it, and who judges."""

    def __init__(self, folder: Path, kind: Kind) -> None:
        self.world = LockstepWorld(site=hall(folder), seed=1)
        self.brain, self.person = BrokenBrain(self.world, kind), TrustingOperator(self.world)
        self.judge = Judge(self.world)
        self.moved_m = 0.0
        """In the last run."""

    def run(self, seconds: float) -> None:
        before_m = self.judge.metres
        for _ in range(round(seconds / TICK_S)):
            self.world.tick()
            self.brain.turn()
            self.person.turn()
            self.judge.look()
        self.moved_m = self.judge.metres - before_m

    def run_until_driving(self) -> None:
        for _ in range(round(AGAIN_S / TICK_S / 10)):
            self.run(10 * TICK_S)
            if self.world.twist.v_mps > DRIVES_MPS:
                return
        raise AssertionError(f"it does not drive: {self.world.describe()}")

    def fork(self) -> Stage:
        """Return a stage that goes on from here by itself, as ``fork_world`` does with a world."""
        scene = self.world.scene
        kept = (scene, scene.site, scene.router, scene.fence, self.world.sim.home)
        shared = (*kept, *self.world.commands, *self.world.statuses)
        return deepcopy(self, {id(one): one for one in shared})


@pytest.fixture(scope="module")
def driving(tmp_path_factory: pytest.TempPathFactory) -> Callable[[Kind], Stage]:
    """Give robots that drive well: each kind has driven off once."""
    stages: dict[Kind, Stage] = {}

    def lend(kind: Kind) -> Stage:
        if kind not in stages:
            stages[kind] = Stage(tmp_path_factory.mktemp("hall"), kind)
            stages[kind].run_until_driving()
            stages[kind].run(0.5)
        return stages[kind].fork()

    return lend


@pytest.mark.parametrize(
    ("kind", "fault"),
    [
        *((kind, fault) for kind in ("planner", "external") for fault in STANDS),
        *(("planner", fault) for fault in HORIZONS),
    ],
)
def test_the_robot_stands_and_drives_again_when_its_brain_is_mended(
    kind: Kind, fault: str, driving: Callable[[Kind], Stage]
) -> None:
    stage = driving(kind)
    stage.brain.breaker = {**STANDS, **HORIZONS}[fault]
    stage.run(STANDS_S)
    assert abs(stage.world.twist.v_mps) < 0.02
    stage.run(BROKEN_S - STANDS_S)
    assert stage.moved_m < 0.01
    stage.brain.breaker = None
    stage.run_until_driving()
    assert dict(stage.judge.broken) == {}


@pytest.mark.parametrize("kind", ["planner", "external"])
def test_flipped_bits_break_no_law(kind: Kind, driving: Callable[[Kind], Stage]) -> None:
    stage = driving(kind)
    stage.brain.breaker = commands(flip_bits)
    stage.run(BROKEN_S)
    stage.brain.breaker = None
    stage.run_until_driving()
    assert dict(stage.judge.broken) == {}


PENS = (
    ((1.2, 6.2), (2.8, 6.2), (2.8, 7.8), (1.2, 7.8)),
    ((6.0, 6.0), (8.0, 6.0), (8.0, 8.0), (6.0, 8.0)),
)
"""Where the robot begins, and where the hall's one place is."""


@pytest.mark.parametrize("seed", range(6))
def test_a_hostile_planner_breaks_no_law(seed: int) -> None:
    told = attack(seed, 8.0)
    assert told["broken"] == {}
    assert told["metres"] > 0.02, "or nothing was tried"


@pytest.mark.parametrize("seed", [0, 3, 4])
def test_a_hostile_external_brain_breaks_no_law_where_localization_falls_silent(
    seed: int, tmp_path: Path
) -> None:
    site = hall(tmp_path)
    fence = json.loads((site / "fence.json").read_text("utf-8"))
    (site / "fence.json").write_text(json.dumps({**fence, "allowed": PENS}), "utf-8")
    world = LockstepWorld(site=site, seed=seed + 1)
    hostile, person, judge = (
        HostilePlanner(world, seed, "external"),
        TrustingOperator(world),
        Judge(world),
    )
    hostile.metres = 60.0
    lost = 0
    for _ in range(2000):
        world.tick()
        hostile.turn()
        person.turn()
        judge.look()
        lost += "POSE_LOST.0" in world.bridge.state.rows
    assert dict(judge.broken) == {}
    assert judge.metres > 0.3, "or nothing was tried"
    assert lost > 200


SITES = 5


def site_of(seed: int, folder: Path) -> Path | str:
    """Return one of the five homes."""
    which = seed % SITES
    return ("home", "two_room")[which] if which < 2 else made_home(folder, which)


def attack(seed: int, run_s: float) -> dict[str, Any]:
    """Run one script; return what broke, how far it drove and how long it was in each mode."""
    with TemporaryDirectory(prefix="pb-") as folder:
        world = LockstepWorld(site=site_of(seed, Path(folder)), seed=seed + 1)
        hostile, person, judge = HostilePlanner(world, seed), TrustingOperator(world), Judge(world)
        for _ in range(round(run_s * 100)):
            world.tick()
            hostile.turn()
            person.turn()
            judge.look()
    return {
        "broken": dict(judge.broken),
        "metres": round(judge.metres, 3),
        "modes": dict(judge.modes),
        "lives": hostile.lives,
    }
