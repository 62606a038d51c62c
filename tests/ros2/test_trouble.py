"""Each code has a cure in both languages and stands on the page."""

from __future__ import annotations

from pathlib import Path

from ros2.trouble import CODES, Ros2Trouble


def test_each_code_is_explained_on_the_page(repository: Path) -> None:
    page = (repository / "docs" / "ros2.md").read_text()
    for code, (english, chinese) in CODES.items():
        assert f"`{code}`" in page, code
        assert english.isascii()
        assert not chinese.isascii()


def test_a_detail_is_as_long_as_the_wire_carries() -> None:
    assert len(Ros2Trouble("ros2_no_node", "x" * 1000).detail) == 400
