"""Ask for rights of others: another's robot, an old epoch, endless budgets, a held robot."""

from __future__ import annotations

import json
import time
from math import cos, inf, nan, sin
from typing import TYPE_CHECKING

from pons.conformance.driver import mute, pack
from pons.conformance.fault import (
    AT_ONCE_S,
    SILENT,
    STALE,
    VELOCITY_S,
    Fault,
    W,
    X,
    commands,
    everything,
    spoil,
)
from pons.conformance.reference_client import ReferenceBrain, number
from wire import MAX_POINTS, PROTOCOL

if TYPE_CHECKING:
    from collections.abc import Callable

    from pons.conformance.driver import Breaker, Sent
    from pons.conformance.fault import Message
    from pons.conformance.fault_context import FaultContext
    from pons.conformance.reference_client import Said
    from wire import Status

REST_S = 0.6
"""Watched for so long: what would move it, would at once."""
PULSE_S = 0.05
SMALL_M = 0.3
SPENT_S = 1.4
"""In which 0.3 m are driven even from rest."""
WANTED = (0.4, 0.0)
WALL_STEP_M = 0.2
HAND = "kit-hand"


def _old_epoch(_stage: FaultContext) -> Breaker:
    def before(message: Message, status: Status) -> object:
        boot, _, counter = status.epoch.rpartition("-")
        return message | ({"epoch": f"{boot}-{max(0, int(counter) - 1)}"})

    return everything(before)


def _other_owner(_stage: FaultContext) -> Breaker:
    def rename(message: Message, _status: Status) -> object:
        field = "source_id" if "source_id" in message else "planner_id"
        return message | {field: "intruder"}

    return everything(rename)


def eager(stage: FaultContext, brain: ReferenceBrain, status: Status) -> list[Said]:
    """Return all that a brain could say to be driven, whether or not it may."""
    said = [brain.heartbeat(status), brain.grant(status)]
    seq = number(time.monotonic())
    if stage.external:
        return [*said, brain.velocity(status, seq, *WANTED)]
    pose = status.base_in_map
    points = brain.points(brain.track.along(pose)[0]) if pose is not None else []
    return [*said, brain.waypoints(status, seq, points)]


def pushing(
    change: Callable[[str, Message, Status], Message], *, hello: bool = False
) -> Callable[[FaultContext], None]:
    """Return the play of a resting owner who says everything that could move the robot, changed."""

    def play(stage: FaultContext) -> None:
        stage.rest()
        stage.brain.new_mission()

        def breaker(_said: list[Said], status: Status) -> list[Sent]:
            said = eager(stage, stage.brain, status)
            if hello:
                said = [stage.brain.hello(status), *said]
            return [(key, pack(change(key, message, status))) for key, message in said]

        if hello:
            stage.driver.breaker = mute
            stage.until(lambda: stage.status.owner is None, "the owner is forgotten")
        stage.begin(breaker)
        stage.wait(REST_S)

    return play


def _budget(*values: tuple[float, float]) -> Callable[[str, Message, Status], Message]:
    def change(key: str, message: Message, status: Status) -> Message:
        metres, seconds = values[status.seq % len(values)]
        more = {"metres": metres, "seconds": seconds} if key == "cmd/grant" else {}
        return message | more

    return change


def _believing(**wrong: object) -> Callable[[str, Message, Status], Message]:
    return lambda key, message, _status: message | (wrong if key == "cmd/hello" else {})


def _two_brains(stage: FaultContext) -> None:
    """Let a second brain claim everything beside a live owner that asks for nothing."""
    stage.rest()
    other = ReferenceBrain(stage.brain.kind, "intruder", stage.brain.track)

    def breaker(said: list[Said], status: Status) -> list[Sent]:
        claimed = [other.hello(status), *eager(stage, other, status)]
        return [(key, pack(message)) for key, message in (*said, *claimed)]

    stage.begin(breaker)
    stage.wait(REST_S)


def _spend(stage: FaultContext) -> None:
    """Ask for little, and again and again for the same mission."""
    stage.rest()
    stage.brain.metres = SMALL_M
    stage.brain.new_mission()
    stage.brain.asks = True
    stage.until(stage.moves, "driving on a small grant")

    def insisting(said: list[Said], status: Status) -> list[Sent]:
        more = stage.brain.grant(status)[1] | {"metres": 60.0}
        return [(key, pack(message)) for key, message in (*said, ("cmd/grant", more))]

    stage.begin(insisting)
    stage.until_standing()
    stage.wait(0.5)


def _after_stop(stage: FaultContext) -> None:
    """Go on in the new epoch as if nobody had said stop."""

    def breaker(_said: list[Said], status: Status) -> list[Sent]:
        said = [stage.brain.hello(status), *eager(stage, stage.brain, status)]
        return [(key, pack(message)) for key, message in said]

    stage.begin(breaker)
    stage.stop(stage.new_id())
    stage.until_standing()
    stage.wait(0.4)


def _stopped_while_driving(
    say: Callable[[FaultContext, str], None],
) -> Callable[[FaultContext], None]:
    """Return the play of a brain that drives on after a stop that others might pass by."""

    def play(stage: FaultContext) -> None:
        known = stage.new_id()
        stage.rest(known)
        stage.brain.new_mission()
        stage.brain.asks = True
        stage.until(stage.moves, "driving again after a resume")
        stage.begin()
        say(stage, known)
        stage.until_standing()

    return play


def _forge_proof(stage: FaultContext) -> None:
    """Clear a stop with no proof, a wrong one, and one that was used."""
    stage.rest()
    used = json.loads(stage.adapter.operate("resume"))
    stage.wait(0.2)
    stage.stop(stage.new_id())
    stage.until(lambda: stage.status.held is not None, "held")

    def breaker(_said: list[Said], status: Status) -> list[Sent]:
        wrong = {"nonce": status.nonce, "mac": f"{stage.chance.getrandbits(256):064x}"}
        fresh = f"kit-{stage.chance.getrandbits(48):x}"
        tried = [
            used, used | {"id": fresh}, {"id": f"{fresh}a", "source": "intruder"},
            {"id": f"{fresh}b", "source": "intruder", "proof": wrong},
        ]  # fmt: skip
        asked = [(f"op/{kind}", one) for kind in ("resume", "arm") for one in tried]
        said = [*asked, *eager(stage, stage.brain, status)]
        return [(key, pack(message)) for key, message in said]

    stage.begin(breaker)
    stage.wait(REST_S)


def _hand(stage: FaultContext, v_mps: float, *, dead_man: bool) -> None:
    status = stage.status
    message = {
        "source_id": HAND, "epoch": status.epoch, "seq": number(time.monotonic()),
        "seen": status.seq, "v_mps": v_mps, "w_radps": 0.0, "dead_man": dead_man,
    }  # fmt: skip
    stage.adapter.say("cmd/teleop", pack(message))
    stage.wait(PULSE_S)


def _no_dead_man(stage: FaultContext) -> None:
    stage.rest()
    stage.begin()
    for _ in range(12):
        _hand(stage, 0.5, dead_man=False)


def _held_from_the_start(stage: FaultContext) -> None:
    """Hold the dead-man without ever having shown it released."""
    stage.rest()
    stage.begin()
    for _ in range(12):
        _hand(stage, 0.5, dead_man=True)


def _hand_gone(stage: FaultContext) -> None:
    """Steer by hand as one should, then vanish with the dead-man held."""
    stage.rest()
    for _ in range(4):
        _hand(stage, 0.0, dead_man=False)
    way = 0.4 if stage.brain.heading > 0 else -0.4

    def drives() -> bool:
        _hand(stage, way, dead_man=True)
        return stage.moves()

    stage.until(drives, "driving by hand")
    stage.begin()
    stage.until_standing()


def _off_the_path(shift: Callable[[Message, int], Message]) -> Callable[[FaultContext], Breaker]:
    def make(_stage: FaultContext) -> Breaker:
        def change(message: Message, _status: Status) -> object:
            points = [shift(dict(point), n) for n, point in enumerate(message["points"])]
            return message | {"points": points}

        return commands(change)

    return make


def _through_walls(stage: FaultContext) -> Breaker:
    """Lead straight off to the left, farther than any site is wide."""
    heading_rad = stage.brain.track.heading_rad
    dx, dy = -sin(heading_rad) * WALL_STEP_M, cos(heading_rad) * WALL_STEP_M

    def change(message: Message, status: Status) -> object:
        at = status.base_in_map
        if at is None:
            return message
        points = [
            {"x_m": at.x_m + dx * n, "y_m": at.y_m + dy * n, "speed_mps": WANTED[0]}
            for n in range(1, MAX_POINTS + 1)
        ]
        return message | {"points": points}

    return commands(change)


def _wrong_map(_stage: FaultContext) -> Breaker:
    return commands(lambda message, _status: message | {"map_id": "0123456789abcdef"})


FAULTS = (
    Fault("old_epoch", "all of the epoch before", spoil(_old_epoch), SILENT, quick=(X,)),
    Fault("other_owner", "all in another's name", spoil(_other_owner), SILENT),
    Fault("two_brains", "a second brain claims and commands beside a live owner", _two_brains, {},
          rest=True, quick=(W,)),
    Fault("wrong_robot", "a hello for another robot.toml",
          pushing(_believing(robot_hash="0123456789abcdef"), hello=True), {}, kinds=(X,),
          rest=True),
    Fault("wrong_map", "a hello for another map",
          pushing(_believing(map_id="0123456789abcdef"), hello=True), {}, kinds=(X,), rest=True),
    Fault("wrong_protocol", "a hello of another protocol",
          pushing(_believing(protocol=PROTOCOL + 1), hello=True), {}, kinds=(X,), rest=True),
    Fault("grant_for_ever", "a grant of 1e9 m, or s",
          pushing(_budget((1e9, 600.0), (60.0, 1e9), (inf, inf))), {}, rest=True, quick=(X,)),
    Fault("grant_negative", "a grant below zero, or of nothing",
          pushing(_budget((-5.0, 60.0), (5.0, -60.0), (0.0, 0.0))), {}, kinds=(X,), rest=True),
    Fault("grant_nan", "a grant of NaN", pushing(_budget((nan, 60.0), (5.0, nan))), {},
          kinds=(X,), rest=True),
    Fault("grant_spent", f"drives on when {SMALL_M} m are driven, and asks again", _spend,
          {X: SPENT_S, W: SPENT_S}),
    Fault("after_stop", "goes on as if nobody had said stop", _after_stop,
          {X: AT_ONCE_S, W: AT_ONCE_S}, quick=(W,)),
    Fault("known_stop", "drives on after a stop with a known id after a resume",
          _stopped_while_driving(lambda stage, known: stage.stop(known)),
          {X: AT_ONCE_S, W: AT_ONCE_S}, quick=(X,)),
    Fault("unreadable_stop", "drives on after a stop that can't be read",
          _stopped_while_driving(lambda stage, _: stage.adapter.say("cmd/stop", b"{}")),
          {X: AT_ONCE_S, W: AT_ONCE_S}),
    Fault("forged_resume", "clears a stop with no proof, a wrong one, a used one", _forge_proof, {},
          kinds=(X,), rest=True),
    Fault("no_dead_man", "teleop without its dead-man", _no_dead_man, {}, kinds=(X,), rest=True,
          quick=(X,)),
    Fault("never_released", "teleop whose dead-man was never seen released", _held_from_the_start,
          {}, kinds=(X,), rest=True),
    Fault("hand_gone", "teleop that falls silent, dead-man held", _hand_gone, {X: VELOCITY_S},
          kinds=(X,)),
    Fault("path_wrong_map", "horizons on another map", spoil(_wrong_map), STALE, kinds=(W,)),
    Fault("path_elsewhere", "horizons that begin 1 m beside the robot",
          spoil(_off_the_path(lambda p, _n: p | {"x_m": p["x_m"] + 1.0, "y_m": p["y_m"] + 1.0})),
          STALE, kinds=(W,)),
    Fault("path_through_walls", "horizons straight out of the fence", spoil(_through_walls),
          STALE, kinds=(W,)),
    Fault("path_both_ways", "horizons of both directions",
          spoil(_off_the_path(lambda p, n: p | {"speed_mps": p["speed_mps"] * (-1) ** n})),
          STALE, kinds=(W,)),
)  # fmt: skip
