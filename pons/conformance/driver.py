"""Let a brain speak with the bridge: on each status, through whoever breaks its words.

Owns one thread. What the brain says well is a list of dictionaries; a breaker turns it into the
bytes that are really sent.
"""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from pons.conformance.reference_client import number

if TYPE_CHECKING:
    from pons.conformance.reference_client import ReferenceBrain, Said
    from wire import Status

Sent = tuple[str, bytes]
Breaker = Callable[["list[Said]", "Status"], "list[Sent]"]

POLL_S = 0.002
KEPT = 80


def plain(said: list[Said], _status: Status) -> list[Sent]:
    """Send a message as it is."""
    return [(key, pack(message)) for key, message in said]


def mute(_said: list[Said], _status: Status) -> list[Sent]:
    """Say nothing."""
    return []


def pack(message: object) -> bytes:
    """Return JSON as most libraries write it: NaN and infinity included."""
    return json.dumps(message, separators=(",", ":")).encode()


class BrainDriver:
    """Run one brain until closed."""

    def __init__(
        self,
        brain: ReferenceBrain,
        listen: Callable[[], Status | None],
        say: Callable[[str, bytes], None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.brain = brain
        self.breaker: Breaker = mute
        self.sent: list[Sent] = []
        """The newest that were sent, for those who repeat them."""
        self._listen, self._say, self.clock = listen, say, clock
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True, name="brain")
        self._thread.start()

    def close(self) -> None:
        """Fall silent for ever."""
        self._ending.set()
        self._thread.join()

    def _run(self) -> None:
        known = -1
        while not self._ending.wait(POLL_S):
            status = self._listen()
            if status is None or status.seq == known:
                continue
            known = status.seq
            said = self.brain.answer(status, self.clock(), number(time.monotonic()))
            for key, payload in self.breaker(said, status):
                self._say(key, payload)
                self.sent = [*self.sent[1 - KEPT :], (key, payload)]
