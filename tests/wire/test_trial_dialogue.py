"""The mark of an order's id fits where a name is shown, and tells ids apart but shows none."""

from __future__ import annotations

from string import ascii_letters, digits

from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from wire.bounded_types import Name
from wire.trial_dialogue import mark_of

IDS = st.text(ascii_letters + digits + "_.-", min_size=8, max_size=64)
NAME = TypeAdapter[str](Name)


@given(IDS, IDS)
def test_a_mark_is_a_name_of_one_id_and_does_not_show_it(one: str, other: str) -> None:
    assert NAME.validate_python(mark_of(one)) == mark_of(one)
    assert (mark_of(one) == mark_of(other)) is (one == other)
    assert one not in mark_of(one)
