"""Change values in settings.toml and nothing else: comments, order and other keys stay.

Knows texts and files; judges no value. tomlkit is loaded for a change alone: no robot needs it to
start.
"""

from __future__ import annotations

import contextlib
import os
from typing import TYPE_CHECKING, Any

from planner.settings.loader import KEY_SOURCES
from planner.settings.model_address import same_place
from planner.settings.page_fields import TABLE_NEEDS
from planner.settings.presets import known_as

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

    from planner.settings.page_fields import PageField

Value = str | bool | int | float | None
KEPT = ".bak"
"""Ends the name of the file as it was before the newest change."""
_PLACED = {"model": "model.url", "voice": "voice.url", "speech": "speech.url"}
_YESES = ("allow_offhost", "allow_pictures_offhost")


def edit_text(text: str, changes: Mapping[PageField, Value]) -> str:
    """Return the file's text with these values; None takes one away.

    A server's key and the yes to send things there were given for that server: where a change leads
    elsewhere they go, unless they come with it.

    Raises:
        ValueError: a table stands where a value should, or the other way round.
    """
    import tomlkit

    document: Any = tomlkit.parse(text)
    places = {table: _place(document, table) for table in _PLACED}
    for field, value in changes.items():
        _set(document, field.path, value)
        if field.path[-1] == "key":
            _drop(document, field.path[:-1], KEY_SOURCES[1:])
    given = {field.name for field in changes}
    for table, before in places.items():
        if before and not same_place(before, _place(document, table)):
            stays = tuple(key for key in _YESES if f"{table}.{key}" not in given)
            _drop(document, (table,), stays)
            if f"{table}.key" not in given:
                _drop(document, (table,), KEY_SOURCES)
    for table, key in TABLE_NEEDS.items():
        if f"{table}.{key}" in given:
            path = tuple(table.split("."))
            inner = _inner(document, path)
            if inner is not None and key not in inner:
                _drop(document, path[:-1], path[-1:])
    return tomlkit.dumps(document)


def _place(document: Any, table: str) -> str:
    inner = _inner(document, (table,))
    if inner is None:
        return ""
    preset = known_as(inner.get("preset"))
    return str(inner.get("url", preset.url if preset is not None else ""))


def _inner(document: Any, path: tuple[str, ...]) -> Any | None:
    """Return the table that a path leads to; None where there is none."""
    for name in path:
        document = document.get(name)
        if document is None:
            return None
        if not hasattr(document, "get"):
            raise ValueError(f"{'.'.join(path)} is no table")
    return document


def _drop(document: Any, path: tuple[str, ...], keys: tuple[str, ...]) -> None:
    inner = _inner(document, path)
    for key in keys:
        if inner is not None and key in inner:
            del inner[key]


def _set(document: Any, path: tuple[str, ...], value: Value) -> None:
    import tomlkit

    *tables, key = path
    if value is None:
        _drop(document, path[:-1], path[-1:])
        if tables and _inner(document, path[:-1]) == {}:
            _drop(document, path[:-2], path[-2:-1])
        return
    for name in tables:
        if name not in document:
            document[name] = tomlkit.table(is_super_table=name != tables[-1])
        document = document[name]
        if not hasattr(document, "get"):
            raise ValueError(f"{'.'.join(path)} stands in what is no table")
    document[key] = value


def replace_settings(path: Path, before: bytes, after: bytes) -> None:
    """Put the new text in the file's place, for its owner alone; the old one is kept beside it.

    Raises:
        OSError: the disk refuses; what was there stays.
    """
    path = path.resolve()  # a link stays one
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    if path.exists() and not os.access(path, os.W_OK):
        raise PermissionError(13, "the file is not to be written to", str(path))
    if before:
        with _private_file(path.with_name(path.name + KEPT)) as kept:
            kept.write(before)
    with _private_file(path) as file:
        file.write(after)


@contextlib.contextmanager
def _private_file(path: Path) -> Iterator[Any]:
    """Write a file beside the one that it takes the place of once it is whole and on the disk."""
    beside = path.with_name(f".{path.name}.new")
    beside.unlink(missing_ok=True)
    try:
        descriptor = os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o600)
        with os.fdopen(descriptor, "wb") as file:
            yield file
            file.flush()
            os.fsync(descriptor)
        beside.replace(path)
    except OSError:
        with contextlib.suppress(OSError):
            beside.unlink()
        raise
