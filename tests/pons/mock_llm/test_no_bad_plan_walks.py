"""Check that no plan which a faulty model writes is walked."""

from __future__ import annotations

import asyncio
from pathlib import Path

from tests.pons.mock_llm.faults import FAULTS, READABLE
from tests.pons.mock_llm.mock_faults import try_fault
from tests.pons.mock_llm.mocks import running_mock

WRITTEN = (
    *("garbage", "hallucinate", "hostile", "wrong_types", "two_plans", "refuse_and_plan"),
    *("truncated", "length", "thoughts_only", "unknown_tool", "reasoning", "declined"),
)
"""What a model itself does wrong; a server's faults are tried one by one beside."""


def test_no_bad_plan_is_walked(tmp_path: Path) -> None:
    assert set(WRITTEN) <= set(FAULTS) - READABLE
    with running_mock() as mock:
        for fault in (*WRITTEN, "odd_repeat"):
            mock.set(fault=fault)
            counts = asyncio.run(try_fault(mock.url, tmp_path / fault, fault, 2))
            assert (counts["crashed"], counts["invalid"], counts["goals"]) == (0, 0, 4), fault
            assert bool(counts["model"]) == (fault in READABLE), fault
