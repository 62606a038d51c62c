"""Fingerprint a site's map by its bytes, as every process does."""

from __future__ import annotations

import re
from codecs import BOM_UTF8
from typing import TYPE_CHECKING

from wire.errors import ConfigError
from wire.fingerprint import map_id
from wire.plain_file import read_plain_file

if TYPE_CHECKING:
    from pathlib import Path

MOST_MAP_BYTES = 100_000
MOST_IMAGE_BYTES = 80_000_000
"""64 million pixels of one byte (8000 x 8000), and a head."""

# One key of a flat file: a YAML parser would be the only use of YAML in the processes that ask.
_IMAGE = re.compile(rb"^image:[ \t]*['\"]?([^'\"#\r\n]+?)['\"]?[ \t]*(?:#.*)?\r?$", re.MULTILINE)


def image_name(text: bytes) -> str | None:
    """Return what the text of a map.yaml names as its image; None where it names nothing."""
    named = _IMAGE.search(text.removeprefix(BOM_UTF8))  # Notepad's; YAML reads past it, too
    return None if named is None else named[1].decode("utf-8", "replace")


def image_in(site_dir: Path, name: str) -> Path:
    """Return the path of a map's image, which lies in the folder of its site.

    Raises:
        ValueError: it lies elsewhere, by its name or by a link, or has a name that no file has.
    """
    image = site_dir / name
    if not image.resolve().is_relative_to(site_dir.resolve()):
        raise ValueError(f"it is not in the site's folder {site_dir}")
    return image


def read_map_id(site_dir: Path) -> str:
    """Return the fingerprint of the site's map.yaml and its image.

    Raises:
        ConfigError: ``map_missing``, ``map_image_missing`` or ``map_image_outside``, naming the
            file.
    """
    path = site_dir / "map.yaml"
    try:
        text = read_plain_file(path, MOST_MAP_BYTES)
    except OSError as error:
        raise ConfigError("map_missing", f"{path}: {error.strerror}") from None
    name = image_name(text)
    if name is None:
        raise ConfigError("map_image_missing", f"{path}: no line 'image: FILE'")
    try:
        image = image_in(site_dir, name)
    except ValueError as error:
        raise ConfigError("map_image_outside", f"{path}: image {name!r}: {error}") from None
    try:
        return map_id(text, read_plain_file(image, MOST_IMAGE_BYTES))
    except OSError as error:
        raise ConfigError("map_image_missing", f"{image}: {error.strerror}") from None
