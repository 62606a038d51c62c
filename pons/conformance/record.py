"""Keep a bridge's record from outside: its commands, its word, and the robot's real motion.

Times are this process's monotonic clock at receipt. A command carries its number; the bridge's word
carries its tick; the two differ by the ticks in which no command was sent, which only grows in the
self test and is learnt here. Appended by one thread, read by another.
"""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass, field
from typing import Protocol, TypeVar


@dataclass(frozen=True, slots=True)
class Command:
    """Hold one wheel command, as the drive was told."""

    at_s: float
    number: int
    left_radps: float
    right_radps: float
    enabled: bool


@dataclass(frozen=True, slots=True)
class Word:
    """Hold one word of the bridge on itself."""

    at_s: float
    made_s: float
    """On the bridge's own monotonic clock."""
    boot: str
    tick: int
    missed: int
    mode: str
    moves: bool
    """It says that it follows somebody: ACTIVE or TELEOP."""


@dataclass(frozen=True, slots=True)
class WheelSample:
    """Hold how far the wheels have really turned."""

    at_s: float
    made_s: float
    """On the drive's own clock."""
    number: int
    """Rises by one with each period of the drive; a simulator that is held up skips some."""
    left_rad: float
    right_rad: float
    torque: bool


@dataclass(frozen=True, slots=True)
class Truth:
    """Hold the robot's real motion."""

    at_s: float
    v_mps: float
    w_radps: float
    contacts: int
    """Episodes since start."""


class _HasStamp(Protocol):
    @property
    def at_s(self) -> float: ...


T = TypeVar("T", bound=_HasStamp)


@dataclass
class DriveRecord:
    """Hold all of it, oldest first."""

    commands: list[Command] = field(default_factory=list)
    words: list[Word] = field(default_factory=list)
    wheels: list[WheelSample] = field(default_factory=list)
    truths: list[Truth] = field(default_factory=list)
    unreadable: list[tuple[float, str]] = field(default_factory=list)
    """Commands that are none: out of schema, not finite."""
    offset: int = -(2**60)
    """A command's tick less its number."""

    def learn(self) -> None:
        """Compare the newest word with the newest command, heard no later than that word."""
        if self.words and self.commands:
            self.offset = max(self.offset, self.words[-1].tick - self.commands[-1].number)

    def tick(self, command: Command) -> int:
        """Return the tick in which a command was made."""
        return command.number + self.offset


def between(items: list[T], from_s: float, to_s: float = float("inf")) -> list[T]:
    """Return the messages of a span of time."""
    first = bisect_left(items, from_s, key=_at)
    last = len(items) if to_s == float("inf") else bisect_left(items, to_s, key=_at)
    return items[first:last]


def _at(item: _HasStamp) -> float:
    return item.at_s
