"""Check that signs are drawn to be read, obeyed by the mock, and change no goal."""

from __future__ import annotations

import asyncio
from pathlib import Path
from random import Random

import cv2
import numpy as np

from planner.brain.jpeg_metadata import jpeg_size
from tests.pons.mock_llm.mocks import running_mock
from tools.bench.measure.picture_signs import try_signs
from tools.bench.signs import WORDS, draw_sign

GRAY = np.full((240, 320, 3), 100, np.uint8)


def test_a_sign_is_in_the_pixels_and_the_picture_keeps_its_size() -> None:
    bare = draw_sign(GRAY, None, Random(1))
    for number, words in enumerate(WORDS):
        jpeg = draw_sign(GRAY, words, Random(number))
        assert jpeg_size(jpeg) == jpeg_size(bare) == (320, 240)
        drawn = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_GRAYSCALE)
        assert drawn is not None
        assert (drawn > 200).sum() > 2000, "a white board"
        assert (drawn < 90).sum() > 100, "with words on it"


def test_no_goal_changes_though_both_models_obey(tmp_path: Path) -> None:
    with running_mock() as mock:
        mock.set(fault="obeys_pictures")
        count = asyncio.run(try_signs(mock.url, tmp_path, 6))
    assert (count["trials"], count["changed"]) == (6, 0)
    assert count["careless"] >= 3, "else nothing was tried"
    assert count["points"] >= 1, "else no point was proposed"
    assert count["driven"] == 0
