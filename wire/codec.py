"""Encode messages as JSON and decode them. The only place where bytes are validated.

JSON by pydantic: in schema, in bounds, nothing extra, no NaN, no infinity, within the key's size.
Refusals are values, not exceptions: with the collector off in the bridge, a ValidationError kept
alive by a traceback would leak.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

from pydantic import ValidationError

from wire.base import Record
from wire.errors import DecodeFailure
from wire.keys import SMALL, Key
from wire.sensors import ImageHeader

M = TypeVar("M", bound=Record)


def encode(message: Record) -> bytes:
    """Return compact JSON; the message was checked at birth."""
    return message.__pydantic_serializer__.to_json(message)


def decode(key: Key[M], payload: bytes) -> M | DecodeFailure:
    """Return the message, or a DecodeFailure that says why the bytes are not one."""
    size = len(payload)
    if not size <= key.max_bytes:
        return DecodeFailure("too_large", f"{key.path}: {size} bytes, at most {key.max_bytes}")
    try:
        return key.message.__pydantic_validator__.validate_json(payload, strict=True)  # type: ignore[no-any-return]  # pydantic types this Any; the validator is the message's own
    except ValidationError as error:
        return DecodeFailure("invalid", f"{key.path}: {_first(error)}")
    except RecursionError:
        return DecodeFailure("invalid", f"{key.path}: nested too deeply")


@dataclass(frozen=True, slots=True)
class Image:
    """Hold one picture as received: header and packed bytes."""

    header: ImageHeader
    data: bytes


def image(key: Key[ImageHeader], attached: bytes, payload: bytes) -> Image | DecodeFailure:
    """Return the picture with its header, or a DecodeFailure. Its pixels are judged elsewhere."""
    if not len(payload) <= key.max_bytes or not len(attached) <= SMALL:
        size = f"{len(payload)} bytes, at most {key.max_bytes}"
        return DecodeFailure(
            "too_large", f"{key.path}: {size}; header {len(attached)}, at most {SMALL}"
        )
    if not payload:
        return DecodeFailure("invalid", f"{key.path}: a header without a picture")
    try:
        header = ImageHeader.model_validate_json(attached, strict=True)
    except ValidationError as error:
        return DecodeFailure("invalid", f"{key.path}: {_first(error)}")
    return Image(header, payload)


def _first(error: ValidationError) -> str:
    """Name the first fault and its place, never the offending bytes: they may be hostile."""
    item = error.errors(include_url=False, include_context=False, include_input=False)[0]
    where = ".".join(str(part)[:32] for part in item["loc"][:4]) or "message"
    return f"{where}: {item['msg']}"[:200]
