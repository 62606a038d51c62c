"""A camera takes the same pictures by the same seed, and its faults do what their names say."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from sim.camera import PicturePair, SimCamera
from tests.known import known
from tests.sim.camera.gallery import CAMERA, MIDDLE, hall
from wire import SimFault, SimScene

OFF, STUCK = SimFault.CAMERA_OFF, SimFault.CAMERA_STUCK
BLIND, DELAYED = SimFault.CAMERA_BLIND, SimFault.CAMERA_DELAYED
PERIOD_S = 0.1


class Taking:
    """Hold a camera, and let its time pass in periods."""

    def __init__(self, seed: int = 0) -> None:
        self.camera = SimCamera(hall(), CAMERA, seed=seed)
        self.now_s = 100.0

    def shots(self, count: int, *faults: SimFault) -> list[PicturePair | None]:
        """Return what leaves the camera in so many periods."""
        taken = []
        for _ in range(count):
            self.now_s = round(self.now_s + PERIOD_S, 6)
            scene = SimScene(
                boot_id="s", seq=1, stamp_s=self.now_s, base_in_map=MIDDLE, faults=faults
            )
            taken.append(self.camera.take(scene, self.now_s))
        return taken


def test_the_same_seed_takes_the_same_pictures() -> None:
    assert Taking(5).shots(3) == Taking(5).shots(3)
    assert known(Taking(5).shots(1)[0]).color != known(Taking(6).shots(1)[0]).color


def test_pictures_unpack_to_what_was_drawn() -> None:
    found = known(Taking().shots(1)[0])
    color = known(cv2.imdecode(np.frombuffer(found.color, np.uint8), cv2.IMREAD_COLOR))
    depth = known(cv2.imdecode(np.frombuffer(found.depth, np.uint8), cv2.IMREAD_UNCHANGED))
    assert color.shape == (CAMERA.height_px, CAMERA.width_px, 3)
    assert depth.shape == (CAMERA.height_px, CAMERA.width_px)
    assert depth.dtype == np.uint16
    assert np.median(depth[36]) == pytest.approx(3950, abs=10)
    blue, _, red = color[10, 48].astype(int)
    assert red > blue, "the wall's plain paint is warm: channels are not swapped"


def test_off_is_silent_and_comes_back() -> None:
    taking = Taking()
    assert taking.shots(3, OFF) == [None] * 3
    assert known(taking.shots(1)[0]).stamp_s == taking.now_s


def test_stuck_repeats_one_picture_freshly_stamped() -> None:
    taking = Taking()
    stuck = [known(one) for one in taking.shots(3, STUCK)]
    assert len({(one.color, one.depth) for one in stuck}) == 1
    assert [one.stamp_s for one in stuck] == pytest.approx([100.1, 100.2, 100.3])
    assert known(taking.shots(1)[0]).color != stuck[0].color


def test_blind_is_black_without_depth() -> None:
    found = known(Taking().shots(1, BLIND)[0])
    for data in (found.color, found.depth):
        picture = known(cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED))
        assert picture.max() == 0


def test_delayed_pictures_come_a_second_late_as_they_were_stamped() -> None:
    taking = Taking()
    late = taking.shots(14, DELAYED)
    assert late[:10] == [None] * 10
    assert [known(one).stamp_s for one in late[10:]] == pytest.approx([100.1, 100.2, 100.3, 100.4])
    assert known(taking.shots(1)[0]).stamp_s == taking.now_s, "mended: nothing old comes after"
