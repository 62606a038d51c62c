"""A key is known again however many came after it, and only a full memory asks the disk."""

from __future__ import annotations

import asyncio

from planner.mission.journal import MAX_KEYS
from planner.mission.request_keys import Repeats
from planner.mission.state import GoalKey

OLD = GoalKey("old", "body", "g0")


class Disk:
    """Keep one old key, and count who asks."""

    def __init__(self) -> None:
        self.asked: list[str] = []

    async def find(self, key: str) -> GoalKey | None:
        self.asked.append(key)
        return OLD if key == OLD.key else None


def repeats_of(count: int) -> tuple[Repeats, Disk]:
    repeats, disk = Repeats(GoalKey(f"k{n}", "body", f"g{n}") for n in range(count)), Disk()
    repeats.find_older = disk.find
    return repeats, disk


def test_a_key_older_than_those_at_hand_is_found_on_disk() -> None:
    repeats, disk = repeats_of(MAX_KEYS)
    for key in ("old", "new", "k7", None):
        asyncio.run(repeats.look_up(key))
    assert disk.asked == ["old", "new"]
    assert repeats.find("old") == OLD
    assert repeats.find("new") is None


def test_while_all_keys_are_at_hand_no_disk_is_asked() -> None:
    repeats, disk = repeats_of(MAX_KEYS - 1)
    asyncio.run(repeats.look_up("old"))
    assert not disk.asked
