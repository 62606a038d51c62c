"""Wait until the machine keeps time, two minutes at most: ``python -m scripts.calm``.

A story told in real time on a machine that stops for moments says nothing. Says what was seen and
always ends well: whoever asked goes on either way.
"""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING

from scripts.scheduler_probe import Pulse, until_calm

if TYPE_CHECKING:
    from collections.abc import Callable

    from scripts.scheduler_probe import HostTiming

LIMIT_S = 120.0


def main() -> int:
    """Wait on this machine."""
    with Pulse() as pulse:
        print(wait_for_calm(pulse.look, time.monotonic), flush=True)
    return 0


def wait_for_calm(look: Callable[[], HostTiming], clock: Callable[[], float]) -> str:
    """Wait and tell what was seen at the end."""
    began_s = clock()
    seen = until_calm(look, LIMIT_S, clock)
    kept = "keeps time" if seen.time else "still does not keep time"
    return f"calm: the machine {kept} after {clock() - began_s:.0f} s: {seen}"


if __name__ == "__main__":
    sys.exit(main())
