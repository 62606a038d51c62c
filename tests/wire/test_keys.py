"""The key table agrees with itself and with who can reach whom."""

from __future__ import annotations

import re

import pytest

from wire import Record
from wire.keys import FEW, KEYS, LATEST, SEQUENCED, Key


def test_paths_are_unique() -> None:
    assert len({key.path for key in KEYS}) == len(KEYS)


@pytest.mark.parametrize("key", KEYS, ids=lambda key: key.path)
def test_rings_and_expressions_are_sane(key: Key[Record]) -> None:
    assert key.ring in (LATEST, FEW, SEQUENCED)
    assert re.fullmatch(r"[a-z_]+([0-9]?/[a-z_]+)?", key.path)
    assert key.expression("r1") == f"pons/r1/{key.path}"
