"""What is seen anew is written, once and soon; what was forgotten comes back when seen again."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from planner.memory import MemoryQuery, MemoryStore, Recollection, SightingRecorder
from planner.perception.snapshot import Sight, Thing
from planner.state_database import StateDatabase

T = TypeVar("T")
CUP = Thing("cup_1", "cup", "red", 1.0, 2.0, 0.8, 0.05, 0.9, 0.0, 0.0, 5, "kitchen")


async def at_once(work: Callable[[], T], /) -> T:
    return work()


class Watch:
    """Hold a clock, a store and a recorder."""

    def __init__(self, home: Path) -> None:
        self.now_s = 100.0
        self.store = MemoryStore(StateDatabase(home))
        self.recollection = Recollection(self.store, wall=self.wall, run=at_once)
        self.recorder = SightingRecorder(
            self.recollection, "m", support=lambda thing, things: "table", step=lambda: "patrol",
            clock=lambda: self.now_s, wall=self.wall,
        )  # fmt: skip

    def wall(self) -> float:
        return 1_800_000_000.0 + self.now_s

    async def see(self, *things: Thing) -> None:
        self.now_s += 1.0
        seen = tuple(replace(thing, seen_s=self.now_s) for thing in things)
        self.recorder.take(Sight(things=seen))
        await self.recorder.flush()

    def kept(self) -> list[tuple[str, int, str]]:
        found = self.store.find(MemoryQuery(), self.wall())
        return [(memo.label, memo.sightings, memo.step) for memo in found]


async def test_what_is_seen_is_kept_with_its_step(tmp_path: Path) -> None:
    watch = Watch(tmp_path)
    await watch.see(CUP)
    await watch.see(CUP)
    assert watch.kept() == [("cup", 2, "patrol")]
    (memo,) = watch.store.find(MemoryQuery("cup"), watch.wall())
    assert (memo.support, memo.last_unix_s) == ("table", watch.wall())


async def test_what_one_picture_shows_is_not_kept(tmp_path: Path) -> None:
    watch = Watch(tmp_path)
    await watch.see(replace(CUP, sightings=1), replace(CUP, id="cup_2", confidence=0.3))
    assert watch.kept() == []


async def test_what_is_merely_tracked_is_not_seen_anew(tmp_path: Path) -> None:
    watch = Watch(tmp_path)
    watch.recorder.take(Sight(things=(CUP,)))  # of an older program: seen before this one began
    await watch.recorder.flush()
    assert watch.kept() == []


async def test_forgotten_until_it_is_seen_again(tmp_path: Path) -> None:
    watch = Watch(tmp_path)
    await watch.see(CUP)
    watch.recollection.listen(watch.recorder.drop)
    await watch.recollection.forget_about("cup")
    still = replace(CUP, seen_s=watch.now_s, confidence=0.85)
    watch.recorder.take(Sight(things=(still,)))
    await watch.recorder.flush()
    assert watch.kept() == []
    await watch.see(CUP)
    assert watch.kept() == [("cup", 1, "patrol")]


async def test_what_an_older_program_remembered_comes_in_once(tmp_path: Path) -> None:
    watch = Watch(tmp_path)
    for _ in range(2):
        await watch.recorder.start((replace(CUP, seen_s=-50.0, first_s=-60.0),))
        await watch.recorder.close()
    assert [label for label, _, _ in watch.kept()] == ["cup"]
