"""Names that differ in anything are never taken for one another, whatever was asked before."""

from __future__ import annotations

import pytest

from planner.plan import Bilingual, Entry, Tool, Vocabulary

HALL = Entry(id="hall", kind="room", name=Bilingual(en="hall", zh="门厅"))
ASKED_BEFORE = Vocabulary(entries=(HALL,), tools=(Tool(name="calendar.events", about="one"),))


@pytest.mark.parametrize(
    "update",
    [
        {"tools": (Tool(name="calendar.events", about="another"),)},
        {"tools": ()},
        {"sentences": "go"},
        {"entries": (HALL.model_copy(update={"aliases": ("lobby",)}),)},
        {"entries": ()},
    ],
)
def test_a_changed_copy_is_another_and_one_unchanged_is_equal(update: dict[str, object]) -> None:
    assert Vocabulary(**ASKED_BEFORE.model_dump()) == ASKED_BEFORE  # its text is kept from now on
    assert hash(ASKED_BEFORE) == hash(ASKED_BEFORE.model_copy())
    changed = ASKED_BEFORE.model_copy(update=update)
    assert changed != ASKED_BEFORE
    assert tuple(changed.by_id.values()) == changed.entries
