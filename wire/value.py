"""Define the decorator of records that a tick makes: frozen to mypy, mutable to the interpreter.

``dataclass(frozen=True)`` writes each field by a call of ``object.__setattr__``: frozen so, a step
of the core costs 1.2 to 1.4 times as much (ADR 0032), for a tick makes 17 of these records beside
its poses and twists. The promise of freezing is kept elsewhere: mypy, a gate of every commit,
refuses any assignment, and a test of the core holds that a step leaves the state it was given.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeVar, dataclass_transform

T = TypeVar("T")


@dataclass_transform(frozen_default=True, field_specifiers=(field,))
def value(cls: type[T]) -> type[T]:
    """Make a slotted dataclass that compares and hashes by its fields; mypy takes it for frozen."""
    return dataclass(slots=True, unsafe_hash=True)(cls)
