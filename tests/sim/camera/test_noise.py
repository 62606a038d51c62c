"""Noise is seeded, as large as stated, and lies where a real camera's would."""

from __future__ import annotations

import numpy as np
import pytest

from sim.camera import Frame, spoil

ROWS, COLUMNS = 120, 160


def flat(depth_m: float, level: int = 120, facing: float = 1.0) -> Frame:
    shape = (ROWS, COLUMNS)
    return Frame(
        color=np.full((*shape, 3), level, dtype=np.uint8),
        depth_m=np.full(shape, depth_m, dtype=np.float32),
        ids=np.zeros(shape, dtype=np.int32),
        facing=np.full(shape, facing, dtype=np.float32),
    )


def test_the_same_seed_spoils_the_same_way_and_leaves_the_clean_frame_alone() -> None:
    frame = flat(2.0)
    one, two, other = (spoil(frame, np.random.default_rng(seed)) for seed in (3, 3, 4))
    assert np.array_equal(one.color, two.color)
    assert np.array_equal(one.depth_m, two.depth_m)
    assert not np.array_equal(one.color, other.color)
    assert np.all(frame.color == 120)
    assert np.all(frame.depth_m == 2.0)


@pytest.mark.parametrize("depth_m", [0.5, 2.0, 5.0])
def test_depth_errs_with_the_square_of_the_distance_in_millimetres(depth_m: float) -> None:
    depth = spoil(flat(depth_m), np.random.default_rng(1)).depth_m
    kept = depth[depth > 0.0]
    assert 0.99 < len(kept) / depth.size < 1.0
    assert kept.mean() == pytest.approx(depth_m, abs=0.002)
    assert kept.std() == pytest.approx(0.001 + 0.0018 * depth_m**2, rel=0.05)
    millimetres = kept.astype(float) * 1000.0
    assert np.abs(millimetres - np.round(millimetres)).max() < 1e-2


def test_there_is_no_depth_at_edges_grazed_surfaces_and_where_none_was() -> None:
    rng = np.random.default_rng(1)
    stepped = flat(4.0)
    stepped.depth_m[:, :80] = 2.0
    lost = (spoil(stepped, rng).depth_m == 0.0).mean(axis=0)
    assert lost[80] == 1.0, "the farther side of the step"
    assert max(lost[:80].max(), lost[81:].max()) < 0.1
    assert np.all(spoil(flat(2.0, facing=0.1), rng).depth_m == 0.0)
    assert np.all(spoil(flat(0.0), rng).depth_m == 0.0)


def test_light_wanders_from_picture_to_picture_and_grains_within() -> None:
    rng = np.random.default_rng(1)
    pictures = [spoil(flat(2.0), rng).color.astype(float) for _ in range(60)]
    means = np.array([picture.mean() for picture in pictures])
    assert means.std() / 120 == pytest.approx(0.05, abs=0.02)
    assert pictures[0][..., 0].std() == pytest.approx(1.5 + 0.012 * 120, rel=0.15)
    none = spoil(flat(2.0), rng, 0.0)
    assert np.all(none.color == 120)
    assert np.all(none.depth_m == 2.0)


def test_noise_clips_and_never_wraps() -> None:
    rng = np.random.default_rng(1)
    assert spoil(flat(2.0, level=255), rng, 3.0).color.min() > 150
    assert spoil(flat(2.0, level=0), rng, 3.0).color.max() < 60
