"""Hold that value records compare, hash, replace and travel as JSON like any frozen dataclass."""

from __future__ import annotations

from dataclasses import replace

import pytest
from pydantic import TypeAdapter, ValidationError

from wire.geometry import Pose2
from wire.value import value


@value
class Pair:
    """Be two numbers."""

    a: float
    b: float = 2.0


def test_equal_fields_make_equal_values() -> None:
    assert Pair(1.0) == Pair(1.0, 2.0) != Pair(1.0, 3.0)
    assert {Pair(1.0), Pair(1.0)} == {Pair(1.0)}


def test_a_replaced_value_leaves_the_first_as_it_was() -> None:
    first = Pair(1.0)
    assert replace(first, a=5.0) == Pair(5.0)
    assert first == Pair(1.0)


def test_a_value_has_no_room_for_other_names() -> None:
    with pytest.raises(AttributeError):
        setattr(Pair(1.0), "c", 3.0)  # noqa: B010  # mypy refuses the plain form


def test_bounds_hold_where_bytes_come_in() -> None:
    adapter = TypeAdapter(Pose2)
    pose = Pose2(1.5, -2.0, 0.1)
    assert adapter.validate_json(adapter.dump_json(pose)) == pose
    for bad in (b'{"x_m":1,"y_m":2}', b'{"x_m":1e9,"y_m":2,"yaw_rad":0}', b"[1,2,3]"):
        with pytest.raises(ValidationError):
            adapter.validate_json(bad)
