"""Run `pons detect` on tiny models: what it prints, what it refuses, what it draws."""

from __future__ import annotations

import json
from pathlib import Path

import cv2
import pytest

from pons.__main__ import main
from tests.known import known
from tests.planner.perception.detect import tiny
from tests.planner.perception.detect.tiny import Seen

LEFT, TOP, RIGHT, BOTTOM = 16, 12, 48, 40


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    return tmp_path


@pytest.fixture
def model(tmp_path: Path) -> str:
    box = (float(LEFT), float(TOP) + 8.0, float(RIGHT), float(BOTTOM) + 8.0)
    outputs = tiny.yolov8([Seen(box, 1, 0.9)])  # the picture lies 8 px below the input's top
    return str(tiny.model(tmp_path / "m.onnx", outputs, metadata=tiny.ULTRALYTICS))


@pytest.fixture
def picture(tmp_path: Path) -> str:
    (tmp_path / "p.jpg").write_bytes(tiny.jpeg(64, 48))
    return str(tmp_path / "p.jpg")


def test_it_says_what_was_chosen_and_what_it_sees(
    model: str, picture: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["detect", picture, "--model", model]) == 0
    told = capsys.readouterr().out
    for line in (
        "model: m.onnx, input 64x64",
        "decoder: yolov8 (metadata: 2 names; output output0 1x6x84)",
        "provider: cpu (first of:",
        "classes: 2: person, cup",
        f"{picture}: 64x48, 1 found,",
        "  cup 0.90  left 16 top 12 right 48 bottom 40  red",
    ):
        assert line in told


def test_json_holds_the_same(
    model: str, picture: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out.png"
    assert main(["detect", picture, "--model", model, "--json", "--out", str(out)]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["about"]["decoder"] == "yolov8"
    (found,) = told["pictures"][0]["detections"]
    assert (found["label"], found["box"]) == ("cup", [LEFT, TOP, RIGHT, BOTTOM])
    drawn = known(cv2.imread(str(out)))
    assert drawn[TOP, (LEFT + RIGHT) // 2].tolist() != drawn[2, 2].tolist()


def test_the_owner_s_settings_name_the_model(
    home: Path, model: str, picture: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (home / "settings.toml").write_text(f'[vision]\nmodel = "{Path(model).name}"\n')
    assert main(["detect", picture]) == 0
    assert "1 found" in capsys.readouterr().out
    (home / "settings.toml").write_text("[vision]\nmodle = 'm.onnx'\n")
    assert main(["detect", picture]) == 2
    assert "settings_malformed" in capsys.readouterr().err


def test_what_can_t_be_used_is_refused_in_both_languages(
    home: Path, model: str, picture: str, capsys: pytest.CaptureFixture[str]
) -> None:
    broken = home / "broken.onnx"
    broken.write_bytes(Path(model).read_bytes()[:500])
    assert main(["detect", picture, "--model", str(broken)]) == 1
    told = capsys.readouterr().err
    assert "model_truncated: the model file is cut off" in told
    assert "模型文件不完整" in told
    assert main(["detect", picture, str(broken), "--model", model]) == 1
    told = capsys.readouterr().out
    assert "1 found" in told
    assert "skipped, picture_not_known: it is neither JPEG nor PNG / 既不是" in told
    assert main(["detect", picture, picture, "--model", model, "--out", "x.png"]) == 2
    assert main(["detect", str(home / "none.jpg"), "--model", model]) == 2
    assert main(["detect", picture, "--model", model, "--out", str(home / "p.words")]) == 2


def test_without_any_detector_it_says_how_to_name_one(
    home: Path, picture: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("pons.detect.DEFAULT_MODEL", home / "none.onnx")
    assert main(["detect", picture]) == 1
    told = capsys.readouterr().err
    assert "no_detector" in told
    assert "--model" in told
