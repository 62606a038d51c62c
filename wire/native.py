"""Give a compiled record what a dataclass has, so that pydantic and ``replace`` know it.

A compiled record is a C struct with a constructor of its own. Used only by what
``scripts/compile_core.py`` makes; the source has real dataclasses.
"""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

R = TypeVar("R")

_COPIED = (
    "__annotations__",
    "__dataclass_fields__",
    "__dataclass_params__",
    "__match_args__",
    "__repr__",
)


def dress(
    cls: Any,
    annotations: Mapping[str, str],
    defaults: Mapping[str, object],
    factories: Mapping[str, Callable[[], object]],
    config: object = None,
) -> None:
    """Let a class pass for the dataclass that it was made of.

    Args:
        cls: the compiled class.
        annotations: each field's, as written in the source.
        defaults: of the fields that have one.
        factories: of the fields whose default is made anew each time.
        config: its ``__pydantic_config__``.
    """
    made = dataclasses.make_dataclass(
        cls.__name__,
        [_field(name, text, defaults, factories) for name, text in annotations.items()],
        eq=False,
    )
    for attribute in _COPIED:
        setattr(cls, attribute, getattr(made, attribute))
    cls.__slots__ = tuple(annotations)
    if config is not None:
        cls.__pydantic_config__ = config


def _field(
    name: str,
    text: str,
    defaults: Mapping[str, object],
    factories: Mapping[str, Callable[[], object]],
) -> Any:
    if name in factories:
        return name, text, dataclasses.field(default_factory=factories[name])
    if name in defaults:
        return name, text, dataclasses.field(default=defaults[name])
    return name, text


def replace(record: R, **changes: Any) -> R:
    """Do what ``dataclasses.replace`` does; the compiler does not know the record for one."""
    return dataclasses.replace(record, **changes)  # type: ignore[type-var]  # it is dressed as one
