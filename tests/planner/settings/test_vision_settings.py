"""Check the owner's settings about seeing: where files are looked for, who wins, what refuses."""

from __future__ import annotations

from pathlib import Path
from typing import get_args

import pytest

from planner.perception.detect.decoders import ALL
from planner.perception.detect.session import ORDER
from planner.settings import FILE, VisionSettings, load_settings
from planner.settings.vision import DecoderName, ProviderName
from wire import ConfigError


def vision(home: Path, text: str = "", **environment: str) -> VisionSettings:
    (home / FILE).write_text(text, "utf-8")
    return load_settings(home, environment).vision


def test_nothing_set_is_the_model_that_comes_with_pons(tmp_path: Path) -> None:
    found = vision(tmp_path)
    assert (found.model, found.labels, found.decoder, found.threads) == (None, None, None, 1)


def test_a_file_is_looked_for_in_the_home_folder(tmp_path: Path) -> None:
    found = vision(tmp_path, '[vision]\nmodel = "best.onnx"\nlabels = "/data/names.txt"\n')
    assert (found.model, found.labels) == (tmp_path / "best.onnx", Path("/data/names.txt"))


def test_the_environment_wins_and_its_files_are_where_the_command_was_given(tmp_path: Path) -> None:
    text = '[vision]\nmodel = "best.onnx"\nthreads = 1\nrate_hz = 2.5\n'
    found = vision(tmp_path, text, PONS_VISION_MODEL="other.onnx", PONS_VISION_THREADS="2",
                   PONS_VISION_DECODER="yolox", PONS_VISION_MIN_SCORE="0.5")  # fmt: skip
    assert found.model == Path("other.onnx").absolute()
    assert (found.threads, found.decoder, found.rate_hz, found.min_score) == (2, "yolox", 2.5, 0.5)


@pytest.mark.parametrize(
    ("text", "environment", "told"),
    [
        ("[vision]\nmodle = 'x'\n", {}, "unknown key 'vision.modle'; known: model, detector"),
        ("vision = 3\n", {}, "vision"),
        ("[vision]\nmodel = 3\n", {}, "vision.model"),
        ("[vision]\ndecoder = 'yolo'\n", {}, "'yolov8'"),
        ("[vision]\ndetector = 'open'\n", {}, "detector = 'open' needs model"),
        ("[vision]\ndetector = 'closed'\n", {}, "vision.detector"),
        ("[vision]\nprovider = 'gpu'\n", {}, "'cuda'"),
        ("[vision]\nthreads = 0\n", {}, "vision.threads"),
        ("[vision]\nrate_hz = nan\n", {}, "vision.rate_hz"),
        ("[vision]\nrate_hz = 0.9\n", {}, "vision.rate_hz"),  # a gaze lasts 6 s
        ("[vision]\nmin_score = 0\n", {}, "vision.min_score"),
        ("[vision]\ninput_px = 100\n", {}, "multiple of 32"),
        ("", {"PONS_VISION_THREADS": "many"}, "vision.threads"),
    ],
)
def test_what_is_wrong_refuses_to_start(
    text: str, environment: dict[str, str], told: str, tmp_path: Path
) -> None:
    with pytest.raises(ConfigError, match="settings_malformed") as caught:
        vision(tmp_path, text, **environment)
    assert told in caught.value.detail


def test_settings_know_every_decoder_and_provider() -> None:
    assert get_args(DecoderName) == tuple(ALL)
    assert get_args(ProviderName) == tuple(ORDER)
