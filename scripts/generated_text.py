"""Write generated files, or say which of them are stale."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path


def write_or_check(texts: Mapping[Path, str], arguments: list[str], cure: str) -> int:
    """Write the texts, or with ``--check`` compare them; 1 where one is stale.

    Args:
        texts: by the file that each stands in.
        arguments: of the command line.
        cure: how a person makes them new.
    """
    stale = 0
    for path, text in texts.items():
        if arguments != ["--check"]:
            path.write_text(text, "utf-8")
        elif not (path.exists() and path.read_text("utf-8") == text):
            print(f"{path} is stale: run {cure}")
            stale = 1
    return stale
