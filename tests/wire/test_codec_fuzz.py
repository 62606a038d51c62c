"""Spoil 5 000 messages of all keys: none crashes the codec, and what it accepts is sound."""

from __future__ import annotations

from typing import Annotated

import pytest
from pydantic import Field

from tests.wire.codec_fuzz import fuzz, is_within
from tests.wire.examples import EXAMPLES
from wire import Stop, Velocity


def test_five_thousand_spoilt_messages_are_refused_or_sound() -> None:
    told = fuzz(7, 5_000, EXAMPLES)
    assert told["tried"] == 5_000
    assert told["bad"] == 0
    assert told["accepted"] > 100, "or nothing was judged"
    assert told["grown_kib"] < 4_096


@pytest.mark.parametrize(
    ("value", "kind", "fits"),
    [
        (1.0, Annotated[float, Field(ge=0.0, le=1.0)], True),
        (1.1, Annotated[float, Field(ge=0.0, le=1.0)], False),
        (float("nan"), float, False),
        (None, Annotated[int, Field(gt=0)] | None, True),
        (0, Annotated[int, Field(gt=0)] | None, False),
        (True, int, False),
        ("ab", Annotated[str, Field(max_length=1)], False),
        ((1, 2), tuple[int, ...], True),
        ((1, "2"), tuple[int, ...], False),
    ],
)
def test_the_judge_knows_good_from_bad(value: object, kind: object, fits: bool) -> None:
    assert is_within(value, kind, ()) is fits


def test_the_judge_sees_a_field_out_of_bounds() -> None:
    good = EXAMPLES[Velocity]
    assert is_within(good, Velocity, ())
    assert not is_within(good.model_copy(update={"v_mps": 1e9}), Velocity, ())
    assert not is_within(good, Stop, ())
