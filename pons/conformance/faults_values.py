"""Say things that are no message, or a message that asks for too much."""

from __future__ import annotations

from math import inf, nan
from typing import TYPE_CHECKING

from pons.conformance.driver import pack
from pons.conformance.fault import DRIVES_ON, STALE, Fault, W, X, commands, spoil

if TYPE_CHECKING:
    from collections.abc import Callable

    from pons.conformance.driver import Breaker, Sent
    from pons.conformance.fault import Message
    from pons.conformance.fault_context import FaultContext
    from wire import Status

HUGE_BYTES = (7_000_000, 10_000_000)
"""One that the transport still takes, and one that it does not."""
WALL_S = 10.0
"""In which the farthest wall is reached."""
JUNK = (
    b"", b"null", b"[]", b"{}", b"{", b'{"v_mps":', b"\x00" * 64, b"\xff\xfe" * 32, b"[" * 3000,
    b'{"a":' * 600, b"1e400", b'"\\ud800"', b"9" * 4000,
)  # fmt: skip


def poison_field(value: object) -> Callable[[FaultContext], Breaker]:
    """Put a value where a number belongs, another field each time."""

    def make(stage: FaultContext) -> Breaker:
        def change(message: Message, _status: Status) -> object:
            if stage.external:
                return message | {stage.chance.choice(("v_mps", "w_radps")): value}
            points = [dict(point) for point in message["points"]]
            if points:
                field = stage.chance.choice(("x_m", "y_m", "speed_mps"))
                stage.chance.choice(points)[field] = value
            return message | {"points": points or [{"x_m": value, "y_m": 0.0, "speed_mps": 0.4}]}

        return commands(change)

    return make


def _too_fast(_stage: FaultContext) -> Breaker:
    def change(message: Message, _status: Status) -> object:
        if "points" in message:
            return message | {"points": [p | {"speed_mps": 9.0} for p in message["points"]]}
        sign = 1.0 if message["v_mps"] >= 0.0 else -1.0
        return message | {"v_mps": 9.0 * sign, "w_radps": 4.0 * message["w_radps"]}

    return commands(change)


def _jerky(stage: FaultContext) -> Breaker:
    """Ask for full speed one way and the other in turn."""

    def change(message: Message, _status: Status) -> object:
        turn, way = stage.chance.choice((-19.0, 19.0)), stage.chance.choice((-9.0, 9.0))
        return message | {"v_mps": way, "w_radps": turn}

    return commands(change)


def _wrong_types(stage: FaultContext) -> Breaker:
    def change(message: Message, _status: Status) -> object:
        field, wrong = stage.chance.choice(
            [("epoch", 7), ("seen", "1"), ("seq", 1.5), ("seq", True), ("dead_man", 1),
             ("dead_man", "true"), ("v_mps", "0.4"), ("v_mps", None), ("w_radps", [0.1]),
             ("source_id", {"a": 1})]
            if stage.external
            else [("epoch", 7), ("seen", "1"), ("seq", 1.5), ("leg", True), ("ttl_s", "2"),
                  ("points", {}), ("points", "[]"), ("final", 0), ("mission", None)]
        )  # fmt: skip
        return message | {field: wrong}

    return commands(change)


def _junk(stage: FaultContext) -> Breaker:
    return commands(lambda _message, _status: stage.chance.choice(JUNK))


def _truncate(stage: FaultContext) -> Breaker:
    def change(message: Message, _status: Status) -> object:
        whole = pack(message)
        return whole[: stage.chance.randrange(1, len(whole))]

    return commands(change)


def _flip_bits(stage: FaultContext) -> Breaker:
    def change(message: Message, _status: Status) -> object:
        whole = bytearray(pack(message))
        for _ in range(stage.chance.choice((1, 1, 2, 8))):
            whole[stage.chance.randrange(len(whole))] ^= 1 << stage.chance.randrange(8)
        return bytes(whole)

    return commands(change)


def _unknown_field(stage: FaultContext) -> Breaker:
    extra = stage.chance.choice(("priority", "override_safety", "stamp_s"))
    return commands(lambda message, _status: message | {extra: 1})


def _twice_the_field(_stage: FaultContext) -> Breaker:
    """Say a field twice with two values: parsers differ in which one they take."""

    def change(message: Message, _status: Status) -> object:
        return pack(message)[:-1] + b',"seq":1,"seq":-5}'

    return commands(change)


def _huge(stage: FaultContext) -> None:
    """Say something enormous beside good commands."""
    left = list(HUGE_BYTES)
    whole = {size: b'{"v_mps":"' + b"x" * size + b'"}' for size in HUGE_BYTES}

    def breaker(said: list[tuple[str, Message]], _status: Status) -> list[Sent]:
        good = [(key, pack(message)) for key, message in said]
        return [*good, (stage.command_key, whole[left.pop()])] if left else good

    stage.begin(breaker)
    stage.wait(1.5)


def _into_the_wall(stage: FaultContext) -> None:
    """Drive on at full speed where the line turns back, until something keeps it from there."""
    way = 1.0 if stage.brain.heading > 0 else -1.0

    def change(message: Message, _status: Status) -> object:
        return message | {"v_mps": 0.5 * way, "w_radps": 0.0}

    stage.patience_s = WALL_S
    stage.begin(commands(change))
    stage.until_standing()


FAULTS = (
    Fault("nan", "NaN in a number's place", spoil(poison_field(nan)), STALE, quick=(X,)),
    Fault("infinity", "Infinity and -Infinity", spoil(poison_field(inf)), STALE),
    Fault("out_of_bounds", "numbers no robot has: 1e9", spoil(poison_field(-1e9)), STALE),
    Fault("too_fast", "9 m/s, four times the turn", spoil(_too_fast, stand=False), DRIVES_ON,
          kinds=(X,)),
    Fault("path_too_fast", "a horizon at 9 m/s", spoil(_too_fast), STALE, kinds=(W,)),
    Fault("jerky", "full speed and turn, to and fro at 20 Hz", spoil(_jerky, stand=False),
          DRIVES_ON, kinds=(X,), quick=(X,)),
    Fault("into_the_wall", "full speed at a wall: the lidar must stop it", _into_the_wall,
          {X: WALL_S}, kinds=(X,)),
    Fault("wrong_types", "strings, lists, truth values for numbers", spoil(_wrong_types), STALE),
    Fault("junk", "empty, not JSON, nested 3000 deep, not text", spoil(_junk), STALE),
    Fault("truncated", "each message cut at a random byte", spoil(_truncate), STALE),
    Fault("bit_flipped", "one to eight random bits of each message flipped",
          spoil(_flip_bits, stand=False), DRIVES_ON, quick=(W,)),
    Fault("unknown_field", "a field that the schema has not", spoil(_unknown_field), STALE),
    Fault("field_twice", "one field twice, the second out of bounds", spoil(_twice_the_field),
          STALE),
    Fault("huge", "a message of 7 MB and one of 10 MB beside good ones", _huge, DRIVES_ON),
)  # fmt: skip
