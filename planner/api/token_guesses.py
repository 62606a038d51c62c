"""Count wrong tokens by address: their answers come later each time, and the log says so.

Only the answer to a wrong token waits. A right one is never looked up here, so whoever shares an
address with a guesser is served as ever. The memory is bounded: the address that guessed longest
ago is forgotten first.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections import OrderedDict
from collections.abc import Callable

from planner.api.crowd import address_of

log = logging.getLogger(__name__)

FREE = 3
"""So many are typing mistakes."""
FIRST_S, LONGEST_S = 0.1, 2.0
FORGIVEN_S = 10.0
"""For so long without a guess, one is forgiven."""
MOST_ADDRESSES = 1_024
LOG_S = 10.0


class Guesses:
    """Remember each address's wrong tokens."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._counts: OrderedDict[str, tuple[float, float]] = OrderedDict()
        self._logged_s = float("-inf")
        self._unlogged = 0

    def __len__(self) -> int:
        return len(self._counts)

    def note(self, host: str) -> float:
        """Count a wrong token; return how long its answer must wait [s]."""
        now_s, address = self._clock(), address_of(host)
        count, then_s = self._counts.pop(address, (0.0, now_s))
        count = max(0.0, count - (now_s - then_s) / FORGIVEN_S) + 1.0
        self._counts[address] = (count, now_s)
        if len(self._counts) > MOST_ADDRESSES:
            self._counts.popitem(last=False)
        self._tell(address, now_s)
        over = count - FREE
        return min(LONGEST_S, FIRST_S * 2.0 ** min(over - 1.0, 16.0)) if over > 0.0 else 0.0

    async def slow(self, client: tuple[str, int] | None) -> None:
        """Count a wrong token and wait before its answer."""
        await asyncio.sleep(self.note(client[0] if client else "unknown"))

    def _tell(self, address: str, now_s: float) -> None:
        self._unlogged += 1
        if now_s - self._logged_s >= LOG_S:
            log.warning("wrong_token: %d refused, the last from %r", self._unlogged, address[:80])
            self._logged_s, self._unlogged = now_s, 0
