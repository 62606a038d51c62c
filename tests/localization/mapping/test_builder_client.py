"""The builder's process keeps the map in its folder, and goes on from there when it is killed."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest

from localization.global_search import Candidate, is_sure
from localization.mapping.builder_client import BuilderClient
from localization.mapping.builder_process import load_builder
from localization.mapping.keyframes import KEYFRAMES_FILE
from localization.mapping.map_builder import MapBuilder
from localization.mapping.scan_tracker import KeyframeLink, ScanTracker
from maps.growing_map import read_growing_map
from tests.localization.mapping.test_map_builder import course
from tests.localization.mapping.test_map_builder import drive as drive_round
from tests.localization.rooms import ROOM, cast, points_of
from tests.waiting import until
from wire import Pose2, RobotDescription

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=1)]
LIDAR = RobotDescription().lidar.model_copy(update={"x_m": 0.0, "y_m": 0.0})


class Kept(MapBuilder):
    """Build a map, and keep the links that it was made of."""

    def __init__(self) -> None:
        super().__init__()
        self.links: list[KeyframeLink] = []

    def add(self, link: KeyframeLink) -> bool:
        self.links.append(link)
        return super().add(link)


@pytest.fixture(scope="module")
def links() -> list[KeyframeLink]:
    kept = Kept()
    drive_round(ROOM, 1, kept, ScanTracker())
    return kept.links


@pytest.fixture
def client(tmp_path: Path) -> Iterator[BuilderClient]:
    made = BuilderClient(tmp_path, LIDAR)
    made.start()
    yield made
    made.close()


def kept_in(folder: Path) -> int:
    grown = read_growing_map(folder)
    return 0 if grown is None else grown.keyframes


def builder_pid() -> int:
    names = [
        child.pid
        for child in psutil.Process().children(recursive=True)
        if child.status() != psutil.STATUS_ZOMBIE
        and any("builder_process" in word for word in child.cmdline())
    ]
    assert len(names) == 1
    return names[0]


def test_a_killed_builder_is_told_again_what_it_had_not_kept(
    client: BuilderClient, links: list[KeyframeLink], tmp_path: Path
) -> None:
    half = len(links) // 2
    for link in links[:half]:
        client.add(link)
    until(lambda: kept_in(tmp_path) > 0)
    os.kill(builder_pid(), signal.SIGKILL)
    for link in links[half:]:
        client.add(link)
    until(lambda: kept_in(tmp_path) == len(links))
    kept = load_builder(tmp_path, (0.0, 0.0)).keyframes
    assert [one.stamp_s for one in kept] == [link.keyframe.stamp_s for link in links]


def test_a_scan_is_found_on_what_was_kept(
    client: BuilderClient, links: list[KeyframeLink], tmp_path: Path
) -> None:
    for link in links:
        client.add(link)
    until(lambda: kept_in(tmp_path) == len(links))
    true = course(1)
    client.find(points_of(cast(ROOM, Pose2(*true[12].tolist()))))
    answers: list[tuple[Candidate, ...] | None] = [None]

    def is_answered() -> bool:
        answers.append(client.found())
        return answers[-1] is not None

    until(is_answered)
    assert is_sure(answers[-1] or ())
    grown = read_growing_map(tmp_path)
    assert grown is not None
    assert grown.revision >= len(links)


def test_keyframes_that_vanished_are_said_and_nothing_spins(
    links: list[KeyframeLink], tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    client = BuilderClient(tmp_path, LIDAR, known=7)  # the folder is empty
    client.start()
    try:
        client.add(links[0])
        until(lambda: "of the 7 that were there" in caplog.text)
    finally:
        client.close()
    assert not (tmp_path / KEYFRAMES_FILE).exists()
