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

from maps.errors import BilingualError, SiteError
from maps.file_errors import system_reason_zh, too_long_zh
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
            zh = f"{path}：{too_long_zh(most_bytes)}"
            raise SiteError("value_malformed", f"{path}: {error.strerror}", zh) from error
        text, zh = f"cannot read {path}: {error.strerror}", system_reason_zh(error)
        raise SiteError("site_file_missing", text, f"缺少站点文件 {path}：{zh}") from error


def parse_yaml(data: bytes, model: type[R], where: Path) -> R:
    """Turn YAML text into a record.

    Raises:
        SiteError: ``yaml_malformed``, ``unknown_key`` or ``value_malformed``.
    """
    try:
        value = yaml.load(data, Loader=_UniqueKeys)
    except UNREADABLE as error:
        zh = f"{where}：YAML 格式错误：{_why_zh(error)}"
        raise SiteError("yaml_malformed", f"{where}: {error}", zh) from error
    return validate_record(value, model, where)


def parse_json(data: bytes, model: type[R], where: Path) -> R:
    """Turn JSON text into a record.

    Raises:
        SiteError: ``json_malformed``, ``unknown_key`` or ``value_malformed``.
    """
    try:
        value = json.loads(data, object_pairs_hook=_unique_pairs)
    except (ValueError, RecursionError) as error:
        zh = f"{where}：JSON 格式错误：{_why_zh(error)}"
        raise SiteError("json_malformed", f"{where}: {error}", zh) from error
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


def _why_zh(error: Exception) -> str:
    """Return why YAML or JSON could not be read, in Chinese: the line and column, where known."""
    if isinstance(error, BilingualError):
        return error.zh
    if isinstance(error, RecursionError):
        return "嵌套过深"
    if isinstance(error, json.JSONDecodeError):
        return f"第 {error.lineno} 行第 {error.colno} 列不符合 JSON 语法"
    if isinstance(error, UnicodeDecodeError | yaml.reader.ReaderError):
        return "含有无法识别的字节；应为 UTF-8 文本"
    mark = error.problem_mark if isinstance(error, yaml.MarkedYAMLError) else None
    if mark is not None:
        return f"第 {mark.line + 1} 行第 {mark.column + 1} 列无法读取"
    return "其中的值无法读取"


class _UniqueKeys(yaml.SafeLoader):
    """Load plain YAML; refuse a key that is given twice, and any alias."""

    def compose_node(self, parent: yaml.Node | None, index: int) -> yaml.Node | None:
        """Refuse aliases: ten lines of them name more values than any memory holds."""
        if self.check_event(yaml.AliasEvent):
            event = self.peek_event()  # type: ignore[no-untyped-call]  # PyYAML says no types
            line = event.start_mark.line + 1
            text = f"line {line}: an alias (*); write the value out"
            raise BilingualError(text, f"第 {line} 行是别名（*）；请把值直接写出")
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
            raise BilingualError(f"the key {key!r} is not a string", f"键 {key!r} 不是文字")
        if key in found:
            raise BilingualError(f"the key {key!r} is given twice", f"键 {key!r} 出现了两次")
        found[key] = value
    return found


_UniqueKeys.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, _mapping)
