"""Wait for a disk: what is on it in time is taken, however late the loop hears of both."""

from __future__ import annotations

import asyncio
import time
from typing import TYPE_CHECKING

from planner.mission import JournalSync, MissionJournal

if TYPE_CHECKING:
    from pathlib import Path

    import pytest


def test_an_entry_that_is_safe_as_the_wait_ends_is_not_called_lost(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its goal may move already: called lost, it would be taken back and done again."""
    monkeypatch.setattr("planner.mission.journal_sync.SAFE_WITHIN_S", 0.02)

    async def story() -> None:
        disk = JournalSync(MissionJournal.in_home(tmp_path))
        await disk.open(lambda _: None)
        waiting = asyncio.create_task(disk.wait(1))
        await asyncio.sleep(0)
        disk._from_thread(1)
        time.sleep(0.05)  # noqa: ASYNC251  # the loop is held up: both come in one turn
        await waiting
        await disk.close()

    asyncio.run(story())
