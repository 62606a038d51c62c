"""The mark of an order's id fits where a name is shown, and tells ids apart but shows none."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from wire.bounded_types import Name
from wire.trial_dialogue import mark_of

IDS = st.from_regex(r"[A-Za-z0-9_.-]{8,64}", fullmatch=True)


@given(IDS, IDS)
def test_a_mark_is_a_name_of_one_id_and_does_not_show_it(one: str, other: str) -> None:
    assert TypeAdapter(Name).validate_python(mark_of(one)) == mark_of(one)
    assert (mark_of(one) == mark_of(other)) is (one == other)
    assert one not in mark_of(one)
