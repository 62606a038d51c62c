"""Mutants are the same for a seed, bounded in size, and not all alike."""

from __future__ import annotations

from random import Random

import pytest

from tools.attack.mutators import CHANGES, MOST_BYTES, mutant

SEEDS = (b'{"a": 1}', b"stop", bytes(range(200)))


def test_a_seed_gives_the_same_mutants_again() -> None:
    first = [mutant(SEEDS, Random(3)) for _ in range(5)]
    assert first == [mutant(SEEDS, Random(3)) for _ in range(5)]


@pytest.mark.parametrize("most", [0, 1, 64, MOST_BYTES])
def test_a_mutant_is_no_larger_than_it_may_be(most: int) -> None:
    random = Random(2)
    large = (bytes(MOST_BYTES), b"x")
    assert all(len(mutant(large, random, most)) <= most for _ in range(100))


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("data", [b"", b"a", bytes(range(256))])
def test_every_change_takes_any_bytes(change: object, data: bytes) -> None:
    assert callable(change)
    for seed in range(50):
        change(bytearray(data), SEEDS, Random(seed))


def test_without_seeds_there_is_no_mutant() -> None:
    with pytest.raises(ValueError, match="empty"):
        mutant((), Random(1))
