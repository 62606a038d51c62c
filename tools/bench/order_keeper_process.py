"""Be a process that keeps standing orders and may be killed: ``python -m … HOME``.

Each goal that is given is a line in the file ``given``, synced before the call returns, as the
journal does it.
"""

from __future__ import annotations

import asyncio
import os
import sys
import time
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, cast
from zoneinfo import ZoneInfo

from planner.mission.state import Mission, MissionState
from planner.orders.keeper import OrderKeeper
from planner.orders.store import OrderStore
from planner.plan import Language
from planner.site.site_view import SiteView
from planner.state_database import StateDatabase
from wire import Mode, Twist2

if TYPE_CHECKING:
    from wire import Status


class LoggedGoals:
    """Give goals by writing their keys down."""

    def __init__(self, home: Path) -> None:
        self._path = home / "given"
        status = SimpleNamespace(
            mode=Mode.HOLD,
            held=None,
            measured=Twist2(0.0, 0.0),
            drive=SimpleNamespace(battery=None),
            base_in_map=None,
        )  # all that standing orders read of one
        self._book = MissionState(SiteView({}, "home"), status=cast("Status", status))

    @property
    def book(self) -> MissionState:
        return replace(self._book, status_s=time.monotonic())

    def publish(self, event: dict[str, Any]) -> None:
        """Nobody listens."""

    def find(self, key: str) -> str | None:
        return key if self._path.exists() and key in self._path.read_text().split() else None

    async def give(self, goal_id: str, text: str, language: Language, key: str, source: str) -> str:
        del goal_id, text, language, source
        await asyncio.to_thread(self._write, key)
        return key

    def _write(self, key: str) -> None:
        with self._path.open("a") as file:
            file.write(f"{key}\n")
            file.flush()
            os.fsync(file.fileno())

    def outcome(self, goal_id: str) -> Mission | None:
        del goal_id
        return None

    def waits(self, goal_id: str) -> bool:
        del goal_id
        return False

    def cancel(self, goal_id: str) -> None:
        """Nothing runs."""


async def main(home: Path) -> None:
    """Keep orders until killed."""
    store = OrderStore(StateDatabase(home))
    keeper = OrderKeeper(store, LoggedGoals(home), ZoneInfo("UTC"))
    await keeper.start()
    (home / "up").touch()
    await asyncio.Event().wait()


if __name__ == "__main__":
    asyncio.run(main(Path(sys.argv[1])))
