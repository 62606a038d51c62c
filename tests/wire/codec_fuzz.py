"""Flip bits in messages and cut them short: what the codec still accepts is in schema and bounds.

Every key's example is spoilt by seed. An accepted message is judged by its annotations alone, not
by the validator that accepted it. The collector is off, as in the bridge, and memory is watched.
"""

from __future__ import annotations

import gc
from dataclasses import fields, is_dataclass
from enum import Enum
from math import isfinite
from random import Random
from types import NoneType, UnionType
from typing import (
    TYPE_CHECKING,
    Annotated,
    Any,
    Literal,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

import annotated_types
import psutil
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from wire import DecodeFailure, Record, decode, encode
from wire.keys import KEYS

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from wire.keys import Key

WARM = 2_000


def spoilt(data: bytes, random: Random) -> bytes:
    """Return bytes with one to four bits flipped, and every fourth time cut short."""
    body = bytearray(data)
    for _ in range(random.choice((1, 1, 2, 4))):
        if body:
            body[random.randrange(len(body))] ^= 1 << random.randrange(8)
    if random.random() < 0.25:
        del body[random.randrange(len(body) + 1) :]
    return bytes(body)


def fuzz(seed: int, count: int, examples: Mapping[type[Record], Record]) -> dict[str, int]:
    """Spoil, decode and judge so many messages over all keys.

    Raises:
        AssertionError: never; what is wrong is counted under ``bad``.
    """
    random = Random(seed)
    told = {"tried": 0, "accepted": 0, "bad": 0, "grown_kib": 0}
    whole = [(key, encode(examples[key.message])) for key in KEYS]
    process = psutil.Process()
    collected = gc.isenabled()
    gc.collect()
    gc.disable()
    try:
        base = 0
        for index in range(count):
            if index == min(WARM, count // 2):
                base = process.memory_info().rss
            key, data = whole[index % len(whole)]
            answer = decode(key, spoilt(data, random))
            told["tried"] += 1
            if not isinstance(answer, DecodeFailure):
                told["accepted"] += 1
                told["bad"] += not sound(key, answer)
        told["grown_kib"] = (process.memory_info().rss - base) // 1024
    finally:
        if collected:
            gc.enable()
    return told


def sound(key: Key[Record], message: Record) -> bool:
    """Tell whether a message is what its key's annotations allow, and says the same again."""
    again = encode(message)
    same = decode(key, again) == message and len(again) <= key.max_bytes
    return same and type(message) is key.message and is_within(message, key.message, ())


def is_within(value: Any, kind: Any, bounds: Iterable[Any]) -> bool:
    """Tell whether a value is of its annotated type and inside its annotated bounds."""
    origin = get_origin(kind)
    if origin is Annotated:
        return is_within(value, get_args(kind)[0], (*get_args(kind)[1:], *bounds))
    if origin in {Union, UnionType}:
        return any(is_within(value, one, bounds) for one in get_args(kind))
    if origin is Literal:
        return value in get_args(kind)
    if not all(_keeps(value, bound) for bound in bounds):
        return False
    if origin is tuple:
        return isinstance(value, tuple) and _items(value, get_args(kind))
    if kind in {None, NoneType}:
        return value is None
    if isinstance(kind, type) and issubclass(kind, BaseModel | Enum):
        return type(value) is kind and (isinstance(value, Enum) or _fields(value))
    if is_dataclass(kind):
        return type(value) is kind and _fields(value)
    if kind is float:
        return type(value) in {int, float} and isfinite(value)
    return type(value) is kind


def _fields(record: Any) -> bool:
    hints = get_type_hints(type(record), include_extras=True)
    bounds: dict[str, Iterable[Any]]
    if isinstance(record, BaseModel):
        bounds = {name: field.metadata for name, field in type(record).model_fields.items()}
    else:
        bounds = {field.name: () for field in fields(record)}
    return all(is_within(getattr(record, name), hints[name], bounds[name]) for name in bounds)


def _items(value: tuple[Any, ...], kinds: tuple[Any, ...]) -> bool:
    if len(kinds) == 2 and kinds[1] is Ellipsis:
        return all(is_within(one, kinds[0], ()) for one in value)
    pairs = zip(value, kinds, strict=False)
    return len(value) == len(kinds) and all(is_within(*pair, ()) for pair in pairs)


def _keeps(value: Any, bound: Any) -> bool:
    if isinstance(bound, FieldInfo):
        return all(_keeps(value, one) for one in bound.metadata)
    if value is None:
        return True
    checks: dict[type, Any] = {
        annotated_types.Ge: lambda: value >= bound.ge,
        annotated_types.Gt: lambda: value > bound.gt,
        annotated_types.Le: lambda: value <= bound.le,
        annotated_types.Lt: lambda: value < bound.lt,
        annotated_types.MinLen: lambda: len(value) >= bound.min_length,
        annotated_types.MaxLen: lambda: len(value) <= bound.max_length,
    }
    check = checks.get(type(bound))
    return check is None or bool(check())
