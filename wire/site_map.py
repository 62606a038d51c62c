"""Name the map of a site by its bytes, as every process does. Reads files; knows no cells."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from wire.errors import Misconfigured
from wire.fingerprint import map_id

if TYPE_CHECKING:
    from pathlib import Path

# One key of a flat file: a YAML parser would be the only use of YAML in the processes that ask.
_IMAGE = re.compile(rb"^image:[ \t]*['\"]?([^'\"#\r\n]+?)['\"]?[ \t]*(?:#.*)?\r?$", re.MULTILINE)


def read_map_id(site_dir: Path) -> str:
    """Return the fingerprint of the site's map.yaml and its image.

    Raises:
        Misconfigured: ``map_missing`` or ``map_image_missing``, naming the file.
    """
    path = site_dir / "map.yaml"
    try:
        text = path.read_bytes()
    except OSError as error:
        raise Misconfigured("map_missing", f"{path}: {error.strerror}") from None
    named = _IMAGE.search(text)
    if named is None:
        raise Misconfigured("map_image_missing", f"{path}: no line 'image: FILE'")
    image = site_dir / named[1].decode("utf-8", "replace")
    try:
        return map_id(text, image.read_bytes())
    except (OSError, ValueError) as error:
        raise Misconfigured("map_image_missing", f"{image}: {error}") from None
