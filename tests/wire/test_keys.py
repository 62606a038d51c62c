"""The key table agrees with itself and with who can reach whom."""

from __future__ import annotations

import re

import pytest

from wire import Record
from wire.keys import FEW, KEYS, LATEST, SEQUENCED, Key, Party
from wire.sockets import DIALS, LISTENERS


def linked(one: Party, other: Party) -> bool:
    return other in DIALS[one] or one in DIALS[other]


def test_paths_are_unique() -> None:
    assert len({key.path for key in KEYS}) == len(KEYS)


@pytest.mark.parametrize("key", KEYS, ids=lambda key: key.path)
def test_every_pair_of_a_key_has_a_link_of_its_own(key: Key[Record]) -> None:
    """Nobody relays, so a pair without a link would never receive."""
    pairs = [(s, r) for s in key.senders for r in key.receivers if s != r]
    assert pairs
    assert [pair for pair in pairs if not linked(*pair)] == []


@pytest.mark.parametrize("key", KEYS, ids=lambda key: key.path)
def test_rings_and_expressions_are_sane(key: Key[Record]) -> None:
    assert key.ring in (LATEST, FEW, SEQUENCED)
    assert re.fullmatch(r"[a-z_]+(/[a-z_]+)?", key.path)
    assert key.expression("r1") == f"pons/r1/{key.path}"


def test_only_listeners_are_dialled() -> None:
    assert {party for dialled in DIALS.values() for party in dialled} <= set(LISTENERS)
