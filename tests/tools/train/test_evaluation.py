"""Ask an exported model about frames: bytes go in as they are unpacked, rows come out."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.planner.perception.detect import tiny
from tools.train.budget import CLASSES, HEIGHT_PX, WIDTH_PX
from tools.train.evaluation import ScoredModel


@pytest.fixture
def model(tmp_path: Path) -> ScoredModel:
    return ScoredModel(tiny.of_bytes(tmp_path / "m.onnx", (1, HEIGHT_PX, WIDTH_PX, 3), {}))


@pytest.mark.parametrize(("blue_green_red", "number"), [((255, 0, 0), 0), ((0, 0, 255), 2)])
def test_pictures_go_in_blue_green_red(
    blue_green_red: tuple[int, int, int], number: int, model: ScoredModel
) -> None:
    (found,) = model.detect(tiny.jpeg(WIDTH_PX, HEIGHT_PX, blue_green_red))
    assert found.label == CLASSES[number]
    assert found.score == pytest.approx(254 / 255, abs=0.005)
    assert found.box == (8, 24, 56, 40)
    assert len(model.seconds) == 1


def test_a_picture_in_which_nothing_is_found_is_empty(model: ScoredModel) -> None:
    assert model.detect(tiny.jpeg(WIDTH_PX, HEIGHT_PX, (90, 90, 90))) == []
