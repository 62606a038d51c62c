"""Pictures are handed out once, newest first, and whole where their depth comes in time."""

from __future__ import annotations

import pytest

from planner.perception.frame_source import Pictures
from tests.planner.perception.scenes import image
from tests.planner.perception.watching import FakeCamera


@pytest.mark.parametrize("lag_s", [0.0, 0.02, 0.04, None])
@pytest.mark.parametrize("hz", [10.0, 30.0, 60.0])
def test_each_picture_is_handed_out_once_and_whole_at_any_rate(
    hz: float, lag_s: float | None
) -> None:
    """Depth comes a moment after its colour, or never; eyes look every 10 ms."""
    camera = FakeCamera()
    pictures = Pictures(camera, hz)
    taken = [(100.0 + index / hz, index) for index in range(round(4 * hz))]
    soon = [] if lag_s is None else [(came_s + lag_s, index) for came_s, index in taken]
    given: list[tuple[int, bool]] = []
    for tick in range(400):
        now_s = 100.0 + 0.01 * tick
        while taken and taken[0][0] <= now_s:
            came_s, index = taken.pop(0)
            camera.colors.append(image(index, came_s))
        while soon and soon[0][0] <= now_s:
            came_s, index = soon.pop(0)
            camera.depths.append(image(index, came_s, b"d"))
        pictures.poll(now_s, busy=False)
        if (ready := pictures.ready(now_s)) is not None:
            given.append((ready.color.header.seq, ready.depth is not None))
    assert [seq for seq, _ in given] == sorted({seq for seq, _ in given})
    assert len(given) >= min(hz, 15.0) * 4 - 4
    whole = sum(deep for _, deep in given)
    assert whole == (0 if lag_s is None else pytest.approx(len(given), abs=2))


def test_colour_waits_a_moment_for_its_depth() -> None:
    camera = FakeCamera()
    pictures = Pictures(camera)
    camera.colors, camera.depths = [image(1, 1.0)], [image(0, 0.9, b"d")]
    pictures.poll(1.0, busy=False)
    assert pictures.ready(1.0) is None
    camera.depths = [image(1, 1.0, b"d")]
    pictures.poll(1.02, busy=False)
    ready = pictures.ready(1.02)
    assert ready is not None
    assert ready.depth is not None
    assert pictures.ready(1.02) is None  # once
    camera.colors = [image(2, 1.1)]
    pictures.poll(1.1, busy=False)
    assert pictures.newest is not None
    assert pictures.newest.color.header.seq == 1  # the newest that is whole
    assert pictures.ready(1.14) is None
    late = pictures.ready(1.16)
    assert late is not None
    assert late.depth is None
