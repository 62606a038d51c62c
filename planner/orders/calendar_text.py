"""Write and read the lines of an iCalendar file (RFC 5545): folding, escapes, components. Pure.

Knows nothing of orders. Strict: what is no such line is refused with its number.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from unicodedata import category

from planner.orders.errors import OrderRefusal

MOST_CHARACTERS = 200_000
_FOLD_BYTES = 75
_ESCAPES = (("\r", ""), ("\\", "\\\\"), (";", "\\;"), (",", "\\,"), ("\n", "\\n"))
_MEANT = {"n": "\n", "N": "\n", "\\": "\\", ";": ";", ",": ","}


@dataclass(frozen=True, slots=True)
class CalendarLine:
    """Hold one property: its name, its parameters and its value as it was written."""

    name: str
    value: str
    parameters: dict[str, str] = field(default_factory=dict)

    @property
    def text(self) -> str:
        """Return the value without its escapes."""
        found, rest = "", iter(self.value)
        for char in rest:
            found += _MEANT.get(following := next(rest, ""), following) if char == "\\" else char
        return found


@dataclass(frozen=True, slots=True)
class Component:
    """Hold an event or a to-do: its properties, each name with all its lines."""

    kind: str
    lines: dict[str, list[CalendarLine]] = field(default_factory=dict)

    def one(self, name: str) -> CalendarLine | None:
        """Return a property that may stand once.

        Raises:
            OrderRefusal: ``calendar_malformed``: it stands twice.
        """
        found = self.lines.get(name, [])
        if len(found) > 1:
            raise OrderRefusal("calendar_malformed", f"{name} stands {len(found)} times",
                               what=name)  # fmt: skip
        return found[0] if found else None

    def text(self, name: str) -> str | None:
        """Return the text of a property that may stand once."""
        line = self.one(name)
        return None if line is None else line.text


def escape(text: str) -> str:
    """Return a text as a value."""
    for char, written in _ESCAPES:
        text = text.replace(char, written)
    return text


def write_lines(lines: list[str]) -> str:
    """Return lines folded, as a file."""
    return "".join(f"{_fold(line)}\r\n" for line in lines)


def _fold(line: str) -> str:
    """Return a line in pieces of 75 bytes at most; no character is cut."""
    pieces: list[str] = []
    piece, size = "", 0
    for char in line:
        width = len(char.encode())
        if size + width > _FOLD_BYTES:
            pieces, piece, size = [*pieces, piece], "", 1  # the space before what follows
        piece, size = piece + char, size + width
    return "\r\n ".join((*pieces, piece))


def read_components(text: str) -> tuple[Component, ...]:
    """Return the events and to-dos of a file; what else it holds (alarms, zones) is passed over.

    Raises:
        OrderRefusal: ``calendar_malformed``.
    """
    if len(text) > MOST_CHARACTERS:
        raise _refuse_file(f"over {MOST_CHARACTERS} characters")
    found: list[Component] = []
    open_: list[str] = []
    unfolded = text.replace("\r\n", "\n").replace("\n ", "").replace("\n\t", "")
    for number, written in enumerate(filter(str.strip, unfolded.split("\n")), 1):
        line = _read_line(written, number)
        if line.name == "BEGIN":
            open_.append(line.value.upper())
            if open_[0] != "VCALENDAR":
                raise _refuse_file(f"line {number}: BEGIN:{line.value[:40]}")
            if open_[1:] in (["VEVENT"], ["VTODO"]):
                found.append(Component(open_[-1]))
        elif line.name == "END":
            if not open_ or open_.pop() != line.value.upper():
                raise _refuse_file(f"line {number}: END:{line.value[:40]}")
        elif not open_ or open_[0] != "VCALENDAR":
            raise _refuse_file(f"line {number}: not within a VCALENDAR")
        elif open_[1:] in (["VEVENT"], ["VTODO"]):
            found[-1].lines.setdefault(line.name, []).append(line)
    if open_ or not unfolded.strip():
        raise _refuse_file("it ends too early")
    return tuple(found)


def _read_line(written: str, number: int) -> CalendarLine:
    head, value, quoted = "", "", False
    for at, char in enumerate(written):
        quoted ^= char == '"'
        if char == ":" and not quoted:
            head, value = written[:at], written[at + 1 :]
            break
    name, *parameters = head.split(";")
    controls = any(category(char) == "Cc" and char != "\t" for char in written)
    if not name or not name.replace("-", "").isalnum() or controls:
        raise _refuse_file(f"line {number}: {written[:40]!r}")
    pairs = (each.partition("=") for each in parameters)
    return CalendarLine(name.upper(), value, {k.upper(): v.strip('"') for k, _, v in pairs})


def _refuse_file(what: str) -> OrderRefusal:
    return OrderRefusal("calendar_malformed", what, what=what)
