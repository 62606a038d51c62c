"""Keep what a suite costs out of anybody's home."""

from __future__ import annotations

from pathlib import Path

import pytest


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    return tmp_path
