"""Each layout names types that there are, and both names of a type say the same."""

from __future__ import annotations

import pytest

from ros2.layouts import LAYOUTS, _field, dds_name, ros_name

NUMBERS = {"int8", "uint8", "int32", "uint32", "float32", "float64", "string"}


def test_every_field_is_of_a_type_that_has_a_layout() -> None:
    kinds = {field.kind for fields in LAYOUTS.values() for field in fields}
    assert kinds - NUMBERS <= set(LAYOUTS)


@pytest.mark.parametrize("kind", sorted(LAYOUTS))
def test_a_type_is_found_again_by_its_name_in_dds(kind: str) -> None:
    assert ros_name(dds_name(kind)) == kind


@pytest.mark.parametrize("strange", ["Twist", "a::b::C_", "a::msg::dds_::C", "", "a::b::c::d_::E_"])
def test_a_name_that_is_no_message_of_ros_stays(strange: str) -> None:
    assert ros_name(strange) == strange


def test_a_text_that_is_no_field_is_refused() -> None:
    with pytest.raises(ValueError, match="no field"):
        _field("float64[ x")
