"""Say what is wrong in a file that a person wrote, without repeating what is secret in it.

Knows text and values; not files, and no model. A password may stand in a URL of robot.toml, and
what is said here stands in logs and on a page.
"""

from __future__ import annotations

import difflib
import re
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

LONGEST = 80
"""Characters of a value that are repeated."""
AT_END = "(at end of document)"
"""How tomllib says that a file was cut."""
_PLACE = re.compile(r"\(at line (\d+), column (\d+)\)$")
_LOGIN = re.compile(r"//.*@")
_EXPECTED: Mapping[str, str] = {
    r"^/.+$": "expected a path that begins with /",
    "dict_type": "expected a table",
    "model_type": "expected a table",
}
"""By type of pydantic's error, or by pattern; what is not here is said in pydantic's own words."""


def describe_error(item: Mapping[str, Any], known: Sequence[str]) -> str:
    """Return one of pydantic's errors in one sentence.

    Args:
        item: of ``ValidationError.errors()``.
        known: keys of the table that an unknown key stood in.
    """
    kind, where = item["type"], [str(part) for part in item["loc"]]
    place, message = ".".join(where) or "whole file", str(item["msg"])
    if kind == "extra_forbidden":
        return _describe_unknown(place, where[-1], known)
    if kind == "missing":
        return f"{place} is missing"
    if kind == "value_error":  # of keys that don't fit together; our sentence names their values
        sentence = message.removeprefix("Value error, ")
        return sentence if not where or where[-1] in sentence else f"{place}: {sentence}"
    pattern = item.get("ctx", {}).get("pattern", "")
    wanted = _EXPECTED.get(kind) or _EXPECTED.get(pattern, message)
    return f"{place}: got {show_value(item['input'])}; {wanted}"


def describe_syntax(text: str, error: ValueError) -> str:
    """Return why a text is no TOML: the line and key where it breaks, and what is likely wrong."""
    said = str(error)
    if text.startswith("\ufeff"):
        return "it begins with a byte order mark; save it as UTF-8 without one"
    lines = text.splitlines()
    if said.endswith(AT_END):
        last = f"line {len(lines)}{_key_of(lines[-1])}" if lines else "line 1"
        return f"{said}: it breaks off in {last}; was it cut?"
    at = _PLACE.search(said)
    if at is None or not 0 < int(at[1]) <= len(lines):
        return said
    line, column = lines[int(at[1]) - 1], int(at[2])
    met = repr(line[column - 1]) if 0 < column <= len(line) else "the end of the line"
    return f"{said}{_key_of(line)}: not understood from {met} on"


def find_broken_line(error: BaseException) -> str:
    """Return where a text is no TOML, in brackets and without a word of it; '' where unknown.

    Of bytes that are no UTF-8 it tells the line, and the encoding that they begin with.
    """
    if isinstance(error, UnicodeDecodeError):
        if error.object.startswith((BOM_UTF16_LE, BOM_UTF16_BE)):
            return " (it is in UTF-16; save it as UTF-8)"
        line = error.object[: error.start].count(b"\n") + 1
        return f" (line {line} is in another encoding; save the file as UTF-8)"
    at = _PLACE.search(str(error))
    return f" (line {at[1]})" if at else ""


def show_value(value: object) -> str:
    """Return a value as it may be repeated: short, one line, no table's content, no password."""
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, list):
        return "a list"
    text = _LOGIN.sub("//***@", repr(value))
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}…"


def _describe_unknown(place: str, key: str, known: Sequence[str]) -> str:
    beside = f", known there: {', '.join(known)}" if known else ""
    alike = difflib.get_close_matches(key, known, 1)
    meant = f"; is {alike[0]!r} meant?" if alike else ""
    return f"unknown key {place!r}{beside}{meant}"


def _key_of(line: str) -> str:
    """Return the key or table that a line sets; never its value, which may be a password."""
    head = line.partition("=")[0].strip() if "=" in line else ""
    if not head and line.lstrip().startswith("["):
        head = line.strip()
    return f", {head[:LONGEST]!r}" if head else ""
