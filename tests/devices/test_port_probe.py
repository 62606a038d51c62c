"""A probe asks no more than a few bytes."""

from __future__ import annotations

import pytest

from devices.port_probe import LONGEST_QUESTION, PortProbe


def test_a_question_that_could_move_something_is_refused() -> None:
    PortProbe("drive", "x", 9_600, lambda _: None, b"?" * LONGEST_QUESTION)
    with pytest.raises(ValueError, match="17 bytes"):
        PortProbe("drive", "x", 9_600, lambda _: None, b"?" * (LONGEST_QUESTION + 1))
