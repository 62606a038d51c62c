"""A table shows goals beside figures and marks what is invalid."""

from __future__ import annotations

import pytest

from tools.bench.report import ReportRow, number, row_of, table


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0"), (0.1234, "0.123"), (1.239, "1.24"), (12.34, "12.3"), (1234.5, "1234")],
)
def test_numbers_have_three_digits_and_no_powers(value: float, text: str) -> None:
    assert number(value) == text


def test_a_row_without_samples_is_invalid_and_says_so() -> None:
    row = row_of("speed", "x", ">= 10", [])
    assert not row.valid
    assert "INVALID" in table([row])


def test_columns_line_up_and_goals_stand_beside() -> None:
    lines = table(
        [row_of("speed", "x", ">= 10", [11.0, 12.0]), ReportRow("a", "", "", value="b")]
    ).splitlines()
    at = lines[0].index("goal")
    assert lines[2][at:].startswith(">= 10")
    assert len(lines) == 4


def test_an_invalid_run_keeps_its_figures_and_its_mark() -> None:
    text = table([row_of("speed", "x", "", [1.0], "simulator 0.90 x", valid=False)])
    assert "1.00" in text
    assert "INVALID: simulator 0.90 x" in text
