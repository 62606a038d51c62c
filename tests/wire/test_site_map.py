"""The map's name is made of the files that the site points to."""

from __future__ import annotations

from pathlib import Path

import pytest

from wire import Misconfigured, map_id
from wire.site_map import read_map_id


def test_it_is_the_wires_map_id(repository: Path) -> None:
    site = repository / "sites" / "home"
    expected = map_id((site / "map.yaml").read_bytes(), (site / "map.pgm").read_bytes())
    assert read_map_id(site) == expected


@pytest.mark.parametrize(
    "line", ["image: a b.png", "image: 'a b.png' # north up", 'image: "a b.png"\r']
)
def test_quotes_and_comments_are_no_part_of_the_name(tmp_path: Path, line: str) -> None:
    text = f"resolution: 0.05\n{line}\nnegate: 0\n".encode()
    (tmp_path / "map.yaml").write_bytes(text)
    (tmp_path / "a b.png").write_bytes(b"picture")
    assert read_map_id(tmp_path) == map_id(text, b"picture")


def test_what_is_missing_is_named(tmp_path: Path) -> None:
    with pytest.raises(Misconfigured, match=r"map_missing: .*map\.yaml"):
        read_map_id(tmp_path)
    (tmp_path / "map.yaml").write_bytes(b"resolution: 0.05\n")
    with pytest.raises(Misconfigured, match="no line 'image: FILE'"):
        read_map_id(tmp_path)
    (tmp_path / "map.yaml").write_bytes(b"image: gone.pgm\n")
    with pytest.raises(Misconfigured, match=r"map_image_missing: .*gone\.pgm"):
        read_map_id(tmp_path)
