"""Change values in robot.toml and nothing else: comments, order and other keys stay as they are.

A new file is written beside it, read back as the bridge would, and only then put in its place; the
old one stays as ``robot.toml.bak-<utc>``. Knows text and files; no robot.
"""

from __future__ import annotations

import contextlib
import difflib
import os
import re
import shutil
import tomllib
from copy import deepcopy
from typing import TYPE_CHECKING, Any

from pons.calibrate.errors import CalibrationRefusal
from wire import load_robot

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from pons.calibrate.findings import CalibrationFinding

MARK = "# calibrated "
_TABLE = re.compile(r"^\s*\[\s*(?P<name>[A-Za-z0-9_-]+)\s*\]\s*(#.*)?$")
_KEY = re.compile(
    r"^(?P<head>\s*(?P<key>[A-Za-z0-9_-]+)\s*=\s*)(?P<value>[^#\s]+)(?P<tail>\s*(#.*)?)$"
)


def edit_values(text: str, found: Sequence[CalibrationFinding]) -> str:
    """Return the file's text with these values, each below its evidence.

    Raises:
        CalibrationRefusal: ``robot_toml_shape``: written otherwise than one key a line.
    """
    lines = text.splitlines()
    for one in found:
        lines = _with(lines, one)
    after = "\n".join(lines) + "\n"
    wanted = _expected_content(text, found)
    with contextlib.suppress(tomllib.TOMLDecodeError):
        if tomllib.loads(after) == wanted:
            return after
    values = ", ".join(f"{one.name} = {one.value!r}" for one in found)
    raise CalibrationRefusal("robot_toml_shape", values)


def _expected_content(text: str, found: Sequence[CalibrationFinding]) -> dict[str, Any]:
    told = deepcopy(tomllib.loads(text))
    for one in found:
        told.setdefault(one.table, {})[one.key] = one.value
    return told


def _with(lines: list[str], one: CalibrationFinding) -> list[str]:
    """Return the lines with one value set."""
    begin, end = _table(lines, one.table)
    if begin is None:
        return [*lines, "", f"[{one.table}]", f"# {one.evidence}", f"{one.key} = {one.value!r}"]
    for at in range(begin, end):
        match = _KEY.match(lines[at])
        if match is not None and match["key"] == one.key:
            line = f"{match['head']}{one.value!r}{match['tail']}"
            first = at - 1 if lines[at - 1].startswith(MARK) else at
            return [*lines[:first], f"# {one.evidence}", line, *lines[at + 1 :]]
    while end > begin and not lines[end - 1].strip():
        end -= 1
    return [*lines[:end], f"# {one.evidence}", f"{one.key} = {one.value!r}", *lines[end:]]


def _table(lines: list[str], name: str) -> tuple[int | None, int]:
    """Return where a table's keys begin and where they end; None where there is no such table."""
    begin: int | None = None
    for at, line in enumerate(lines):
        match = _TABLE.match(line)
        if match is not None and begin is not None:
            return begin, at
        if match is not None and match["name"] == name:
            begin = at + 1
    return begin, len(lines)


def difference(path: Path, before: str, after: str) -> str:
    """Return the changes, as diff -u shows them."""
    return "\n".join(
        difflib.unified_diff(
            before.splitlines(), after.splitlines(), str(path), str(path), lineterm="", n=1
        )
    )


def replace(path: Path, before: str, after: str, stamp: str) -> Path:
    """Put the new text in the file's place; return where the old one is kept.

    Raises:
        CalibrationRefusal: ``robot_toml_shape``: the file changed meanwhile.
        ConfigError: the new file would be refused.
        OSError: it cannot be written.
    """
    if path.read_text("utf-8") != before:
        raise CalibrationRefusal("robot_toml_shape", f"{path} was changed meanwhile")
    fresh = path.with_name(f"{path.name}.new-{os.getpid()}")
    kept = path.with_name(f"{path.name}.bak-{stamp}")
    try:
        with fresh.open("w", encoding="utf-8") as file:
            file.write(after)
            file.flush()
            os.fsync(file.fileno())
        shutil.copymode(path, fresh)
        load_robot(fresh)
        shutil.copy2(path, kept)
        os.replace(fresh, path)  # noqa: PTH105  # atomic, which is what is wanted here
    finally:
        fresh.unlink(missing_ok=True)
    return kept
