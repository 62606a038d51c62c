"""Whether something is there is asked in many ways, and looked at in one."""

from __future__ import annotations

from collections.abc import Callable

import pytest

Understood = Callable[[str], str]


def test_how_it_is_there_is_no_thing(understood: Understood) -> None:
    assert "点热" not in understood("厨房是不是有点热")


@pytest.mark.parametrize("said", ["去客厅看到晚上七点", "去书房守到九点", "看到天亮"])
def test_until_when_is_no_part_of_what_is_looked_at(understood: Understood, said: str) -> None:
    assert understood(said).startswith(("clarify", "refuse"))


@pytest.mark.parametrize("said", ["你别回去", "你回去看看", "你回去吗"])
def test_what_is_denied_asked_or_more_does_not(understood: Understood, said: str) -> None:
    assert understood(said) != "return_home"
