"""Carry messages between processes. The only file that knows zenoh.

Each door (wire.doors) is a session of its own, in the process that listens there and in each that
dials it, and nobody relays: access control lets a session take and give its door's keys alone, so
that not even a stranger in zenoh's client mode has its words passed on. Multicast and gossip are
off. Dialling is retried for ever; a missing peer is no error. Every subscriber has a ring that
drops the oldest, because the default handler blocks the whole session when nobody drains it.
Publishing never waits: a frozen peer loses messages, the sender no time.
"""

from __future__ import annotations

import json
import os
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import zenoh

from wire.base import Record
from wire.codec import decode, encode
from wire.doors import access_control, doors_of
from wire.errors import ConfigError, Unwritable
from wire.image_transport import ImagePublisher, ImageSubscriber
from wire.keys import ANY_ROBOT, IMAGE, Key, Party
from wire.sockets import Claim, Endpoints, admit

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path
    from types import TracebackType
    from typing import Self

    from wire.doors import Door
    from wire.errors import DecodeFailure
    from wire.sensors import ImageHeader

M = TypeVar("M", bound=Record)

MANY = frozenset({Party.OPERATOR, Party.JUDGE})
"""Processes that may be many at once. They take no lock: to stop the robot must need neither a disk
that can be written nor a file that another user may have made first."""

_RUNTIME = "(net: (handover: rx), acc: (handover: rx))"
"""zenoh reads a socket in the thread that takes its messages: 3.7 instead of 5.2 % of a core in a
driving bridge. What is sent keeps a thread apart from a flood of what is received (ADR 0032)."""
_PARSED_PER_DRAIN = 4
"""At most so many newest messages of a key are worth parsing in one tick."""


class Publisher(Generic[M]):
    """Send one kind of message. Never blocks, never raises for an absent or frozen peer."""

    def __init__(self, sessions: Iterable[zenoh.Session], key: Key[M], robot_id: str) -> None:
        """Declare it at every door where it may be said."""
        self._publishers = tuple(
            session.declare_publisher(
                key.expression(robot_id),
                congestion_control=zenoh.CongestionControl.DROP,
                express=True,
            )
            for session in sessions
        )

    def put(self, message: M) -> None:
        """Send and forget."""
        self.put_bytes(encode(message))

    def put_bytes(self, payload: bytes) -> None:
        """Send bytes as they are, unchecked."""
        for publisher in self._publishers:
            publisher.put(payload)


class Subscriber(Generic[M]):
    """Hold the newest messages of one key until they are drained."""

    def __init__(self, session: zenoh.Session, key: Key[M], robot_id: str) -> None:
        self._key = key
        self._subscriber = session.declare_subscriber(
            key.expression(robot_id), zenoh.handlers.RingChannel(key.ring)
        )

    def drain_bytes(self) -> list[bytes]:
        """Return the waiting payloads, one ring at most, oldest first, unparsed."""
        payloads: list[bytes] = []
        try:  # in here, not in a function: the bridge asks eighteen silent keys in every tick
            for _ in range(self._key.ring):  # not until empty: a flood refills it meanwhile
                sample = self._subscriber.try_recv()
                if sample is None:
                    break
                payloads.append(sample.payload.to_bytes())
        except zenoh.ZError:
            return payloads  # the session is closed: nothing more will ever come
        return payloads

    def drain(self) -> Arrivals[M]:
        """Take all waiting payloads and parse at most the 4 newest, in order of arrival."""
        payloads = self.drain_bytes()
        if not payloads:  # most keys, in most ticks
            return _NOTHING
        return Arrivals(
            tuple(decode(self._key, raw) for raw in payloads[-_PARSED_PER_DRAIN:]), len(payloads)
        )

    def newest(self) -> M | None:
        """Take all waiting payloads and return the newest valid message."""
        for raw in reversed(self.drain_bytes()[-_PARSED_PER_DRAIN:]):
            item = decode(self._key, raw)
            if isinstance(item, self._key.message):
                return item
        return None


class Subscribers(Subscriber[M]):
    """Hold the newest messages of one key that comes in at several doors."""

    def __init__(self, sessions: Iterable[zenoh.Session], key: Key[M], robot_id: str) -> None:
        self._key = key
        self._each = tuple(Subscriber(session, key, robot_id) for session in sessions)

    def drain_bytes(self) -> list[bytes]:
        """Return the waiting payloads, one ring of each door at most, unparsed."""
        payloads: list[bytes] = []
        for one in self._each:
            payloads += one.drain_bytes()
        return payloads

    def drain(self) -> Arrivals[M]:
        """Take all waiting payloads and parse at most the 4 newest of each door.

        Of all doors together, those who say much at one would hide what another says.
        """
        drained = [one.drain() for one in self._each]
        return Arrivals(
            tuple(item for arrivals in drained for item in arrivals.items),
            sum(arrivals.arrived for arrivals in drained),
        )


class Arrivals(Generic[M]):
    """Hold one drain's parsed messages and refusals, and how many payloads arrived."""

    __slots__ = ("arrived", "items")

    def __init__(self, items: tuple[M | DecodeFailure, ...], arrived: int) -> None:
        self.items = items
        self.arrived = arrived


_NOTHING: Arrivals[Any] = Arrivals((), 0)


class Session:
    """Hold one process's zenoh sessions: those where it listens and those that it dials."""

    def __init__(
        self,
        party: Party,
        robot_id: str,
        links: dict[Door, zenoh.Session],
        claim: Claim | None,
    ) -> None:
        self._party = party
        self._robot_id = robot_id
        self._links = links
        self._claim = claim

    def publisher(self, key: Key[M]) -> Publisher[M]:
        """Declare that this process says ``key``."""
        return Publisher(self.links_outward(key), key, self._robot_id)

    def subscriber(self, key: Key[M]) -> Subscriber[M]:
        """Declare that this process hears ``key``."""
        return self._subscriber(key, self._robot_id)

    def subscriber_to_any_robot(self, key: Key[M]) -> Subscriber[M]:
        """Declare that this process hears ``key`` of whichever robot speaks."""
        return self._subscriber(key, ANY_ROBOT)

    def image_publisher(self, key: Key[ImageHeader]) -> ImagePublisher:
        """Declare that this process says the pictures of ``key``."""
        (link,) = self.links_outward(key)
        return ImagePublisher(link, key, self._robot_id)

    def image_subscriber(self, key: Key[ImageHeader]) -> ImageSubscriber:
        """Declare that this process hears the pictures of ``key``."""
        (link,) = self.links_inward(key)
        return ImageSubscriber(link, key, self._robot_id)

    def links_outward(self, key: Key[M]) -> list[zenoh.Session]:
        """Return the zenoh sessions on which this process may say a key.

        Raises:
            ValueError: no door of this process carries it.
        """
        links = [link for door, link in self._links.items() if door.outward(self._party, key.path)]
        return self._require_links(key, links)

    def links_inward(self, key: Key[M]) -> list[zenoh.Session]:
        """Return the zenoh sessions on which this process is told a key.

        Raises:
            ValueError: no door of this process carries it.
        """
        links = [link for door, link in self._links.items() if door.inward(self._party, key.path)]
        return self._require_links(key, links)

    def peers(self) -> int:
        """Return how many connections to other processes there are now, at all doors together."""
        return sum(len(link.info.peers_zid()) for link in self._links.values())

    def close(self) -> None:
        """Leave; every ring is empty from now on."""
        for link in self._links.values():
            link.close()  # type: ignore[no-untyped-call]  # its stub has no annotation
        if self._claim is not None:
            self._claim.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _subscriber(self, key: Key[M], robot_id: str) -> Subscriber[M]:
        links = self.links_inward(key)
        if len(links) == 1:
            return Subscriber(links[0], key, robot_id)
        return Subscribers(links, key, robot_id)

    def _require_links(self, key: Key[M], links: list[zenoh.Session]) -> list[zenoh.Session]:
        if not links:
            names = ", ".join(door.name for door in self._links)
            raise ValueError(f"{key.path} passes none of the {self._party} doors: {names}")
        return links


def open_session(
    party: Party, robot_id: str, home: Path, endpoints: Endpoints | None = None
) -> Session:
    """Join the others of ``home``. Operators and judges may be many: they leave nothing there.

    Args:
        party: as which process.
        robot_id: whose keys; ``ANY_ROBOT`` says and hears those of whichever robot is there.
        home: where the sockets are.
        endpoints: where doors are, if not all in ``home``.

    Raises:
        ConfigError: the same process already runs there, a socket path is too long, or others
            could replace its sockets.
        Unwritable: the folders of ``home`` can't be written at present.
    """
    os.environ.setdefault("ZENOH_RUNTIME", _RUNTIME)  # zenoh reads it once, at the first session
    where = endpoints or Endpoints(home)
    with ExitStack() as undo:
        claim = None if party in MANY else Claim(home, party)
        if claim is not None:
            undo.callback(claim.close)
        links: dict[Door, zenoh.Session] = {}
        for door in doors_of(party):
            links[door] = _open(party, door, where, claim)
            undo.callback(links[door].close)
        undo.pop_all()
    return Session(party, robot_id, links, claim)


def _open(party: Party, door: Door, where: Endpoints, claim: Claim | None) -> zenoh.Session:
    """Listen at a door or dial it."""
    locator, path = where.locator(door), where.socket(door)
    listens = party is door.listener
    ours = listens and claim is not None and door not in where.tcp
    if ours and claim is not None:
        claim.make_way(path)
    try:
        session = zenoh.open(_config(locator, door, listens=listens))
    except zenoh.ZError as error:
        wrong = Unwritable if ours else ConfigError  # ours lies free: only the disk refuses it
        raise wrong("socket_in_use", f"{door.name}: {error}") from None
    if ours:
        admit(path)
    return session


def _config(locator: str, door: Door, *, listens: bool) -> zenoh.Config:
    hears, says = (door.hears, door.says) if listens else (door.says, door.hears)
    retry = {"period_init_ms": 50, "period_max_ms": 500, "period_increase_factor": 2}
    settings: dict[str, object] = {
        "mode": "peer",
        "listen/endpoints": [locator] if listens else [],
        "connect/endpoints": [] if listens else [locator],
        "connect/timeout_ms": -1,  # never give up
        "connect/exit_on_failure": False,
        "connect/retry": retry,
        "open/return_conditions/connect_scouted": False,  # nobody is scouted: open at once
        "scouting/delay": 0,
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        "transport/link/tx/queue/congestion_control/drop/wait_before_drop": 0,
        # A tick says several things at once, each its own batch; with the default of 2 batches and
        # no waiting, what came third was lost nearly always (2 to 23 of 100 arrived; with 16: all).
        "transport/link/tx/queue/size/data": 16,
        "transport/link/rx/max_message_size": 2 * IMAGE,  # the default is 1 GiB
        "transport/shared_memory/enabled": False,
        "access_control": access_control(hears, says),
    }
    config = zenoh.Config()
    for path, value in settings.items():
        config.insert_json5(path, json.dumps(value))
    return config
