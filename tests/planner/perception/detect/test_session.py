"""Hold when what a model puts out is taken for no answer at all."""

from __future__ import annotations

import numpy as np
import pytest

from planner.perception.detect.session import senseless

FINE = np.linspace(0.0, 1.0, 10_000, dtype=np.float32).reshape(1, 100, 100)


@pytest.mark.parametrize("kind", [np.float16, np.float32, np.float64])
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_only_an_output_without_any_finite_number_is_senseless(
    bad: float, kind: type[np.floating]
) -> None:
    first_bad = FINE.astype(kind)
    first_bad[0, 0, 0] = bad
    nothing = np.full_like(first_bad, bad)
    assert not senseless([FINE])
    assert not senseless([first_bad])
    assert senseless([nothing])
    assert senseless([FINE, nothing])


def test_whole_numbers_and_empty_outputs_have_nothing_to_be_senseless() -> None:
    assert not senseless([np.zeros((1, 0, 6), np.float32), np.zeros(3, np.int64)])
    assert not senseless([])
