"""Spoil good inputs without knowing what they mean. Pure: the same seed gives the same inputs.

Structure-blind on purpose: a mutator that knows a format tries what its author thought of.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from random import Random

MOST_BYTES = 65_536
"""Of a mutant, where nobody sets less."""
MOST_CHANGES = 6
EDGES = (
    *(b"\x00", b"\xff", b"\x7f", b"\x80", b"\x00\x00\x00\x00", b"\xff\xff\xff\xff"),
    *(b"\xff\xff\xff\x7f", b"\x00\x00\x00\x80", b"\xff" * 8, b"\xff" * 7 + b"\x7f"),
    *(b"-1", b"0", b"1e309", b"-0.0", b"NaN", b"Infinity", b"null", b"true", b'""', b"[]", b"{}"),
    *(b"9" * 20, b"9" * 400, b"9" * 5000, b"1e-400", b"0x1F", b"2001-99-99", b"1:60:60"),
    *(b'"', b"'", b"\\", b"\\u0000", b"\\ud800", b"\r\n", b"\t", b"#", b":", b"- ", b"? ", b"<<"),
    *(b"&a ", b"*a", b"!!python/object:x", b"---\n", b"[" * 500, b"{" * 500, b'{"a":' * 300),
    *(b"[[x]]\n", b"x.y = 1\n", b"%s%n", b"../../etc/passwd", b"\xc0\x80", b"\xed\xa0\x80"),
    *("\u202e".encode(), "\u200d".encode(), "\ufeff".encode(), "\u0301".encode() * 50),
    *("停".encode(), "ｓｔｏｐ".encode(), "st\u043ep".encode(), "🛑".encode(), "İ".encode()),
    *(b"stop", b" and ", b"don't ", b"\n", b"," * 200, b" " * 400, b"a" * 400, b"-" * 400),
)
"""Values at which readers break: edges of numbers, of nesting, of encodings, of words."""


def mutant(seeds: Sequence[bytes], random: Random, most_bytes: int = MOST_BYTES) -> bytes:
    """Return one of the seeds, changed in one to six ways and cut at a size.

    Raises:
        ValueError: there are no seeds.
    """
    data = bytearray(seeds[random.randrange(len(seeds))])
    for _ in range(random.randint(1, MOST_CHANGES)):
        change = CHANGES[random.randrange(len(CHANGES))]
        change(data, seeds, random)
    return bytes(data[:most_bytes])


def _flip(data: bytearray, _seeds: Sequence[bytes], random: Random) -> None:
    """Flip a bit."""
    if data:
        data[random.randrange(len(data))] ^= 1 << random.randrange(8)


def _set(data: bytearray, _seeds: Sequence[bytes], random: Random) -> None:
    """Put any byte in the place of another."""
    if data:
        data[random.randrange(len(data))] = random.randrange(256)


def _insert(data: bytearray, _seeds: Sequence[bytes], random: Random) -> None:
    """Put an edge somewhere between."""
    at = random.randint(0, len(data))
    data[at:at] = EDGES[random.randrange(len(EDGES))]


def _overwrite(data: bytearray, _seeds: Sequence[bytes], random: Random) -> None:
    """Put an edge over what is there."""
    edge = EDGES[random.randrange(len(EDGES))]
    at = random.randint(0, len(data))
    data[at : at + len(edge)] = edge


def _delete(data: bytearray, _seeds: Sequence[bytes], random: Random) -> None:
    """Leave a piece out."""
    start, end = _piece(data, random)
    del data[start:end]


def _repeat(data: bytearray, _seeds: Sequence[bytes], random: Random) -> None:
    """Say a piece again and again, as far as a mutant may grow."""
    start, end = _piece(data, random)
    room = max(0, MOST_BYTES - len(data))
    times = random.choice((1, 1, 2, 8, 64))
    data[end:end] = (data[start:end] * times)[:room]


def _move(data: bytearray, _seeds: Sequence[bytes], random: Random) -> None:
    """Take a piece out and put it elsewhere."""
    start, end = _piece(data, random)
    piece = data[start:end]
    del data[start:end]
    at = random.randint(0, len(data))
    data[at:at] = piece


def _cut(data: bytearray, _seeds: Sequence[bytes], random: Random) -> None:
    """Cut the end off."""
    del data[random.randint(0, len(data)) :]


def _splice(data: bytearray, seeds: Sequence[bytes], random: Random) -> None:
    """Go on as another seed does."""
    other = seeds[random.randrange(len(seeds))]
    at, begin = random.randint(0, len(data)), random.randint(0, len(other))
    data[at:] = other[begin : begin + MOST_BYTES]


def _number(data: bytearray, _seeds: Sequence[bytes], random: Random) -> None:
    """Put a number of 1, 2, 4 or 8 bytes over what is there, either end first."""
    size = random.choice((1, 2, 4, 8))
    value = random.choice((0, 1, -1, 2 ** (8 * size - 1), 2 ** (8 * size - 1) - 1, len(data)))
    at = random.randint(0, max(0, len(data) - size))
    order = random.choice(("little", "big"))
    data[at : at + size] = (value % 2 ** (8 * size)).to_bytes(size, order)


def _piece(data: bytearray, random: Random) -> tuple[int, int]:
    """Return from where to where a piece goes; small ones are as likely as large ones."""
    start = random.randint(0, len(data))
    longest = min(len(data) - start, random.choice((1, 4, 16, 256, 4096)))
    return start, start + random.randint(0, longest)


CHANGES: tuple[Callable[[bytearray, Sequence[bytes], Random], None], ...] = (
    _flip, _set, _insert, _overwrite, _delete, _repeat, _move, _cut, _splice, _number
)  # fmt: skip
