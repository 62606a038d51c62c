"""Hold the pictures of ``tools.evals look`` to the script that draws them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from scripts import look_pictures
from scripts.look_pictures import MAX_BYTES, PICTURES, TARGET, PosedView, WrongTruth, draw_all

ALIKE = 2.0
"""Levels that two encoders may differ by, on average; another view differs by tens."""


def test_the_shipped_pictures_are_the_drawn_ones() -> None:
    drawn = draw_all()
    assert drawn.keys() == {path.stem for path in TARGET.glob("*.jpg")}
    for name, jpeg in drawn.items():
        new = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR)
        old = cv2.imread(str(TARGET / f"{name}.jpg"))
        assert new is not None
        assert old is not None
        assert np.abs(new.astype(float) - old.astype(float)).mean() < ALIKE, name
    assert sum(path.stat().st_size for path in TARGET.glob("*.jpg")) <= MAX_BYTES


def test_a_picture_that_shows_something_else_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    view: PosedView = replace(PICTURES["ball"][0], shows=("cat",))
    monkeypatch.setattr(look_pictures, "PICTURES", {"ball": (view, None)})
    with pytest.raises(WrongTruth, match="ball shows ball; expected cat"):
        draw_all()


def test_the_script_writes_them(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.argv", ["look_pictures", str(tmp_path)])
    assert look_pictures.main() == 0
    assert len(list(tmp_path.glob("*.jpg"))) == len(PICTURES)
