"""Hold what a tick tells of itself."""

from __future__ import annotations

from bridge.core.reporting.report import status_of
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.table import table


@table(
    ("still_s", "heard_s", "seconds", "still"),
    [
        (1.0, 0.0, 1.0, True),
        (1.0, 0.25, 0.5, True),
        (1.0, 0.25 + 1e-9, 0.5, False),
        (1.0, None, 0.5, False),
        (None, 0.0, 0.0, False),
        (1.0, 0.0, 1.0 + 1e-6, False),
        (0.0, 0.0, 1e-9, True),
        (0.0, 0.0, 0.0, True),
    ],
)
def test_a_robot_stands_while_its_drive_says_so(
    still_s: float | None, heard_s: float | None, seconds: float, still: bool
) -> None:
    tick = tick_of(reached("active"))
    tick.now_s = 4.0
    tick.s.drive.still_since_s = None if still_s is None else tick.now_s - still_s
    tick.s.drive.received_s = None if heard_s is None else tick.now_s - heard_s
    assert tick.still_for(seconds) is still


def test_what_is_dropped_is_counted_once_and_its_reason_kept() -> None:
    tick: TickContext = tick_of(reached("active"))
    before = tick.s.voice
    tick.drop("repeated")
    assert (tick.dropped, tick.reasons, tick.s.voice) == (1, ["repeated"], before)
    status_of(tick, tick.s)
    assert tick.s.voice.dropped == before.dropped + 1
