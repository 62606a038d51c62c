"""Carry messages between processes. The only file that knows zenoh.

Every producer listens and nobody relays: bridge, robot and localization listen, the others dial
them. Multicast and gossip are off. Dialling is retried for ever; a missing peer is no error. Every
subscriber has a ring that drops the oldest, because the default handler blocks the whole session
when nobody drains it. Publishing never waits: a frozen peer loses messages, the sender no time.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import zenoh

from wire.base import Record
from wire.codec import Image, decode, encode, image
from wire.errors import Misconfigured
from wire.keys import ANY_ROBOT, IMAGE, Key, Party
from wire.sockets import DIALS, LISTENERS, Claim, Endpoints

if TYPE_CHECKING:
    from pathlib import Path
    from types import TracebackType
    from typing import Self

    from wire.errors import Rejected
    from wire.sensors import ImageHeader

M = TypeVar("M", bound=Record)

MANY = frozenset({Party.OPERATOR, Party.JUDGE})
"""Processes that may be many at once. They take no lock: who stops the robot must need neither a
disk that can be written nor a file that another user may have made first."""

_PARSED_PER_DRAIN = 4
"""At most so many newest messages of a key are worth parsing in one tick."""


class Publisher(Generic[M]):
    """Send one kind of message. Never blocks, never raises for an absent or frozen peer."""

    def __init__(self, session: zenoh.Session, key: Key[M], robot_id: str) -> None:
        self._publisher = session.declare_publisher(
            key.expression(robot_id),
            congestion_control=zenoh.CongestionControl.DROP,
            express=True,
        )

    def put(self, message: M) -> None:
        """Send and forget."""
        self._publisher.put(encode(message))


class ImagePublisher:
    """Send pictures: their bytes, with the header attached. Never blocks."""

    def __init__(self, session: zenoh.Session, key: Key[ImageHeader], robot_id: str) -> None:
        self._publisher = session.declare_publisher(
            key.expression(robot_id),
            congestion_control=zenoh.CongestionControl.DROP,
        )

    @property
    def wanted(self) -> bool:
        """Tell whether anybody listens."""
        status: Any = self._publisher.matching_status  # its stub says bool; it is a record
        return bool(status.matching)

    def put(self, header: ImageHeader, data: bytes) -> None:
        """Send and forget."""
        self._publisher.put(data, attachment=encode(header))


class ImageSubscriber:
    """Hold the newest picture of one key until somebody takes it."""

    def __init__(self, session: zenoh.Session, key: Key[ImageHeader], robot_id: str) -> None:
        self._key = key
        self._subscriber = session.declare_subscriber(
            key.expression(robot_id), zenoh.handlers.RingChannel(key.ring)
        )

    def newest(self) -> Image | Rejected | None:
        """Take the newest picture, or why it is none; None where none came."""
        try:
            sample = self._subscriber.try_recv()
        except zenoh.ZError:
            return None  # the session is closed
        if sample is None:
            return None
        attached = sample.attachment.to_bytes() if sample.attachment is not None else b""
        return image(self._key, attached, sample.payload.to_bytes())

    def close(self) -> None:
        """Hear no more: who says it learns that nobody listens."""
        self._subscriber.undeclare()  # type: ignore[no-untyped-call]  # its stub has no annotation


class Subscriber(Generic[M]):
    """Hold the newest messages of one key until somebody drains them."""

    def __init__(self, session: zenoh.Session, key: Key[M], robot_id: str) -> None:
        self._key = key
        self._subscriber = session.declare_subscriber(
            key.expression(robot_id), zenoh.handlers.RingChannel(key.ring)
        )

    def drain_bytes(self) -> list[bytes]:
        """Take what is waiting, one ring at most, oldest first, unparsed."""
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

    def drain(self) -> Drained[M]:
        """Take all that is waiting, parse at most the 4 newest, in order of arrival."""
        payloads = self.drain_bytes()
        if not payloads:  # most keys, in most ticks
            return _NOTHING
        return Drained(
            tuple(decode(self._key, raw) for raw in payloads[-_PARSED_PER_DRAIN:]), len(payloads)
        )

    def newest(self) -> M | None:
        """Take all that is waiting and return the newest that is a message."""
        for raw in reversed(self.drain_bytes()[-_PARSED_PER_DRAIN:]):
            item = decode(self._key, raw)
            if isinstance(item, self._key.message):
                return item
        return None


class Drained(Generic[M]):
    """Give what one drain took from a key: parsed items and how many arrived."""

    __slots__ = ("arrived", "items")

    def __init__(self, items: tuple[M | Rejected, ...], arrived: int) -> None:
        self.items = items
        self.arrived = arrived


_NOTHING: Drained[Any] = Drained((), 0)


class Session:
    """Be one process of the key table: listen where it must, dial whom it needs."""

    def __init__(self, zenoh_session: zenoh.Session, robot_id: str, claim: Claim | None) -> None:
        self._zenoh = zenoh_session
        self._robot_id = robot_id
        self._claim = claim

    def publisher(self, key: Key[M]) -> Publisher[M]:
        """Declare that this process says ``key``."""
        return Publisher(self._zenoh, key, self._robot_id)

    def subscriber(self, key: Key[M]) -> Subscriber[M]:
        """Declare that this process hears ``key``."""
        return Subscriber(self._zenoh, key, self._robot_id)

    def subscriber_to_any_robot(self, key: Key[M]) -> Subscriber[M]:
        """Declare that this process hears ``key`` of whichever robot speaks."""
        return Subscriber(self._zenoh, key, ANY_ROBOT)

    def image_publisher(self, key: Key[ImageHeader]) -> ImagePublisher:
        """Declare that this process says the pictures of ``key``."""
        return ImagePublisher(self._zenoh, key, self._robot_id)

    def image_subscriber(self, key: Key[ImageHeader]) -> ImageSubscriber:
        """Declare that this process hears the pictures of ``key``."""
        return ImageSubscriber(self._zenoh, key, self._robot_id)

    def peers(self) -> int:
        """Return how many processes are connected now."""
        return len(self._zenoh.info.peers_zid())

    def close(self) -> None:
        """Leave; every ring is empty from now on."""
        self._zenoh.close()  # type: ignore[no-untyped-call]  # its stub has no annotation
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


def open_session(
    party: Party, robot_id: str, home: Path, endpoints: Endpoints | None = None
) -> Session:
    """Join the others of ``home``. Operators and judges may be many: they leave nothing there.

    Args:
        party: as which process.
        robot_id: whose keys; ``ANY_ROBOT`` says and hears those of whichever robot is there.
        home: where the sockets are.
        endpoints: where listeners are, if not all in ``home``.

    Raises:
        Misconfigured: the same process already runs there, or a socket path is too long.
    """
    where = endpoints or Endpoints(home)
    claim = None if party in MANY else Claim(home, party)
    try:
        if claim is not None and party in LISTENERS and party not in where.tcp:
            claim.clear_stale(where.socket(party))
        return Session(zenoh.open(_config(party, where)), robot_id, claim)
    except zenoh.ZError as error:
        _give_back(claim)
        raise Misconfigured("socket_in_use", f"{party.value}: {error}") from None
    except Misconfigured:
        _give_back(claim)
        raise


def _give_back(claim: Claim | None) -> None:
    if claim is not None:
        claim.close()


def _config(party: Party, where: Endpoints) -> zenoh.Config:
    listens = [where.locator(party)] if party in LISTENERS else []
    dials = [where.locator(listener) for listener in DIALS[party]]
    retry = {"period_init_ms": 50, "period_max_ms": 500, "period_increase_factor": 2}
    settings: dict[str, object] = {
        "mode": "peer",
        "listen/endpoints": listens,
        "connect/endpoints": dials,
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
    }
    config = zenoh.Config()
    for path, value in settings.items():
        config.insert_json5(path, json.dumps(value))
    return config
