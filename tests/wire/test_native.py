"""A record made of plain slots passes for the dataclass that it stands for."""

from __future__ import annotations

from dataclasses import asdict, fields

import pytest
from pydantic import TypeAdapter

from wire.native import dress, replace


class Point:
    """Stand for a compiled record: a constructor, and no dataclass about it."""

    def __init__(self, x_m: float, y_m: float = 2.0, tags: list[str] | None = None) -> None:
        self.x_m, self.y_m = x_m, y_m
        self.tags: list[str] = [] if tags is None else tags


ANNOTATIONS = {"x_m": "float", "y_m": "float", "tags": "list[str]"}
dress(Point, ANNOTATIONS, {"y_m": 2.0}, {"tags": list}, {"extra": "forbid"})


def test_it_has_fields_with_their_defaults_and_factories() -> None:
    one, two, three = fields(Point)  # type: ignore[arg-type]  # dressed as one
    assert (one.name, two.name, three.name) == tuple(ANNOTATIONS)
    assert (two.default, three.default_factory) == (2.0, list)
    assert Point.__slots__ == tuple(ANNOTATIONS)  # type: ignore[attr-defined]  # dressed


def test_it_is_replaced_told_and_taken_apart_like_one() -> None:
    moved = replace(Point(1.0), y_m=5.0)
    assert asdict(moved) == {"x_m": 1.0, "y_m": 5.0, "tags": []}  # type: ignore[call-overload]  # dressed
    assert repr(moved).endswith("Point(x_m=1.0, y_m=5.0, tags=[])")


def test_pydantic_reads_it_by_its_own_rules() -> None:
    adapter = TypeAdapter(Point)
    assert adapter.validate_python({"x_m": 1}).y_m == 2.0
    with pytest.raises(ValueError, match="z_m"):
        adapter.validate_python({"x_m": 1, "z_m": 3})


def test_without_rules_of_its_own_it_gets_none() -> None:
    class Bare:
        def __init__(self, x_m: float) -> None:
            self.x_m = x_m

    dress(Bare, {"x_m": "float"}, {}, {})
    assert not hasattr(Bare, "__pydantic_config__")
    assert replace(Bare(1.0), x_m=3.0).x_m == 3.0
