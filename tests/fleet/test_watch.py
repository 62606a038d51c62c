"""Try the watch of one robot: it outlives a store that fails, and reads a restarted one's card."""

from __future__ import annotations

import asyncio
import sqlite3
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, closing
from pathlib import Path

import pytest

import fleet.watch
from fleet.desk import keep_going
from fleet.robots import add_robot, link_of
from fleet.store import FleetStore
from fleet.watch import RobotWatch
from tests.fleet.conftest import StubRobot

MakeRobot = Callable[[str], StubRobot]

PATIENCE_S = 20.0


@asynccontextmanager
async def watched(robot: StubRobot) -> AsyncIterator[RobotWatch]:
    """Yield a robot's watch while it makes quick rounds."""
    store = FleetStore(f"sqlite:///{robot.folder / 'fleet.sqlite'}")
    await add_robot(store, robot.folder, robot.url, "", None)
    watch = RobotWatch(link_of(store.robots()[0], robot.folder), store, lambda _missions: None)
    with pytest.MonkeyPatch.context() as patch:
        for name in ("POLL_S", "IDLE_S"):
            patch.setattr(fleet.watch, name, 0.05)
        task = asyncio.create_task(keep_going("r", watch.run))
        try:
            yield watch
        finally:
            task.cancel()
            await asyncio.gather(task, return_exceptions=True)
            await watch.link.close()
            store.close()


async def await_sight(look: Callable[[], bool]) -> None:
    """Return once it is seen."""
    async with asyncio.timeout(PATIENCE_S):
        while not look():  # noqa: ASYNC110  # what is looked at rings no bell
            await asyncio.sleep(0.01)


def rename(folder: Path, table: str, name: str) -> None:
    with closing(sqlite3.connect(folder / "fleet.sqlite", timeout=PATIENCE_S)) as disk:
        disk.execute(f"ALTER TABLE {table} RENAME TO {name}")


def test_it_is_connecting_until_a_whole_round_is_made(make_robot: MakeRobot) -> None:
    async def story() -> None:
        async with watched(make_robot("r")) as watch:
            assert watch.state == "connecting"
            await await_sight(lambda: watch.state == "ready")
            assert watch.is_ready

    asyncio.run(story())


def test_a_store_that_fails_while_the_robot_is_away_ends_no_watch(
    make_robot: MakeRobot, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    async def story(robot: StubRobot) -> None:
        async with watched(robot) as watch:
            await await_sight(lambda: watch.state == "ready")
            robot.kill()
            await await_sight(lambda: watch.state == "robot_silent")
            rename(robot.folder, "fleet_missions", "hidden")
            monkeypatch.setattr(fleet.watch, "SILENT_S", 0.0)  # now its missions become unknown
            await await_sight(lambda: "store_unavailable" in caplog.text)
            rename(robot.folder, "hidden", "fleet_missions")
            robot.start()
            await await_sight(lambda: watch.state == "ready")

    asyncio.run(story(make_robot("r")))


@pytest.mark.parametrize(
    ("rules", "state"),
    [({"card": {"places": "none of yours"}}, "card_unread"), ({"id": "x"}, "robot_mismatch")],
)
def test_a_robot_that_was_restarted_between_two_rounds_is_asked_who_it_is(
    make_robot: MakeRobot, rules: dict[str, object], state: str
) -> None:
    async def story(robot: StubRobot) -> None:
        async with watched(robot) as watch:
            await await_sight(lambda: watch.state == "ready")
            robot.kill()  # the loop stands still until it is back: no round sees it away
            robot.start()
            robot.rule(**rules)
            await await_sight(lambda: watch.state == state)

    asyncio.run(story(make_robot("r")))
