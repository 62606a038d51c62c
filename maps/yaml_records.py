"""Read YAML and JSON text into checked records. Sites' YAML is read here alone.

Unknown keys, duplicate keys and numbers that are not finite are refused, never ignored: a key
that is silently dropped is a limit that somebody believes in.
"""

from __future__ import annotations

import errno
import json
from pathlib import Path
from typing import Any, TypeVar

import yaml
from pydantic import BaseModel, ConfigDict, ValidationError

from maps.errors import SiteError
from maps.value_flaws import describe
from wire.plain_file import read_plain_file

MAX_TEXT_BYTES = 4_000_000
"""A site of a thousand places is a tenth of this; more is a mistake or an attack on memory."""


UNREADABLE = (yaml.YAMLError, ValueError, LookupError, AttributeError, TypeError, RecursionError)
"""What PyYAML ends in: beside its own errors whatever its makers of values raise, for it tells a
``!!bool x`` by KeyError, a ``!!timestamp x`` by AttributeError and a ``!!int ''`` by IndexError."""


class SiteRecord(BaseModel):
    """Be the frozen, closed base of every record that a site file holds."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


R = TypeVar("R", bound=BaseModel)


def read_bytes(path: Path, most_bytes: int = MAX_TEXT_BYTES) -> bytes:
    """Return a site file's bytes.

    Raises:
        SiteError: ``site_file_missing`` or ``value_malformed`` when it is too long.
    """
    try:
        return read_plain_file(path, most_bytes)
    except OSError as error:
        if error.errno == errno.EFBIG:
            raise SiteError("value_malformed", f"{path}: {error.strerror}") from error
        raise SiteError("site_file_missing", f"cannot read {path}: {error.strerror}") from error


def parse_yaml(data: bytes, model: type[R], where: Path) -> R:
    """Turn YAML text into a record.

    Raises:
        SiteError: ``yaml_malformed``, ``unknown_key`` or ``value_malformed``.
    """
    try:
        value = yaml.load(data, Loader=_UniqueKeys)
    except UNREADABLE as error:
        raise SiteError("yaml_malformed", f"{where}: {error}") from error
    return validate_record(value, model, where)


def parse_json(data: bytes, model: type[R], where: Path) -> R:
    """Turn JSON text into a record.

    Raises:
        SiteError: ``json_malformed``, ``unknown_key`` or ``value_malformed``.
    """
    try:
        value = json.loads(data, object_pairs_hook=_unique_pairs)
    except (ValueError, RecursionError) as error:
        raise SiteError("json_malformed", f"{where}: {error}") from error
    return validate_record(value, model, where)


def validate_record(value: object, model: type[R], where: Path) -> R:
    """Turn plain values into a record; ``where`` names them in a refusal.

    Raises:
        SiteError: ``unknown_key`` or ``value_malformed``.
    """
    try:
        return model.model_validate(value)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        known = tuple(sorted(model.model_fields))
        if first["type"] in ("extra_forbidden", "unexpected_keyword_argument"):
            at = ".".join(map(str, first["loc"]))
            text, zh = f"{where}: unknown key {at!r}", f"{where}：未知的键 {at!r}"
            if len(first["loc"]) == 1:
                keys = ", ".join(known)
                text, zh = f"{text}; known keys of the file: {keys}", f"{zh}；文件可用的键：{keys}"
            raise SiteError("unknown_key", text, zh) from None
        english, chinese = describe(first, known)
        text = f"{where}: {english}"
        raise SiteError("value_malformed", text, f"{where}：{chinese}") from None


class _UniqueKeys(yaml.SafeLoader):
    """Load plain YAML; refuse a key that is given twice, and any alias."""

    def compose_node(self, parent: yaml.Node | None, index: int) -> yaml.Node | None:
        """Refuse aliases: ten lines of them name more values than any memory holds."""
        if self.check_event(yaml.AliasEvent):
            event = self.peek_event()  # type: ignore[no-untyped-call]  # PyYAML says no types
            line = event.start_mark.line + 1
            raise ValueError(f"line {line}: an alias (*); write the value out")
        return super().compose_node(parent, index)


def _mapping(loader: _UniqueKeys, node: yaml.MappingNode) -> dict[Any, Any]:
    pairs = [
        (loader.construct_object(key, deep=True), loader.construct_object(value, deep=True))
        for key, value in node.value
    ]
    return _unique_pairs(pairs)


def _unique_pairs(pairs: list[tuple[Any, Any]]) -> dict[Any, Any]:
    found: dict[Any, Any] = {}
    for key, value in pairs:
        if not isinstance(key, str):
            raise ValueError(f"the key {key!r} is not a string")
        if key in found:
            raise ValueError(f"the key {key!r} is given twice")
        found[key] = value
    return found


_UniqueKeys.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, _mapping)
