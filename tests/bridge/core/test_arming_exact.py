"""Hold what speaks against arming, and which stop input is pressed, to their very edges."""

from __future__ import annotations

from dataclasses import replace

from bridge.core.inbox import Inbox
from bridge.core.modes.arming import ready_lacks, reset_lacks
from bridge.core.sensing.sensor_update import recorder_lack
from bridge.core.sensing.stop_inputs import pressed_input
from bridge.core.state_orders import PendingFence
from bridge.core.state_senses import ButtonMemory
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached
from tests.bridge.core.scripted import config
from tests.bridge.core.table import table
from tests.bridge.core.test_quick_core import tick_of
from wire import IDENTITY, Mode, RobotDescription

NOW_S = 10.0


def at(start: str) -> TickContext:
    """Return a tick at 10 s of a robot that has long stood and is being recorded."""
    tick = tick_of(reached(start))
    tick.now_s, tick.s.rows = NOW_S, {}
    tick.s.drive.received_s, tick.s.drive.still_since_s = NOW_S, 0.0
    tick.s.loop = replace(tick.s.loop, recorder_ok=True)
    return tick


@table(
    ("what", "codes"),
    [
        ("nothing", []),
        ("fence", ["fence_changing"]),
        ("moves", ["not_standing"]),
        ("stick", ["stick_not_neutral"]),
        ("stick_long_ago", []),
        ("unrecorded", ["disk_full"]),
    ],
)
def test_each_thing_alone_speaks_against_arming(what: str, codes: list[str]) -> None:
    tick = at("disarmed")
    if what == "fence":
        tick.s.fence_asked = PendingFence("f1", "test", "{}", IDENTITY)
    elif what == "moves":
        tick.s.drive.still_since_s = NOW_S - 0.4
    elif what.startswith("stick"):
        pressed_s = NOW_S - (0.24 if what == "stick" else 0.26)
        tick.s.stick = replace(tick.s.stick, pressed_s=pressed_s)
    elif what == "unrecorded":
        tick.s.loop = replace(tick.s.loop, recorder_ok=False)
        tick.inbox = Inbox(recorder_says="disk_full: nothing is left")
    assert [code for code, _ in ready_lacks(tick)] == codes


@table(
    ("says", "lack"),
    [
        ("disk_full: no space: none", ("disk_full", "no space: none")),
        ("disk_full", ("disk_full", "the tick recorder takes no records")),
        ("", ("recorder_down", "the tick recorder takes no records")),
    ],
)
def test_why_nothing_is_recorded(says: str, lack: tuple[str, str]) -> None:
    assert recorder_lack(Inbox(recorder_says=says)) == lack


SILENT, DOWN = "the stop button's link is silent", "the stop button's link says pressed"
INPUT = "the drive's stop input is pressed"
UNTOLD = "the drive does not tell its stop input"


@table(
    ("linked", "on_drive", "down", "heard_s", "told"),
    [
        (True, False, False, NOW_S, None),
        (True, False, False, NOW_S - 0.5, None),
        (True, False, False, NOW_S - 0.5 - 1e-9, SILENT),
        (True, False, False, None, None),
        (True, False, True, NOW_S, DOWN),
        (True, True, True, NOW_S, INPUT),
        (False, True, False, None, INPUT),
        (False, False, True, NOW_S, None),
        (False, False, False, 0.0, None),
        (False, None, False, NOW_S, UNTOLD),
        (True, None, True, NOW_S, UNTOLD),
    ],
)
def test_a_stop_input_is_pressed_or_its_link_silent(
    linked: bool, on_drive: bool | None, down: bool, heard_s: float | None, told: str | None
) -> None:
    tick = at("estopped")
    tick.config = config(RobotDescription.model_validate({"inputs": {"estop_link": linked}}))
    assert tick.s.drive.newest is not None
    tick.s.drive.newest = tick.s.drive.newest.model_copy(update={"estop_pressed": on_drive})
    tick.s.buttons = ButtonMemory(link_pressed=down, link_received_s=heard_s)
    assert pressed_input(tick) == told
    assert list(reset_lacks(tick)) == ([] if told is None else [("estop_pressed", told)])


@table(
    ("mode", "told"), [(mode, None if mode in {"BOOT", "SELFTEST"} else UNTOLD) for mode in Mode]
)
def test_an_input_never_told_is_waited_for_and_one_no_longer_told_is_pressed(
    mode: Mode, told: str | None
) -> None:
    tick = at("hold")
    assert tick.s.drive.newest is not None
    tick.s.mode = mode
    tick.s.drive.newest = tick.s.drive.newest.model_copy(update={"estop_pressed": None})
    assert pressed_input(tick) == told
