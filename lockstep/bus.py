"""Carry messages between parts on a simulated clock, as bytes, in the order they were sent.

The shape is that of ``wire.session``: a part's :class:`Port` gives publishers and subscribers, so
the real bridge link and the real planner bus run on it unchanged. Everything passes through
``encode`` and ``decode``; rings are as long as the key table says and drop the oldest. By seed each
way from a sender to a receiver has its own stream of chance. Knows no clock but ticks.
"""

from __future__ import annotations

from collections import deque
from random import Random
from typing import TYPE_CHECKING, Generic, TypeVar

from lockstep.disturbance import QUIET, Disturbance
from wire import DecodeFailure, Record, decode, encode
from wire.session import Arrivals

if TYPE_CHECKING:
    from wire.keys import Key, Party

M = TypeVar("M", bound=Record)

PARSED_PER_DRAIN = 4
"""As in ``wire.session``: of a key's backlog only the newest are worth parsing."""


class LockstepBus:
    """Join all parts of one world."""

    def __init__(self, seed: int, latency: dict[frozenset[Party], tuple[int, int]]) -> None:
        """Take the least and most ticks that a message is on its way, by pair of parties.

        Pairs that are not named deliver at once: whoever drains later in the same tick has it.
        """
        self.tick = 0
        self._seed = seed
        self._latency = latency
        self._subscribers: dict[str, list[PortSubscriber[Record]]] = {}
        self._listeners: dict[tuple[Party, str], tuple[Listener, ...]] = {}
        self._ways: dict[tuple[Party, Party], MessagePath] = {}
        self._disturbances: list[Disturbance] = []

    def port(self, party: Party) -> Port:
        """Return one part's end."""
        return Port(self, party)

    def disturb(self, disturbance: Disturbance) -> None:
        """Spoil what is sent from now on."""
        self._disturbances.append(disturbance)

    def calm(self) -> None:
        """Spoil nothing any more; what is on its way stays as it is."""
        self._disturbances.clear()

    def send(self, party: Party, key: Key[M], payload: bytes) -> None:
        """Put bytes on their way to everyone who hears the key."""
        listeners = self._listeners.get((party, key.path))
        if listeners is None:
            listeners = self._listeners[party, key.path] = self._hearing(party, key.path)
        spoiling = self._spoiling(party, key) if self._disturbances else QUIET
        for subscriber, way in listeners:
            for due in way.dues(self.tick, spoiling):
                subscriber.arrive(due, payload)

    def join(self, subscriber: PortSubscriber[M], path: str) -> None:
        """Add a listener."""
        self._listeners.clear()
        self._subscribers.setdefault(path, []).append(subscriber)  # type: ignore[arg-type]  # a subscriber only ever produces its M

    def leave(self, port: Port) -> None:
        """Forget the listeners of a part that is gone."""
        self._listeners.clear()
        for path, heard in self._subscribers.items():
            self._subscribers[path] = [one for one in heard if one.port is not port]

    def _hearing(self, sender: Party, path: str) -> tuple[Listener, ...]:
        """Return who hears a key that a party says, and how it gets there."""
        return tuple(
            (subscriber, self._way(sender, subscriber.party))
            for subscriber in self._subscribers.get(path, ())
            if subscriber.party is not sender
        )

    def _way(self, sender: Party, receiver: Party) -> MessagePath:
        way = self._ways.get((sender, receiver))
        if way is None:
            span = self._latency.get(frozenset({sender, receiver}), (0, 0))
            way = MessagePath(span, Random(f"{self._seed}:{sender}:{receiver}"))
            self._ways[sender, receiver] = way
        return way

    def _spoiling(self, sender: Party, key: Key[M]) -> Disturbance:
        """Return the newest disturbance that names this key and sender, or none."""
        fitting = (one for one in reversed(self._disturbances) if one.fits(sender, key.path))
        return next(fitting, QUIET)


class MessagePath:
    """Decide when each message from one party to another arrives; order is kept unless spoilt."""

    def __init__(self, span_ticks: tuple[int, int], chance: Random) -> None:
        self._span_ticks = span_ticks
        self._chance = chance
        self._newest_due = 0

    def dues(self, tick: int, spoiling: Disturbance) -> tuple[int, ...]:
        """Return the ticks at which copies of one message arrive; none if it is lost."""
        low, high = self._span_ticks
        due = tick + (self._chance.randint(low, high) if low < high else low)
        if spoiling is QUIET:
            if due > self._newest_due:
                self._newest_due = due
            return (self._newest_due,)
        due += self._chance.randint(*spoiling.delay_ticks)
        if self._chance.random() < spoiling.drop:
            return ()
        if not spoiling.reorder:
            due = self._newest_due = max(due, self._newest_due)
        twice = self._chance.random() < spoiling.duplicate
        return (due, due) if twice else (due,)


class Port:
    """Be one part's end of the bus, shaped like ``wire.session.Session``."""

    def __init__(self, bus: LockstepBus, party: Party) -> None:
        self.bus = bus
        self.party = party
        self.open = True

    def publisher(self, key: Key[M]) -> PortPublisher[M]:
        """Declare that this part says ``key``."""
        return PortPublisher(self, key)

    def subscriber(self, key: Key[M]) -> PortSubscriber[M]:
        """Declare that this part hears ``key``."""
        subscriber = PortSubscriber(self, key)
        self.bus.join(subscriber, key.path)
        return subscriber

    def close(self) -> None:
        """Leave, as a process that was killed: nothing is heard or said any more."""
        self.open = False
        self.bus.leave(self)


class PortPublisher(Generic[M]):
    """Send one kind of message."""

    def __init__(self, port: Port, key: Key[M]) -> None:
        self._port = port
        self._key = key

    def put(self, message: M) -> None:
        """Send and forget; a part that has left says nothing."""
        if self._port.open:
            self._port.bus.send(self._port.party, self._key, encode(message))


class PortSubscriber(Generic[M]):
    """Hold what is on its way to one part, and what waits there."""

    def __init__(self, port: Port, key: Key[M]) -> None:
        self.port = port
        self.party = port.party
        self._key = key
        self._coming: deque[tuple[int, bytes]] = deque()

    def arrive(self, due: int, payload: bytes) -> None:
        """Take bytes that will be here at a tick."""
        coming = self._coming
        overtaken = bool(coming) and coming[-1][0] > due  # by another party, or on a spoilt way
        coming.append((due, payload))
        if overtaken:
            self._coming = deque(sorted(coming, key=lambda item: item[0]))

    def drain_bytes(self) -> list[bytes]:
        """Take all that is here, oldest first, unparsed."""
        coming = self._coming
        if not coming:  # nearly always: some twenty are asked in every tick
            return []
        now = self.port.bus.tick
        here = []
        while coming and coming[0][0] <= now:
            here.append(coming.popleft()[1])
        return here[-self._key.ring :]

    def drain(self) -> Arrivals[M]:
        """Take all that is here, parse at most the 4 newest, in order of arrival."""
        payloads = self.drain_bytes()
        if not payloads:
            return Arrivals((), 0)
        newest = payloads[-PARSED_PER_DRAIN:]
        return Arrivals(tuple(decode(self._key, raw) for raw in newest), len(payloads))

    def newest(self) -> M | None:
        """Take all that is here and return the newest.

        Raises:
            TypeError: it is no message. In one process only a defect can cause that.
        """
        payloads = self.drain_bytes()
        if not payloads:
            return None
        item = decode(self._key, payloads[-1])
        if isinstance(item, DecodeFailure):
            raise TypeError(f"{self._key.path} cannot be sent: {item.code}: {item.detail}")
        return item


Listener = tuple[PortSubscriber[Record], MessagePath]
