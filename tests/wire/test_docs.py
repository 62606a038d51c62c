"""docs/wire.md is printed from the models and true."""

from __future__ import annotations

from pathlib import Path

import pytest

from wire import Record, docs
from wire.keys import KEYS, Key


def test_the_committed_page_is_fresh() -> None:
    assert docs.main(["--check"]) == 0


@pytest.mark.parametrize("key", KEYS, ids=lambda key: key.path)
def test_every_key_and_field_is_documented(key: Key[Record]) -> None:
    page = docs.render()
    assert f"`{key.path}`" in page
    section = page.split(f"## {key.message.__name__}\n", 1)[1].split("\n## ", 1)[0]
    for name in key.message.model_fields:
        assert f"`{name}`" in section


def test_the_page_is_written_and_a_stale_one_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    page = tmp_path / "docs" / "wire.md"
    monkeypatch.setattr(docs, "TARGET", page)
    assert docs.main(["--check"]) == 1
    assert "stale" in capsys.readouterr().err
    assert docs.main([]) == 0
    assert page.read_text("utf-8") == docs.render()
    assert docs.main(["--check"]) == 0
