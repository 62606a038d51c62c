"""Read class names, from a model's metadata or the owner's labels file. Literals, never code.

A class may have several names: ``umbrella stand | 雨伞架`` on a line, in JSON a list of them or
``{"en": "umbrella stand", "zh": "雨伞架"}``. The first is the class's own; people may say any.
"""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from planner.perception.failure import VisionFailure

MAX_TEXT = 200_000
MAX_NAMES = 2_000
MAX_NAME = 80
MAX_WORDS = 8
"""Names of one class."""
BESIDE = ".names"
"""Ending of a labels file that is found by itself: ``world.names`` beside ``world.onnx``."""
_WORDS = re.compile(r"[\w'][\w' -]{0,39}")
KEYS = ("names", "class_names")
NOBODY = frozenset({"", "background", "n_a", "none", "no_object"})
"""Ids of classes that are none."""


class ClassNames(NamedTuple):
    """Hold the names of a model's classes, by number."""

    ids: tuple[str, ...] = ()
    words: tuple[tuple[str, ...], ...] = ()
    """All that people may call each class, where it was given more than one name."""


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


def names_in(metadata: Mapping[str, str]) -> ClassNames:
    """Return the classes that metadata name; none where they name none.

    Raises:
        VisionFailure: ``model_names_malformed``.
    """
    for key in KEYS:
        if metadata.get(key, "").strip():
            return _read(literal(metadata[key]), f"metadata {key}")
    return ClassNames()


def names_of(path: Path) -> ClassNames:
    """Return the classes in a labels file: one a line, or JSON.

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
        return _read(literal(text), str(path))
    lines = [line.split("|") if "|" in line else line for line in text.rstrip().splitlines()]
    return _read(lines, str(path))


def _read(names: object, where: str) -> ClassNames:
    """Return classes by number, from a list or from a mapping of number to name."""
    if isinstance(names, dict):
        names = _by_number(names, where)
    if not isinstance(names, list | tuple) or not len(names) <= MAX_NAMES:
        raise VisionFailure("model_names_malformed", f"{where}: expected a list of names")
    several = [_words_of(entry) for entry in names]
    if any(words is None for words in several):
        raise VisionFailure("model_names_malformed", f"{where}: a name that is no text")
    found = [words for words in several if words is not None]
    odd = next((w for words in found for w in words[1:] if not _WORDS.fullmatch(w)), None)
    if odd is not None or any(len(words) > MAX_WORDS for words in found):
        told = f"the name {odd[:40]!r}" if odd is not None else f"over {MAX_WORDS} names of a class"
        text = f"{where}: {told}; expected letters, digits, spaces, at most 40"
        raise VisionFailure("model_names_malformed", text)
    words = tuple(words if len(words) > 1 else () for words in found)
    ids = tuple(label_id(words[0]) if words else "" for words in found)
    return ClassNames(ids, words if any(words) else ())


def _words_of(entry: object) -> tuple[str, ...] | None:
    """Return the names of one class, its own first; None where they are no text."""
    if isinstance(entry, dict) and entry.keys() <= {"en", "zh"}:
        entry = [entry[language] for language in ("en", "zh") if language in entry]
    names = entry if isinstance(entry, list | tuple) else [entry]
    if not all(isinstance(name, str) for name in names):
        return None
    first, *others = [str(name).strip() for name in names] or [""]
    return (first, *filter(None, others))


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
