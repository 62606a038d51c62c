"""Check how durations are read, in both languages."""

from __future__ import annotations

import pytest

from planner.language.numbers import seconds


@pytest.mark.parametrize(
    ("number", "unit", "expected_s"),
    [
        *(("5", "s", 5.0), ("2.5", "seconds", 2.5), ("ten", "secs", 10.0), ("a", "minute", 60.0)),
        *(
            ("half a", "minute", 30.0),
            ("an", "hour", 3600.0),
            ("5", "秒", 5.0),
            ("两", "分", 120.0),
        ),
        *(("半", "小时", 1800.0), ("十", "秒", 10.0), ("十二", "秒", 12.0), ("二十", "秒", 20.0)),
        *(("九十九", "秒", 99.0), ("零", "秒", 0.0)),
        *(("一二三", "秒", None), ("半半", "秒", None), ("一二", "秒", None), ("两十", "秒", None)),
    ],
)
def test_duration(number: str, unit: str, expected_s: float | None) -> None:
    assert seconds(number, unit) == expected_s
