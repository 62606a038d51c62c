"""What arrives is bounded, counted and sorted; what is hostile becomes a word in the inbox."""

from __future__ import annotations

import gc
import resource
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, cast

import pytest

from bridge.core import ON_TIME, ArrivedAt, Decision, Inbox, OperatorArrival, initial
from bridge.core.inbox import FenceArrival
from bridge.link import STOPS_KEPT, BridgeLink
from tests.bridge.ground import core_config
from tests.waiting import until
from tests.wire.examples import EXAMPLES, STATUS
from wire import (
    VIRTUAL_KEY,
    DecodeFailure,
    Event,
    FenceRequest,
    MarksRequest,
    Odometry,
    OpKind,
    OpRequest,
    Record,
    Stop,
    Waypoints,
    decode,
    encode,
    sign,
    sign_fence,
    sign_marks,
)
from wire.keys import (
    DISARM,
    ESTOP,
    EVENT,
    FENCE,
    KEYS,
    MARKS,
    ODOM,
    OPS,
    STOP,
    WAYPOINTS,
    Key,
    Party,
)
from wire.keys import STATUS as STATUS_KEY
from wire.session import Publisher, Session, open_session

NOT_THE_LINKS = {"drive/state", "trial/order"}
"""What the drive reads, and what set-up hears in the bridge's place."""
HEARD = [k for k in KEYS if Party.BRIDGE in k.receivers and k.path not in NOT_THE_LINKS]
CHANCE = "c" * 16
HOSTILE = (
    b"",
    b"{}",
    b"[]",
    b"null",
    b"\xff\xfe\x00",
    b'{"id":"x"',
    b'{"v_mps":1e999}',
    b'{"points":NaN}',
    b"[" * 3_000,
    b'{"id":' + b"9" * 2_000 + b"}",
    b"x" * 5_000,
    b"y" * 40_000,
)


@dataclass
class Ends:
    """Hold the bridge's link and, for each of its doors, somebody who may say what it hears."""

    link: BridgeLink
    others: tuple[Session, ...]
    is_repeat: Callable[[str, str], bool] = lambda _kind, _name: False

    @property
    def other(self) -> Session:
        """Return the one that asks."""
        return self.others[0]

    def who_says(self, key: Key[Any]) -> Session:
        for session in self.others:
            with suppress(ValueError):
                session.links_outward(key)
                return session
        raise LookupError(key.path)

    def mouth(self, key: Key[Any]) -> Publisher[Any]:
        return self.who_says(key).publisher(key)

    def drain(self) -> Inbox:
        return self.link.drain(
            (),
            ON_TIME,
            real_time=True,
            chance=CHANCE,
            is_repeat=self.is_repeat,
        )


@pytest.fixture
def home() -> Iterator[Path]:
    """Give a folder of a short name: a socket's path ends at 107 bytes."""
    with TemporaryDirectory(prefix="pl-") as folder:
        yield Path(folder)


@pytest.fixture
def ends(home: Path) -> Iterator[Ends]:
    with (
        open_session(Party.BRIDGE, "r1", home) as bridge,
        open_session(Party.OPERATOR, "r1", home) as operator,
        open_session(Party.LOCALIZATION, "r1", home) as localization,
        open_session(Party.BUTTON, "r1", home) as button,
        open_session(Party.ROBOT, "r1", home) as robot,
    ):
        link = BridgeLink(bridge, "r1", VIRTUAL_KEY)
        ends = Ends(link, (operator, localization, button, robot))
        until(lambda: bridge.peers() == len(ends.others))
        for other in ends.others:
            mouth = other.publisher(STOP)

            def heard(mouth: Publisher[Stop] = mouth) -> bool:
                mouth.put(Stop(id="hello", source="test"))
                return bool(ends.drain().stops)

            until(heard)
        yield ends


def gather(ends: Ends, key: Key[Any]) -> Inbox:
    """Wait until all that was said has arrived, then drain once: a connection keeps its order."""
    ears = ends.link._stop
    kept: list[bytes] = []
    mouth = ends.who_says(key).publisher(STOP)

    def passed() -> bool:
        mouth.put(Stop(id="last-word", source="test"))  # said once, it may drown in a flood
        kept.extend(ears.drain_bytes())
        return any(b'"last-word"' in payload for payload in kept)

    until(passed)
    return ends.drain()


def arrived(inbox: Inbox, key: Key[Any]) -> int:
    return sum(item.count for item in inbox.arrived if item.key == key.path)


@pytest.mark.parametrize("key", HEARD, ids=lambda key: key.path)
def test_every_key_is_heard(ends: Ends, key: Key[Record]) -> None:
    message = EXAMPLES[key.message]
    mouth = ends.mouth(key)
    texts = {FENCE: "FenceArrival(id='fence-1'", MARKS: "FenceArrival(id='marks-1'"}
    handed_on = texts.get(key, repr(message))

    def there() -> bool:
        mouth.put(message)
        return handed_on in repr(ends.drain())

    until(there)


def test_a_fence_goes_on_with_its_text_only_where_the_proof_binds_it(ends: Ends) -> None:
    mouth = ends.other.publisher(FENCE)
    robot_id = core_config().robot.id

    def arrives(request_id: str, proof_of: str) -> FenceArrival:
        proof = sign_fence(VIRTUAL_KEY, robot_id, "n", request_id, proof_of)
        request = FenceRequest(id=request_id, source="cli", fence="{} ", proof=proof)
        came: list[FenceArrival] = []

        def there() -> bool:
            mouth.put(request)
            # A copy of what was asked before may still be on its way.
            came.extend(fence for fence in ends.drain().fences if fence.id == request_id)
            return bool(came)

        until(there)
        return came[0]

    assert arrives("f1", "{} ") == FenceArrival("f1", "cli", "n", True, "{} ")
    assert arrives("f2", "{}") == FenceArrival("f2", "cli", "n", False, "")


def test_marks_go_on_with_their_text_only_where_the_proof_binds_it(ends: Ends) -> None:
    mouth, robot_id = ends.other.publisher(MARKS), core_config().robot.id
    right = sign_marks(VIRTUAL_KEY, robot_id, "n", "m1", "{} ")
    wrong = sign_fence(VIRTUAL_KEY, robot_id, "n", "m2", "{} ")
    came: dict[str, FenceArrival] = {}

    def there() -> bool:
        for request_id, proof in (("m1", right), ("m2", wrong), ("m3", None)):
            mouth.put(MarksRequest(id=request_id, source="cli", marks="{} ", proof=proof))
        came.update({each.id: each for each in ends.drain().marks})
        return len(came) == 3

    until(there)
    assert came["m1"] == FenceArrival("m1", "cli", "n", True, "{} ")
    assert came["m2"] == FenceArrival("m2", "cli", "n", False, "")
    assert came["m3"] == FenceArrival("m3", "cli", None, False, "")


@pytest.mark.parametrize("key", HEARD, ids=lambda key: key.path)
def test_hostile_bytes_become_a_rejection_or_a_stop_where_stops_are_said(
    ends: Ends, key: Key[Record]
) -> None:
    mouth = ends.mouth(key)
    gather(ends, key)
    for payload in HOSTILE:
        assert isinstance(decode(key, payload), DecodeFailure)
        mouth.put_bytes(payload)
        until(partial(refused, ends, key))


def refused(ends: Ends, key: Key[Any]) -> bool:
    """Say whether something was refused on that key; at most a stop may have come of it."""
    inbox = ends.drain()
    assert inbox == Inbox(
        stops=inbox.stops,
        ops=inbox.ops,
        rejected=inbox.rejected,
        arrived=inbox.arrived,
        real_time=True,
        recorder_ok=True,
        chance=CHANCE,
    )
    ours = {"hello", "last-word"}  # still on their way
    came = [("cmd/stop", stop.id, stop.source) for stop in inbox.stops if stop.id not in ours]
    came += [(f"op/{op.kind}", op.request.id, op.request.source) for op in inbox.ops]
    is_refused = any(item.key == key.path for item in inbox.rejected)
    halts = is_refused and key in (STOP, ESTOP, DISARM)
    assert came == ([(key.path, "unreadable", "unreadable")] if halts else [])
    return is_refused


def test_at_most_four_of_a_key_are_parsed_and_all_are_counted(ends: Ends) -> None:
    message = EXAMPLES[Waypoints]
    payloads = [encode(message.model_copy(update={"seq": seq})) for seq in range(40)]
    ends.link._waypoints.drain_bytes = lambda: payloads  # type: ignore[method-assign]  # all at once
    inbox = ends.drain()
    assert [item.seq for item in inbox.waypoints] == [36, 37, 38, 39]
    assert arrived(inbox, WAYPOINTS) == 40


def test_a_flood_is_bounded_by_the_ring(ends: Ends) -> None:
    mouth = ends.mouth(WAYPOINTS)
    for _ in range(1_000):
        mouth.put_bytes(b"{")
    inbox = gather(ends, WAYPOINTS)
    assert arrived(inbox, WAYPOINTS) <= WAYPOINTS.ring
    assert len(inbox.rejected) <= 4


def say_at_once(ends: Ends, kind: str, payloads: list[bytes]) -> list[str]:
    """Let these be what lies in the ring of a stop's key; return the ids that the core is told."""
    halts = {name: subscriber for name, _, subscriber in ends.link._halts}
    subscriber: Any = ends.link._stop if kind == "stop" else halts[cast("OpKind", kind)]
    subscriber.drain_bytes = lambda: payloads
    inbox = ends.drain()
    path = "cmd/stop" if kind == "stop" else f"op/{kind}"
    assert ArrivedAt(path, len(payloads)) in inbox.arrived
    assert len([item for item in inbox.rejected if item.key == path]) <= 1
    said = [op.request.id for op in inbox.ops] + [stop.id for stop in inbox.stops]
    return [name for name in said if name != "hello"]  # our own, still on its way


@pytest.mark.parametrize("kind", ["stop", "estop", "disarm"])
@pytest.mark.parametrize("place", [0, 1, 31, 63])
def test_one_readable_stop_among_unreadable_ones_is_seen(ends: Ends, place: int, kind: str) -> None:
    payloads = [b"{" * (500 + n) for n in range(STOP.ring)]
    payloads[place] = encode(Stop(id="real", source="test"))
    assert say_at_once(ends, kind, payloads) == ["real", "unreadable"]
    ends.is_repeat = lambda said, name: (said, name) == (kind, "unreadable")
    assert say_at_once(ends, kind, payloads) == ["real"], "obeyed once, not in every tick"


@pytest.mark.parametrize("kind", ["stop", "estop", "disarm"])
def test_a_stop_behind_many_that_have_their_verdict_is_seen(ends: Ends, kind: str) -> None:
    known = [encode(Stop(id=f"old{n % 6}", source="flood")) for n in range(STOP.ring - 1)]
    payloads = [encode(Stop(id="real", source="test")), *known]
    ends.is_repeat = lambda said, name: said == kind and name.startswith("old")
    assert say_at_once(ends, kind, payloads) == ["real"]


def test_different_stops_are_all_answered_up_to_four(ends: Ends) -> None:
    stops = [encode(Stop(id=f"s{n % 6}", source="test")) for n in range(30)]
    ends.link._stop.drain_bytes = lambda: stops  # type: ignore[method-assign]  # all at once
    inbox = ends.drain()
    assert [stop.id for stop in inbox.stops] == ["s2", "s3", "s4", "s5"]
    assert len(inbox.stops) == STOPS_KEPT
    assert ArrivedAt(STOP.path, 30) in inbox.arrived


@pytest.mark.parametrize("key", OPS, ids=lambda key: key.path)
def test_an_operator_request_is_authentic_only_for_its_own_kind(
    ends: Ends, key: Key[OpRequest]
) -> None:
    mouth = ends.other.publisher(key)
    kind: OpKind = key.path.removeprefix("op/")  # type: ignore[assignment]  # the keys' own names
    other: OpKind = "resume" if kind != "resume" else "reset"
    cases = {
        "good": sign(VIRTUAL_KEY, kind, "r1", "n1", "good"),
        "none": None,
        "kind": sign(VIRTUAL_KEY, other, "r1", "n1", "kind"),
        "robot": sign(VIRTUAL_KEY, kind, "r2", "n1", "robot"),
        "id": sign(VIRTUAL_KEY, kind, "r1", "n1", "good"),
        "key": sign(b"another key altogether", kind, "r1", "n1", "key"),
    }
    for name, proof in cases.items():
        request = OpRequest(id=name, source="test", proof=proof)

        mouth.put(request)
        found: list[OperatorArrival] = []
        until(partial(collect, ends, found))
        assert found == [OperatorArrival(kind, request, authentic=name == "good")]


def collect(ends: Ends, found: list[OperatorArrival]) -> bool:
    found.extend(ends.drain().ops)
    return bool(found)


def test_a_decision_is_published(ends: Ends) -> None:
    status, odom, event = (ends.other.subscriber(key) for key in (STATUS_KEY, ODOM, EVENT))
    state = initial(core_config(), 1.0)
    said = EXAMPLES[Odometry], EXAMPLES[Event]
    decision = Decision(state, None, STATUS, said[0], (said[1], said[1]), ())  # type: ignore[arg-type]
    got: list[object] = []

    def all_heard() -> bool:
        ends.link.publish(decision)
        for ears in (status, odom, event):
            got.extend(ears.drain().items)
        return all(message in got for message in (STATUS, *said))

    until(all_heard)
    ends.link.publish(Decision(state, None, None, None, (), ()))  # silence is no message


def test_bad_messages_leave_no_memory_behind_without_the_collector(ends: Ends) -> None:
    """With gc off, one kept ValidationError per message was 135 MB per 100 000 messages."""
    bad = [payload for payload in HOSTILE if len(payload) < 500]
    subscribers = {
        WAYPOINTS.path: ends.link._waypoints, "cmd/teleop": ends.link._teleop,
        STOP.path: ends.link._stop,
    }  # fmt: skip
    for subscriber in subscribers.values():
        subscriber.drain_bytes = lambda: bad  # type: ignore[attr-defined]

    def flood(ticks: int) -> None:
        for _ in range(ticks):
            ends.drain()

    flood(200)
    gc.collect()
    gc.disable()
    try:
        before_kib = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        objects = len(gc.get_objects())
        flood(2_000)  # 30 000 bad messages, 14 000 of them parsed
        assert len(gc.get_objects()) - objects < 500
        grown_kib = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before_kib
    finally:
        gc.enable()
    assert grown_kib < 4_096
