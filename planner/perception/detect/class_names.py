"""Read class names, from a model's metadata or the owner's labels file. Literals, never code."""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Mapping
from pathlib import Path

from planner.perception.failure import VisionFailure

MAX_TEXT = 200_000
MAX_NAMES = 2_000
MAX_NAME = 80
KEYS = ("names", "class_names")
NOBODY = frozenset({"", "background", "n_a", "none", "no_object"})
"""Ids of classes that are none."""


def literal(text: str) -> object:
    """Return the value that a text writes as JSON or as a Python literal; None if neither."""
    if len(text) > MAX_TEXT:
        return None
    try:
        value: object = json.loads(text)
    except (ValueError, RecursionError):
        try:
            value = ast.literal_eval(text)
        except (ValueError, SyntaxError, RecursionError, MemoryError, TypeError):
            return None
    return value


def label_id(name: str) -> str:
    """Return a class's id: lower case, words joined by ``_``; '' for a class that is none."""
    joined = re.sub(r"\W+", "_", name.strip().lower()).strip("_")[:MAX_NAME]
    return "" if joined in NOBODY else joined


def names_in(metadata: Mapping[str, str]) -> tuple[str, ...]:
    """Return the ids of the classes that metadata name; none where they name none.

    Raises:
        VisionFailure: ``model_names_malformed``.
    """
    for key in KEYS:
        if metadata.get(key, "").strip():
            return _ids(literal(metadata[key]), f"metadata {key}")
    return ()


def names_of(path: Path) -> tuple[str, ...]:
    """Return the ids in a labels file: one name a line, or JSON.

    Raises:
        VisionFailure: ``model_names_missing`` or ``model_names_malformed``.
    """
    try:
        with path.open("rb") as file:
            raw = file.read(MAX_TEXT + 1)
    except OSError as error:
        raise VisionFailure("model_names_missing", f"{path}: {error.strerror}") from None
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise VisionFailure("model_names_malformed", f"{path} is not UTF-8") from None
    if len(raw) > MAX_TEXT:
        raise VisionFailure("model_names_malformed", f"{path} is over {MAX_TEXT} bytes")
    if text.lstrip()[:1] in ("[", "{"):
        return _ids(literal(text), str(path))
    return _ids(text.rstrip().splitlines(), str(path))


def _ids(names: object, where: str) -> tuple[str, ...]:
    """Return ids by number, from a list or from a mapping of number to name."""
    if isinstance(names, dict):
        names = _by_number(names, where)
    if not isinstance(names, list | tuple) or not len(names) <= MAX_NAMES:
        raise VisionFailure("model_names_malformed", f"{where}: expected a list of names")
    if not all(isinstance(name, str) for name in names):
        raise VisionFailure("model_names_malformed", f"{where}: a name that is no text")
    return tuple(label_id(name) for name in names)


def _by_number(names: Mapping[object, object], where: str) -> list[object]:
    """Return the names in the order of their numbers; a number that is left out has no name."""
    try:
        numbered = {int(str(number)): name for number, name in names.items()}
    except ValueError:
        numbered = {-1: None}
    if not all(0 <= number < MAX_NAMES for number in numbered):
        text = f"{where}: expected numbers from 0 with a name each"
        raise VisionFailure("model_names_malformed", text)
    return [numbered.get(number, "") for number in range(max(numbered, default=-1) + 1)]
