"""The map's name is made of the files that the site points to."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from wire import ConfigError, map_id
from wire.site_map import read_map_id


def test_it_is_the_wires_map_id(repository: Path) -> None:
    site = repository / "sites" / "home"
    expected = map_id((site / "map.yaml").read_bytes(), (site / "map.pgm").read_bytes())
    assert read_map_id(site) == expected


@pytest.mark.parametrize(
    "line",
    ["image: a b.png", "image: 'a b.png' # north up", 'image: "a b.png"\r', "\ufeffimage: a b.png"],
)
def test_quotes_and_comments_are_no_part_of_the_name(tmp_path: Path, line: str) -> None:
    head = "" if line.startswith("\ufeff") else "resolution: 0.05\n"  # a mark begins the file
    text = f"{head}{line}\nnegate: 0\n".encode()
    (tmp_path / "map.yaml").write_bytes(text)
    (tmp_path / "a b.png").write_bytes(b"picture")
    assert read_map_id(tmp_path) == map_id(text, b"picture")


def test_what_is_missing_is_named(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"map_missing: .*map\.yaml"):
        read_map_id(tmp_path)
    (tmp_path / "map.yaml").write_bytes(b"resolution: 0.05\n")
    with pytest.raises(ConfigError, match="no line 'image: FILE'"):
        read_map_id(tmp_path)
    (tmp_path / "map.yaml").write_bytes(b"image: gone.pgm\n")
    with pytest.raises(ConfigError, match=r"map_image_missing: .*gone\.pgm"):
        read_map_id(tmp_path)


@pytest.mark.parametrize("name", ["../outside.pgm", "/etc/hostname", "link.pgm", "a/../../o.pgm"])
def test_an_image_outside_the_sites_folder_is_refused(tmp_path: Path, name: str) -> None:
    site = tmp_path / "site"
    site.mkdir()
    (tmp_path / "outside.pgm").write_bytes(b"secret")
    (site / "link.pgm").symlink_to(tmp_path / "outside.pgm")
    (site / "map.yaml").write_text(f"image: {name}\n")
    with pytest.raises(ConfigError, match=r"map_image_outside: .*map\.yaml: image"):
        read_map_id(site)


@pytest.mark.timeout(10)
def test_what_is_no_file_or_too_large_is_refused_at_once(tmp_path: Path) -> None:
    (tmp_path / "map.yaml").write_bytes(b"image: map.pgm\n")
    os.mkfifo(tmp_path / "map.pgm")
    with pytest.raises(ConfigError, match=r"map_image_missing: .*not a regular file"):
        read_map_id(tmp_path)
    (tmp_path / "map.pgm").unlink()
    with (tmp_path / "map.pgm").open("wb") as file:
        file.truncate(2 << 30)
    with pytest.raises(ConfigError, match=r"map_image_missing: .*more than 80000000 bytes"):
        read_map_id(tmp_path)
    with (tmp_path / "map.yaml").open("wb") as file:
        file.truncate(2 << 30)
    with pytest.raises(ConfigError, match=r"map_missing: .*more than 100000 bytes"):
        read_map_id(tmp_path)


def test_a_map_is_named_by_both_its_files() -> None:
    assert map_id(b"a", b"b") != map_id(b"a", b"c") != map_id(b"b", b"c")
    assert map_id(b"a", b"b") != map_id(b"ab", b"")
    assert len(map_id(b"a", b"b")) == 16
