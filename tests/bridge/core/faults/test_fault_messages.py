"""Hold the words of the rows to the rows."""

from __future__ import annotations

import pytest

from bridge.core.faults.fault_messages import WORDS
from bridge.core.faults.fault_table import ROWS, FaultRow
from bridge.core.safety_page import PATH


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.id)
def test_every_row_has_words_and_is_documented(row: FaultRow) -> None:
    page = PATH.read_text("utf-8")
    assert f"`{row.id}`" in page
    en, zh = WORDS[row.id]
    assert en in page
    assert zh in page
    for stage in row.stages:
        assert stage.window in page


def test_words_belong_to_rows() -> None:
    assert set(WORDS) == {row.id for row in ROWS}
