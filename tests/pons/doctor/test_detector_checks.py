"""The doctor opens the owner's detector as the robot would, and names the layouts that are read."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from planner.perception.detect.decoders import ALL
from pons.doctor.detector_checks import detector
from pons.doctor.finding import HealthFinding, HealthVerdict
from tests.known import known
from tests.planner.perception.detect import tiny
from wire import RobotDescription

pytestmark = pytest.mark.nightly(keep=2)


def looked(home: Path, vision: str = "", **camera: Any) -> HealthFinding:
    home.mkdir(exist_ok=True)
    (home / "settings.toml").write_text(f"[vision]\n{vision}\n")
    told = {"camera": camera or {"kind": "sim"}}
    return detector(home, RobotDescription.model_validate(told))


def test_a_robot_without_a_camera_needs_none(tmp_path: Path) -> None:
    assert looked(tmp_path, kind="none").verdict is HealthVerdict.OK


def test_a_detr_without_batches_is_named_with_how_it_is_read(tmp_path: Path) -> None:
    outputs, beside = tiny.rtdetr_alone([]), (tiny.sizes(),)
    tiny.model(tmp_path / "m.onnx", outputs, metadata=tiny.ULTRALYTICS, beside=beside)
    found = looked(tmp_path, 'model = "m.onnx"')
    assert found.verdict is HealthVerdict.OK, found
    assert found.found.en == "m.onnx, read as rtdetr, 64 x 64, 2 kinds"


def test_an_open_vocabulary_model_is_named_beside_ours(tmp_path: Path) -> None:
    tiny.model(tmp_path / "world.onnx", tiny.mmyolo([]), metadata=tiny.ULTRALYTICS)
    found = looked(tmp_path, 'model = "world.onnx"\ndetector = "open"')
    assert found.verdict is HealthVerdict.OK, found
    assert found.found.en.startswith("pons_home.onnx, read as end_to_end")
    assert found.found.en.endswith("beside it world.onnx, read as mmyolo, 64 x 64, 2 kinds")
    refused = looked(tmp_path, 'detector = "open"')
    assert refused.verdict is HealthVerdict.FAIL
    assert "needs model" in refused.found.en


def test_one_that_is_refused_has_its_code_its_shapes_and_the_layouts(tmp_path: Path) -> None:
    outputs = tiny.rtdetr_alone([]) | {"boxes": np.zeros((10, 5), np.float32)}
    tiny.model(tmp_path / "m.onnx", outputs, metadata=tiny.ULTRALYTICS)
    found = looked(tmp_path, 'model = "m.onnx"')
    assert found.verdict is HealthVerdict.FAIL
    assert found.found.en.startswith("model_layout_unknown: ")
    assert "boxes 10x5; expected for rtdetr labels n, boxes n x 4" in found.found.en
    assert all(layout in known(found.fix).en and layout in known(found.fix).zh for layout in ALL)
    assert any(ord(letter) > 0x2E80 for letter in found.found.zh)


@pytest.mark.parametrize("text", ["[vision]\nmodle = 1\n", "[mission]\nbogus = 1\n"])
def test_settings_that_can_t_be_read_have_their_own_cure(tmp_path: Path, text: str) -> None:
    (tmp_path / "settings.toml").write_text(text)
    found = detector(tmp_path, RobotDescription.model_validate({"camera": {"kind": "sim"}}))
    assert found.verdict is HealthVerdict.FAIL
    assert known(found.fix).en == "mend settings.toml"


def test_without_any_it_warns_that_nothing_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("planner.perception.process_client.DEFAULT_MODEL", tmp_path / "none.onnx")
    found = looked(tmp_path)
    assert found.verdict is HealthVerdict.WARN
    assert found.found.en == "none is installed: nothing is seen"
