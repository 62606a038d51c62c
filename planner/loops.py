"""Keep loops going after an error: one that ended for good would be missed by nobody at once."""

from __future__ import annotations

import asyncio
import logging
from typing import TYPE_CHECKING, NoReturn

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

log = logging.getLogger(__name__)

AGAIN_S = 1.0


async def keep_going(
    name: str, loop: Callable[[], Awaitable[None]], again_s: float = AGAIN_S
) -> NoReturn:
    """Run a loop until cancelled, and again a while after it failed or ended.

    Args:
        name: of the loop, for the log.
        loop: runs for ever, where nothing is wrong.
        again_s: the pause before it begins again [s].
    """
    while True:
        try:
            await loop()
        except Exception:
            log.exception("%s: an error that was not foreseen; it begins again", name)
        await asyncio.sleep(again_s)
