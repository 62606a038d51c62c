"""Hold the table of rows to the laws that every row obeys."""

from __future__ import annotations

import pytest

from bridge.core.faults.fault_table import ROWS, STAGES, Clears, FaultRow
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
