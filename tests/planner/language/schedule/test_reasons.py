"""A reason is left out of a sentence; what orders, denies or hangs on something never is."""

from __future__ import annotations

import pytest

from planner.language.schedule.reasons import is_reason, leave_reasons_out


@pytest.mark.parametrize(
    "clause",
    ["i've finished the course", "i'm still at work at six", "he's been", "the lot",
     "when the kids are back", "we're all at home"],
)  # fmt: skip
def test_a_statement_of_how_things_stand_is_a_reason(clause: str) -> None:
    assert is_reason(clause, chinese=False)
    assert leave_reasons_out(f"only on weekends, {clause}", chinese=False) == "only on weekends"
    assert leave_reasons_out(f"{clause}, only on weekends", chinese=False) == "only on weekends"


@pytest.mark.parametrize(
    "clause",
    ["then go to the kitchen", "unless i say so", "but not the plumber one", "don't stop",
     "i want you to come here", "when i say so", "or the alarm", "at nine"],
)  # fmt: skip
def test_what_orders_or_hangs_on_something_is_none(clause: str) -> None:
    assert not is_reason(clause, chinese=False)
    assert leave_reasons_out(f"cancel the reminder, {clause}", chinese=False) is None


def test_chinese_reasons_are_told_from_orders() -> None:
    assert leave_reasons_out("改成八点吧,起不来", chinese=True) == "改成八点吧"
    assert leave_reasons_out("晚上十点以后就别说了,会吵到宝宝", chinese=True) is not None
    for why in (
        "八点他琴还没练完呢",
        "九点他都睡了",
        "医生讲可以停了",
        "放暑假了",
        "一个钟头太长了",
    ):
        assert leave_reasons_out(f"改成八点吧,{why}", chinese=True) == "改成八点吧"
    for order in ("去客厅看看", "告诉妈妈一声", "别忘了", "说饭好了"):
        assert leave_reasons_out(f"改成八点吧,{order}", chinese=True) is None
    assert leave_reasons_out("改成八点吧,然后去厨房", chinese=True) is None
    assert leave_reasons_out("改成八点吧,要是下雨", chinese=True) is None
