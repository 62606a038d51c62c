"""Be a planner that wants to break things and has every right that a planner has.

Hello, grants, heartbeats, horizons, a stick through the page, restarts, silence, floods, stops; all
in schema, most of it plausible, drawn by seed. It holds no operator's key: proofs that it makes are
wrong. A person beside it resumes and arms again, or nothing would ever move. As an external brain
it says velocities where a planner says horizons, and localization falls silent now and then, for
its velocities go on without a pose.
"""

from __future__ import annotations

from math import cos, pi, sin
from random import Random
from typing import TYPE_CHECKING, Literal, cast

from wire import (
    PROTOCOL,
    VIRTUAL_KEY,
    Grant,
    Heartbeat,
    Hello,
    OpKind,
    OpRequest,
    Pose2,
    Proof,
    Record,
    Status,
    Stop,
    Velocity,
    Waypoint,
    Waypoints,
    keys,
    signed_request,
)
from wire.keys import Party

if TYPE_CHECKING:
    from tools.lockstep.together import LockstepWorld
    from wire import Mode
    from wire.keys import Key

    Kind = Literal["planner", "external"]

MOODS = (
    "straight", "straight", "walls", "walls", "curves", "curves", "back", "stick", "wild", "silent",
    "nothing",
)  # fmt: skip
LAME = {"wild", "silent", "nothing"}
_PUSHES: dict[str, tuple[tuple[float, ...], tuple[float, ...]]] = {
    "curves": ((0.5, 0.3), (0.4, 0.4, -0.4)),
    "back": ((-0.5, -0.3), (0.0,)),
    "wild": ((5.0, 0.5, -5.0), (10.0, 0.0, -10.0)),
}
"""Speeds [m/s] and turns [rad/s] of an external brain; in other moods it goes straight on."""
_ASKS: dict[str, tuple[tuple[OpKind, ...], float]] = {
    "DISARMED": (("arm",), 0.5),
    "ESTOPPED": (("reset",), 3.0),
    "FAULT": (("reset",), 3.0),
}


class HostilePlanner:
    """Say a tick's worth of harm."""

    def __init__(self, world: LockstepWorld, seed: int, kind: Kind = "planner") -> None:
        world.kill_planner()
        self._world = world
        self.kind: Kind = kind
        self.random = Random(f"hostile {seed}")
        self._port = world.bus.port(Party.PLANNER)
        self._ears = self._port.subscriber(keys.STATUS)
        said = (
            keys.HELLO, keys.GRANT, keys.HEARTBEAT, keys.WAYPOINTS, keys.TELEOP, keys.EXTERNAL,
            keys.STOP, keys.ARM, keys.RESUME,
        )  # fmt: skip
        self._mouths = {key.path: self._port.publisher(cast("Key[Record]", key)) for key in said}
        self.status: Status | None = None
        self.old: list[tuple[str, Record]] = []
        self.lives = 0
        self.metres = 0.0
        """What each grant asks for; 0 lets chance choose, and lie at times."""
        self._begin()

    def _begin(self) -> None:
        """Be a new planner, or the same one again."""
        self.lives += 1
        self.id = f"h{self.random.choice((0, 0, self.lives))}"
        self.mood = "straight"
        self.until_s = 0.0
        self.seq = 0
        self.mission = f"m{self.lives}"
        self.leg = 1

    def turn(self) -> None:
        """Hear the newest status and say what comes to mind."""
        now_s, r = self._world.now_s, self.random
        status = self._ears.newest()
        if status is not None:
            self.status = status
        if self.status is None:
            return
        if now_s >= self.until_s:
            self.mood = r.choice(MOODS)
            self.until_s = now_s + r.choice((0.4, 1.0) if self.mood in LAME else (2.0, 3.0, 5.0))
            self._whim(self.status)
        if self.mood == "silent":
            return
        if status is not None:
            self._answer(status)
        tick = self._world.tick_count
        if self.mood == "stick":
            if tick % 5 == 0:
                self._stick(self.status)
        elif self.kind == "external":
            if tick % r.choice((5, 5, 5, 2)) == 0:
                self._velocity(self.status)
        elif tick % r.choice((10, 10, 10, 2)) == 0:
            self._horizon(self.status)

    def _say(self, path: str, message: Record) -> None:
        self._mouths[path].put(message)
        self.old = [*self.old[-40:], (path, message)]

    def _whim(self, status: Status) -> None:
        """Now and then: restart, another mission, a forged proof, a stop, something said before."""
        r, what = self.random, self.random.random()
        if self.kind == "external":
            self._world.silence_localization(silent=r.random() < 0.4)
        if what < 0.1:
            self._begin()
        elif what < 0.25:
            self.mission, self.leg = f"m{r.randrange(6)}", r.randrange(1, 5)
        elif what < 0.3:
            self._say("cmd/stop", Stop(id=f"s{r.randrange(10**6)}", source="hostile"))
        elif what < 0.4:
            kind: OpKind = r.choice(("arm", "resume"))
            proof = Proof(nonce=status.nonce, mac=f"{r.getrandbits(256):064x}")
            request = OpRequest(id=f"f{r.randrange(10**6)}", source="hostile", proof=proof)
            self._say(f"op/{kind}", request)
        elif what < 0.6 and self.old:
            for path, message in r.sample(self.old, min(8, len(self.old))):
                self._mouths[path].put(message)

    def _answer(self, status: Status) -> None:
        r = self.random
        owner = status.owner
        if owner is None or owner.planner_id != self.id:
            hello = Hello(
                planner_id=self.id,
                kind=self.kind,
                seen=status.seq,
                protocol=PROTOCOL,
                robot_hash=status.robot_hash,
                fence_hash=status.fence_hash,
                map_id=self._world.scene.site.map_id,
            )
            self._say("cmd/hello", hello)
            return
        used = status.seq if self.metres or r.random() < 0.97 else 0
        beat = Heartbeat(planner_id=self.id, epoch=status.epoch, seen=status.seq, used=used)
        self._say("cmd/heartbeat", beat)
        if status.grant is None or status.grant.mission != self.mission or r.random() < 0.02:
            grant = Grant(
                planner_id=self.id,
                epoch=status.epoch,
                seen=status.seq,
                mission=self.mission,
                metres=self.metres or r.choice((0.3, 1.0, 3.0, 60.0)),
                seconds=600.0 if self.metres else r.choice((1.0, 5.0, 600.0)),
            )
            self._say("cmd/grant", grant)

    def _stick(self, status: Status) -> None:
        r = self.random
        self.seq += 1
        held = (self._world.tick_count // 5) % 40 > 2  # let go, neutral, and pressed again
        velocity = Velocity(
            source_id=r.choice(("page", "page", "page", "joystick")),
            epoch=status.epoch,
            seq=self.seq,
            seen=status.seq,
            v_mps=r.choice((0.5, 0.3, -0.5, 5.0, -5.0)) if held else 0.0,
            w_radps=r.choice((0.0, 0.0, 1.0, -1.0, 10.0)) if held else 0.0,
            dead_man=held,
        )
        self._say("cmd/teleop", velocity)

    def _velocity(self, status: Status) -> None:
        """Push on, whether there is a pose or not, as fast as the wire lets anybody say."""
        r = self.random
        self.seq += 1
        speeds, turns = _PUSHES.get(self.mood, ((0.5, 0.3), (0.0,)))
        velocity = Velocity(
            source_id=self.id,
            epoch=status.epoch,
            seq=self.seq,
            seen=status.seq,
            v_mps=r.choice(speeds),
            w_radps=r.choice(turns),
            dead_man=self.mood != "nothing",
        )
        self._say("cmd/external", velocity)

    def _horizon(self, status: Status) -> None:
        here = status.base_in_map
        if here is None:
            return
        r = self.random
        self.seq += 1
        self.leg += r.random() < 0.05
        points = self._points(here)
        horizon = Waypoints(
            planner_id=self.id,
            epoch=status.epoch,
            seq=self.seq,
            seen=status.seq,
            mission=self.mission,
            leg=self.leg,
            map_id=self._world.scene.site.map_id,
            ttl_s=r.choice((0.5, 2.0)),
            points=points,
            final=r.random() < 0.2,
        )
        self._say("cmd/waypoints", horizon)

    def _points(self, here: Pose2) -> tuple[Waypoint, ...]:
        """Lead the robot on, as far and as fast as the wire lets anybody say."""
        r, mood = self.random, self.mood
        if mood == "nothing":
            return ()
        speed = r.choice((0.5, 0.5, 0.3)) if mood != "wild" else r.choice((0.5, 2.0, 0.05))
        heading = here.yaw_rad
        if mood == "walls":  # a steady way, whatever stands there
            heading = (self.lives * 2.4 + int(self.until_s)) % (2 * pi) - pi
        step, bend = 0.1, 0.0
        if mood == "curves":
            bend = r.choice((-0.2, 0.2)) if self.seq % 7 == 0 else 0.15
        elif mood == "back":
            step, speed = -0.1, -speed
        elif mood == "wild":
            step, bend = r.choice((0.05, 0.25)), r.uniform(-0.6, 0.6)
        made: list[Waypoint] = []
        x, y = here.x_m, here.y_m
        fence = self._world.scene.fence
        honest = r.random() < 0.93  # what leads through the fence is refused, and scored
        for _ in range(r.choice((12, 20, 30))):
            if honest and made and not fence.margin_m(x, y) > 0.03:
                break
            made.append(Waypoint(x_m=x, y_m=y, speed_mps=max(-2.0, min(2.0, speed))))
            heading += bend
            x, y = x + step * cos(heading), y + step * sin(heading)
        if r.random() < 0.1:
            made[-1] = made[-1].model_copy(update={"heading_rad": r.uniform(-3.0, 3.0)})
        return tuple(made)


class TrustingOperator:
    """Arm, reset and resume again and again, as a person who trusts the bridge."""

    def __init__(self, world: LockstepWorld) -> None:
        self._world = world
        port = world.bus.port(Party.OPERATOR)
        self._mouths = {
            "arm": port.publisher(keys.ARM),
            "reset": port.publisher(keys.RESET),
            "resume": port.publisher(keys.RESUME),
        }
        self._count = 0
        self._mode: Mode | None = None
        self._since_s = 0.0

    def turn(self) -> None:
        """Ask for what the mode needs, after a while in it."""
        status, now_s = self._world.status, self._world.now_s
        if status.mode is not self._mode:
            self._mode, self._since_s = status.mode, now_s
        kinds, after_s = _ASKS.get(status.mode.value, ((), 0.0))
        if status.held is not None and status.mode.value == "HOLD":
            kinds, after_s = ("resume",), 0.3
        if not kinds or now_s - self._since_s < after_s or self._world.tick_count % 20:
            return
        for kind in kinds:
            self._count += 1
            request_id = f"person-{self._count}"
            request = signed_request(VIRTUAL_KEY, kind, status, "person", request_id)
            self._mouths[kind].put(request)
