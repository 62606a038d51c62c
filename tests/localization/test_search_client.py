"""The search process as its client sees it: what it finds, and why it found nothing."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np
import psutil
import pytest

from localization.deskew import deskew
from localization.odometry_integration import OdometryTrail
from localization.relocation import SearchRequest
from localization.search_client import SearchClient, SearchFailure
from planner.language.catalogue import say
from sim import SimRobot
from tests.waiting import until
from wire import IDENTITY, STILL, Odometry
from wire.lidar_config import LidarConfig

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

LIMIT_S = 60.0


@pytest.fixture
def client(repository: Path) -> Iterator[SearchClient]:
    client = SearchClient(repository / "sites" / "two_room", LidarConfig())
    client.start()
    yield client
    client.close()


def seen(repository: Path) -> np.ndarray:
    """Return what a robot sees at the start in the two rooms, in its base frame [m]."""
    robot = SimRobot(repository / "sites" / "two_room", seed=1)
    ticks = (robot.tick(2.0 + tick / 100) for tick in range(100))
    scan = next(tick.scan for tick in ticks if tick.scan is not None)
    trail = OdometryTrail()
    for seq, stamp_s in enumerate((scan.stamp_s - 1.0, scan.stamp_s + 1.0)):
        trail.add(
            Odometry(
                odom_id="o", seq=seq, stamp_s=stamp_s, base_in_odom=IDENTITY,
                twist=STILL, yaw_rate_radps=None,
            )
        )  # fmt: skip
    return deskew(scan, LidarConfig(), trail).points_m


def ask_until_answered(client: SearchClient, points_m: np.ndarray, first: int) -> int:
    """Ask as the localizer does, again and again, until something was found; return how often."""
    end_s = time.monotonic() + LIMIT_S
    for number in range(first, 10_000):
        client.ask(SearchRequest.of_hint(number, points_m, None))
        while not (answers := client.answers()):
            assert time.monotonic() < end_s, f"no answer: {client.trouble}"
            time.sleep(0.02)
        if answers[-1][1]:
            return number
        assert client.trouble is not None, "nothing was found, and nobody says why"
    raise AssertionError("no answer")


@pytest.mark.nightly
@pytest.mark.e2e
def test_it_says_why_it_finds_nothing_until_it_finds_again(
    client: SearchClient, repository: Path
) -> None:
    points_m = seen(repository)
    client.ask(SearchRequest.of_hint(0, points_m, None))  # at once: its process is starting
    asked = ask_until_answered(client, points_m, 1)
    assert client.trouble is None
    searching = [
        one
        for one in psutil.Process().children(recursive=True)
        if one.status() != psutil.STATUS_ZOMBIE
        and "localization.search_process" in " ".join(one.cmdline())
    ]
    assert searching, "no search process runs"
    for process in searching:  # a launcher may stand above it
        process.kill()
    psutil.wait_procs(searching, timeout=LIMIT_S)
    client.ask(SearchRequest.of_hint(asked + 1, points_m, None))
    until(lambda: client.trouble, LIMIT_S)
    assert client.trouble in {"search_unavailable", "search_died"}
    ask_until_answered(client, points_m, asked + 2)
    assert client.trouble is None


@pytest.mark.parametrize("code", SearchFailure.reasons)
def test_each_reason_has_words_for_people(code: str) -> None:
    said = say(f"localization.{code}")
    assert "stand still" in said.en
    assert "停着不动" in said.zh
