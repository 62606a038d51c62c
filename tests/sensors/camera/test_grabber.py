"""The newest picture alone is kept, and a camera that went is opened until it is there."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import numpy as np
import pytest

from sensors.camera.grabber import CameraGrabber
from sensors.camera.shot import CameraShot, CameraTrouble
from tests.waiting import until


class Plugged:
    """Be a camera that can be pulled; its pictures come when they are let."""

    def __init__(self) -> None:
        self.there = True
        self.changes = True
        self.given = 0
        self.open = 0
        self._due = threading.Semaphore(0)

    def let(self, count: int = 1) -> None:
        for _ in range(count):
            self._due.release()

    def __call__(self) -> Plugged:
        if not self.there:
            raise CameraTrouble("camera_missing", "it is not there")
        self.open += 1
        return self

    def read(self) -> CameraShot:
        while not self._due.acquire(timeout=0.01):
            if not self.there:
                raise CameraTrouble("camera_gone", "it went")
            if self.given < 0:
                raise CameraTrouble("camera_gone", "the test ends")
        self.given += 1
        shade = self.given if self.changes else 0
        return CameraShot(np.full((12, 16, 3), shade, np.uint8), 10.0, (8.0, 6.0))

    def close(self) -> None:
        self.open -= 1


@pytest.fixture
def plugged() -> Plugged:
    return Plugged()


@pytest.fixture
def camera(plugged: Plugged) -> Iterator[CameraGrabber]:
    made = CameraGrabber(plugged, retry_s=0.01)
    yield made
    plugged.given = -1_000_000
    made.close()
    assert plugged.open == 0, "it is given back"


def test_only_the_newest_is_kept_and_counts_once(plugged: Plugged, camera: CameraGrabber) -> None:
    plugged.let(5)
    until(lambda: camera.pictures == 5)
    newest = camera.take()
    assert newest is not None
    assert newest.shot.color[0, 0, 0] == 5
    assert camera.take() is None
    assert camera.size == (16, 12)


def test_a_camera_that_is_pulled_is_opened_again(plugged: Plugged, camera: CameraGrabber) -> None:
    plugged.let()
    until(lambda: camera.pictures == 1)
    plugged.there = False
    until(lambda: camera.trouble is not None and camera.trouble.code == "camera_missing")
    plugged.there = True
    until(lambda: camera.opened == 2)
    assert camera.trouble is not None, "it is no better before a picture came"
    plugged.let()
    until(lambda: camera.pictures == 2)
    assert camera.trouble is None


def test_a_picture_that_repeats_itself_changes_nothing(
    plugged: Plugged, camera: CameraGrabber
) -> None:
    plugged.let(2)
    until(lambda: camera.pictures == 2)
    plugged.changes = False
    plugged.let()
    until(lambda: camera.pictures == 3)
    changed_s = camera.changed_s
    plugged.let(3)
    until(lambda: camera.pictures == 6)
    assert camera.changed_s == changed_s
