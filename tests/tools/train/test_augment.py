"""Change frames: boxes go where what they hold goes."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from tools.train.augment import WHOLE, augment, clip_boxes, decode, mirror, shrunk, zoom_and_shift
from tools.train.batches import Feeder, pad
from tools.train.budget import HEIGHT_PX, SMALL_PX, STRIDES, WIDTH_PX, Schedule
from tools.train.store import StoredFrame

BOX = (200.0, 60.0, 240.0, 120.0)


def painted() -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]]:
    """Return a dark picture with one bright box in it."""
    picture = np.zeros((HEIGHT_PX, WIDTH_PX, 3), np.uint8)
    picture[60:120, 200:240] = 255
    return picture


def framed(*things: tuple[float, ...]) -> StoredFrame:
    _, data = cv2.imencode(".png", painted())
    return StoredFrame(data.tobytes(), np.array(things, np.float32).reshape(-1, 6))


def bright(picture: np.ndarray[tuple[int, ...], np.dtype[np.uint8]]) -> tuple[int, ...]:
    down, across = np.nonzero(picture[:, :, 0] > 200)
    return across.min(), down.min(), across.max() + 1, down.max() + 1


def test_a_mirrored_box_holds_what_it_held() -> None:
    picture, things = mirror(painted(), framed((3, *BOX, 1)).things)
    assert tuple(things[0, 1:5]) == bright(picture) == (80, 60, 120, 120)


@pytest.mark.parametrize("seed", range(6))
def test_a_moved_box_holds_what_it_held(seed: int) -> None:
    frame = framed((3, *BOX, 1))
    picture, things = zoom_and_shift(painted(), frame.things, np.random.default_rng(seed))
    if things[0, 5] > 0:
        assert np.abs(things[0, 1:5] - bright(picture)).max() <= 1.5
    assert picture.shape == (HEIGHT_PX, WIDTH_PX, 3)


@pytest.mark.parametrize(
    ("right", "down", "left_over", "judged"),
    [
        (0.0, 0.0, BOX, 1),
        (60.0, 0.0, (260.0, 60.0, 300.0, 120.0), 1),
        (90.0, 0.0, (290.0, 60.0, 320.0, 120.0), 1),
        (110.0, 0.0, (310.0, 60.0, 320.0, 120.0), -1),
        (0.0, 178.0, (200.0, 238.0, 240.0, 240.0), -1),
        (130.0, 0.0, None, 0),
    ],
)
def test_what_is_mostly_cut_off_is_not_judged(
    right: float, down: float, left_over: tuple[float, ...] | None, judged: int
) -> None:
    rows = clip_boxes(framed((3, *BOX, 1)).things, 1.0, (right, down), WHOLE)
    assert [tuple(row) for row in rows] == ([] if left_over is None else [(3, *left_over, judged)])


def test_a_smaller_frame_holds_the_same_and_asks_for_nothing_too_small() -> None:
    frame = framed((3, *BOX, 1), (10, 10, 10, 16, 40, 1))
    picture, things = shrunk(painted(), frame.things, SMALL_PX)
    assert picture.shape == (SMALL_PX[1], SMALL_PX[0], 3)
    assert tuple(things[0, 1:5].round()) == bright(picture) == (120, 36, 144, 72)
    assert things[:, 5].tolist() == [1, -1]
    assert all(side % STRIDES[-1] == 0 for side in SMALL_PX)


def test_a_plain_frame_is_mirrored_at_most() -> None:
    frame = framed((3, *BOX, 1))
    mirrored, _ = mirror(painted(), frame.things)
    for seed in range(8):
        picture, _ = augment(frame, np.random.default_rng(seed), plain=True)
        assert any(np.array_equal(picture, whole) for whole in (painted(), mirrored))


def test_the_same_generator_gives_the_same_frame() -> None:
    frame = framed((3, *BOX, 1), (1, 0, 0, 50, 50, -1))
    picture, things = augment(frame, np.random.default_rng(4))
    again, same = augment(frame, np.random.default_rng(4))
    assert np.array_equal(picture, again)
    assert np.array_equal(things, same)
    assert picture.dtype == np.uint8


def test_what_is_no_picture_of_ours_is_refused() -> None:
    _, small = cv2.imencode(".png", np.zeros((10, 10, 3), np.uint8))
    for data in (b"", b"no picture", small.tobytes()):
        with pytest.raises(ValueError, match="no JPEG"):
            decode(data)


def test_each_epoch_shows_every_frame_once() -> None:
    frames = [framed((index, *BOX, 1)) for index in range(5)]
    feeder = Feeder(frames, Schedule(epochs=2, batch=2, small_share=0.5, plain_share=0.25))
    assert (feeder.steps_an_epoch, feeder.steps) == (2, 4)
    assert feeder.batch(1).pictures.shape == (2, SMALL_PX[1], SMALL_PX[0], 3)
    batch = feeder.batch(2)
    assert batch.pictures.shape == (2, HEIGHT_PX, WIDTH_PX, 3)
    assert 0.0 <= batch.pictures.min() <= batch.pictures.max() <= 1.0
    assert np.array_equal(batch.pictures, feeder.batch(2).pictures)
    first = {int(row[0]) for step in (0, 1) for row in feeder.batch(step).targets[:, 0]}
    assert len(first) == 4
    assert [feeder.is_plain(step) for step in range(4)] == [False, False, False, True]
    with pytest.raises(ValueError, match="do not fill a batch"):
        Feeder(frames, Schedule(batch=6))


def test_the_rate_rises_then_falls() -> None:
    feeder = Feeder([framed()] * 4, Schedule(epochs=100, batch=2, warm_steps=20, peak_rate=1.0))
    rates = [feeder.rate(step) for step in range(feeder.steps)]
    assert rates[:20] == sorted(rates[:20])
    assert rates[20:] == sorted(rates[20:], reverse=True)
    assert max(rates) == 1.0
    assert 0.02 <= rates[-1] < 0.021


def test_missing_rows_are_padded() -> None:
    rows = pad([np.ones((2, 6), np.float32), np.zeros((0, 6), np.float32)])
    assert rows.shape == (2, 2, 6)
    assert rows[1].sum() == 0.0
    assert pad([np.zeros((0, 6), np.float32)]).shape == (1, 1, 6)
