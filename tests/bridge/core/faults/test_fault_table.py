"""Hold the table of rows to the laws that every row obeys."""

from __future__ import annotations

import pytest

from bridge.core.faults.fault_messages import WORDS
from bridge.core.faults.fault_table import ROWS, STAGES, Clears, FaultRow
from bridge.core.safety_page import PATH
from wire import SEVERITY, Action


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.id)
def test_only_what_caps_or_holds_clears_by_itself(row: FaultRow) -> None:
    for stage in row.stages:
        if stage.clears in {Clears.AUTO, Clears.ON_GRANT}:
            assert SEVERITY[stage.action] <= SEVERITY[Action.HOLD2]
        assert (stage.action is Action.CAP) == (
            stage.cap_factor is not None or stage.cap_mps is not None or stage.cap_zone
        )
        assert stage.name.startswith(f"{stage.row}.")


def test_stage_names_are_unique() -> None:
    assert len(STAGES) == sum(len(row.stages) for row in ROWS)


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
