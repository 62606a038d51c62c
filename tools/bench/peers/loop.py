"""Take turns with the bench: a line in is a round, a line out its times. Standard library alone.

This file runs in the peers' own environment as well, where nothing of ours is installed.
"""

from __future__ import annotations

import asyncio
import json
import sys
import time
from collections.abc import Awaitable, Callable


def take_turns(
    name: str, versions: dict[str, str], plan_once: Callable[[], Awaitable[None]]
) -> None:
    """Say who this is, then run as many goals as each line names and print their times [ms]."""
    asyncio.run(_turns(name, versions, plan_once))


async def _turns(
    name: str, versions: dict[str, str], plan_once: Callable[[], Awaitable[None]]
) -> None:
    print(json.dumps({"name": name, "versions": versions}), flush=True)
    while line := sys.stdin.readline():
        took_ms, cpu_s = [], time.process_time()
        for _ in range(int(line)):
            began_s = time.perf_counter()
            await plan_once()
            took_ms.append((time.perf_counter() - began_s) * 1e3)
        cpu_ms = (time.process_time() - cpu_s) * 1e3 / len(took_ms)
        print(json.dumps({"took_ms": took_ms, "cpu_ms": cpu_ms}), flush=True)
