"""Bound the strangers' share of the server, so that a new connection's stop is always served.

Nobody's token is known before a request is complete, so what comes before that is bounded for all:
its seconds, its bytes and the number of connections. Room is made, never refused: where too many
are open, the one that has waited longest without a complete request is closed. Sockets of the event
stream are counted by ``planner.api.websocket``, which knows whom it lets in. Knows no protocol.
"""

from __future__ import annotations

import asyncio
import ipaddress
import resource
from dataclasses import dataclass, replace
from enum import IntEnum
from typing import TYPE_CHECKING, ClassVar

if TYPE_CHECKING:
    from collections.abc import Callable

RESERVED_FILES = 320
"""Descriptors for the 128 sockets of the event stream and for all that is no connection: journal,
transport, workers, a log."""
MOST_FILES = 65_536


@dataclass(frozen=True, slots=True)
class Bounds:
    """Bound the sockets of one connection, one address and all of them."""

    request_s: float = 5.0
    """From the opening, or a request's first byte, to its complete head; a body has as long again,
    and longer by what has come of it."""
    body_bytes_per_s: float = 64_000.0
    """A recording of 3 MB may take 52 s, a body that trickles no more than ``request_s``."""
    stalled_s: float = 10.0
    """How long somebody may leave an answer unread."""
    linger_s: float = 1.0
    """How long what still comes is thrown away after a refusal."""
    head_bytes: int = 32 * 1024
    """All of a request but its body: request line, headers, trailers and the frames of chunks.
    Cookies of every service on a host's other ports come along, hence not less."""
    fields: int = 100
    chunks: int = 4_096
    body_bytes: int = 128 * 1024 * 1024
    """Routes take less (``planner.api.middleware``). What comes after their answer is thrown away,
    so that the answer is read by who sends first and reads later; this ends it."""
    pipelined: int = 8
    an_address: int = 128
    """A proxy in front of us is one address."""
    all: int = 512
    burst: int = 1_500
    """Held for a moment while many connect at once; beyond it one goes for each that comes."""
    grace_s: float = 0.05
    """How long a connection has at least, so that the request that came with it is read."""

    def limit_to_files(self, files: int) -> Bounds:
        """Return these bounds for a process that may open so many files."""
        room = max(16, files - RESERVED_FILES)
        burst = min(self.burst, room)
        most = min(self.all, max(8, burst * 2 // 3))
        return replace(self, burst=burst, all=most, an_address=min(self.an_address, most))


def raise_files() -> int:
    """Raise the soft limit of open files to the hard one and return it."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = MOST_FILES if hard == resource.RLIM_INFINITY else min(hard, MOST_FILES)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
        return wanted
    return MOST_FILES if soft == resource.RLIM_INFINITY else soft


class Standing(IntEnum):
    """Name a connection's claim to stay, in the order in which room is made."""

    WAITING = 0
    """Not a complete request: silent, slow, or idle after an answer."""
    ANSWERED = 1
    STOPPING = 2


@dataclass(slots=True, eq=False)
class Visitor:
    """Be one connection, whichever protocol serves it."""

    address: str
    transport: asyncio.Transport
    give_up: Callable[[], None]
    """Ends it because what it began was not complete in time."""
    standing: Standing = Standing.WAITING
    due_s: float | None = None
    """When what it has begun must be complete; None while nothing is awaited of it."""
    stalled_s: float | None = None
    """Since when it has left an answer unread."""
    closing_s: float | None = None

    def reads_too_slowly(self, now_s: float, bounds: Bounds) -> bool:
        """Return whether it leaves an answer, or our goodbye, unread."""
        if self.transport.is_closing() and self.closing_s is None:
            self.closing_s = now_s
        marks = (self.stalled_s, self.closing_s)
        return any(mark is not None and now_s - mark >= bounds.stalled_s for mark in marks)


class Crowd:
    """Hold all connections of one server and make room among them."""

    LOOK_S: ClassVar[float] = 0.25

    def __init__(self, bounds: Bounds) -> None:
        self.bounds = bounds
        self._visitors: dict[str, dict[Visitor, None]] = {}
        """By address; of each the one first whose standing changed longest ago."""
        self._sockets: set[Visitor] = set()
        self._count = 0
        self._timer: asyncio.TimerHandle | None = None
        self._trim: asyncio.TimerHandle | None = None

    def __len__(self) -> int:
        return self._count

    def enter(self, visitor: Visitor) -> None:
        """Take a new connection in; where that is one too many, another goes soon, or at once."""
        own = self._visitors.setdefault(visitor.address, {})
        own[visitor] = None
        self._count += 1
        loop = asyncio.get_running_loop()
        if self._count > self.bounds.burst:
            self._make_room()
        elif self._trim is None and not self._fits(own):
            self._trim = loop.call_later(self.bounds.grace_s, self._close_surplus)
        if self._timer is None:
            self._timer = loop.call_later(self.LOOK_S, self._look)

    def stand(self, visitor: Visitor, standing: Standing) -> None:
        """Note a connection's claim now; of its kind it is the youngest again."""
        own = self._visitors.get(visitor.address, {})
        if visitor in own:
            visitor.standing = standing
            own[visitor] = own.pop(visitor)

    def settle(self, visitor: Visitor) -> None:
        """Count a socket that was let in no longer: the server that let it in does."""
        self.leave(visitor)
        visitor.due_s = None
        self._sockets.add(visitor)

    def leave(self, visitor: Visitor) -> None:
        """Forget a connection."""
        self._sockets.discard(visitor)
        own = self._visitors.get(visitor.address, {})
        if visitor in own:
            del own[visitor]
            self._count -= 1
            if not own:
                del self._visitors[visitor.address]

    def _fits(self, own: dict[Visitor, None]) -> bool:
        return len(own) <= self.bounds.an_address and self._count <= self.bounds.all

    def _close_surplus(self) -> None:
        self._trim = None
        for own in tuple(self._visitors.values()):
            for _ in range(len(own) - self.bounds.an_address):
                self._close_one(own)
        for _ in range(self._count - self.bounds.all):
            self._make_room()

    def _make_room(self) -> None:
        """Close one of the address that holds most."""
        self._close_one(max(self._visitors.values(), key=len))

    def _close_one(self, own: dict[Visitor, None]) -> None:
        gone = min(own, key=lambda visitor: visitor.standing)  # the oldest of the least standing
        self.leave(gone)
        gone.transport.abort()

    def _look(self) -> None:
        """End overdue connections; look again while any is here."""
        loop = asyncio.get_running_loop()
        now_s = loop.time()
        for visitor in [one for own in self._visitors.values() for one in own] + [*self._sockets]:
            if visitor.reads_too_slowly(now_s, self.bounds):
                visitor.transport.abort()
            elif visitor.due_s is not None and now_s >= visitor.due_s:
                visitor.give_up()
        any_left = bool(self._visitors or self._sockets)
        self._timer = loop.call_later(self.LOOK_S, self._look) if any_left else None


def address_of(host: str) -> str:
    """Return the part of an address that is counted: of IPv6 its first 64 bits, one network's."""
    try:
        found = ipaddress.ip_address(host.partition("%")[0])
    except ValueError:
        return host
    if isinstance(found, ipaddress.IPv4Address):
        return str(found)
    if found.ipv4_mapped is not None:
        return str(found.ipv4_mapped)
    return str(ipaddress.ip_network((int(found) >> 64 << 64, 64)))
