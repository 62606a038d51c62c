"""Two views of a camera: what changed, on which side, and what a cover leaves of them."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from sensors.camera.lens_view import LensView
from sensors.camera.shot import CameraShot

WIDTH, HEIGHT = 128, 96


def view(picture: NDArray[np.float64], count: int = 5) -> LensView:
    random = np.random.default_rng(3)
    shots = []
    for _ in range(count):
        noisy = np.clip(picture + random.normal(0.0, 3.0, picture.shape), 0, 255).astype(np.uint8)
        color = np.repeat(noisy[:, :, None], 3, axis=2)
        shots.append(CameraShot(color, 100.0, (WIDTH / 2, HEIGHT / 2)))
    return LensView.of_shots(shots)


def room() -> NDArray[np.float64]:
    cells = np.random.default_rng(5).integers(50, 150, (6, 8)).astype(np.float64)
    return np.asarray(np.kron(cells, np.ones((HEIGHT // 6, WIDTH // 8))), np.float64)


def test_a_view_is_as_bright_and_as_large_as_its_pictures() -> None:
    seen = view(np.full((HEIGHT, WIDTH), 80.0))
    assert seen.size == (WIDTH, HEIGHT)
    assert seen.light == pytest.approx(80.0, abs=1.5)


def test_noise_is_no_change() -> None:
    assert view(room()).find_change(view(room())) == (0.0, 0.0)


@pytest.mark.parametrize(("middle", "side"), [(16, -0.75), (64, 0.0), (112, 0.75)])
@pytest.mark.parametrize("exposure", [0.7, 1.0, 1.2])
def test_what_came_in_is_found_where_it_is_whatever_the_exposure_does(
    middle: int, side: float, exposure: float
) -> None:
    now = room()
    now[20:70, middle - 12 : middle + 12] = 205.0
    share, where = view(room()).find_change(view(now * exposure))
    assert where == pytest.approx(side, abs=0.1)
    assert 0.03 < share < 0.15


def test_a_mirrored_view_has_its_change_on_the_other_side() -> None:
    now = room()
    now[20:70, 10:30] = 205.0
    _, where = view(room()).find_change(view(now))
    _, mirrored = view(room()[:, ::-1]).find_change(view(now[:, ::-1]))
    assert mirrored == pytest.approx(-where, abs=0.05)


def test_a_cover_takes_light_or_detail() -> None:
    light, _ = view(room()).let_through(view(room() * 0.05))
    assert light < 0.1
    light, detail = view(room()).let_through(view(np.full((HEIGHT, WIDTH), room().mean())))
    assert light == pytest.approx(1.0, abs=0.05), "the camera brightened it"
    assert detail < 0.3
    assert view(room()).let_through(view(room())) == pytest.approx((1.0, 1.0), abs=0.1)
