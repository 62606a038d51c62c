"""Hold which stop input counts as pressed, and for how long one is waited for."""

from __future__ import annotations

from dataclasses import replace

from bridge.core import Inbox
from bridge.core.faults import detectors
from bridge.core.modes.operator import reset_lacks
from bridge.core.sensing.stop_inputs import note_pressed, pressed_input
from bridge.core.state_senses import ButtonMemory
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.scripted import World, config
from tests.bridge.core.table import table
from wire import EstopLink, Mode, RobotDescription

NOW_S = 10.0


def at(start: str) -> TickContext:
    """Return a tick at 10 s of a robot that has long stood and is being recorded."""
    tick = tick_of(reached(start))
    tick.now_s, tick.s.rows = NOW_S, {}
    tick.s.drive.received_s, tick.s.drive.still_since_s = NOW_S, 0.0
    tick.s.loop = replace(tick.s.loop, recorder_ok=True)
    return tick


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


NOW = 100.0


def tick_in(start: str = "active") -> TickContext:
    tick = tick_of(reached(start))
    tick.now_s = NOW
    return tick


def seen(detector: str, tick: TickContext) -> list[str]:
    dirty: list[tuple[str, str]] = []
    getattr(detectors, detector)(tick, dirty)
    return [name for name, _ in dirty]


def test_a_pressed_button_is_remembered_and_an_order_is_one_too() -> None:
    tick = tick_in()
    assert seen("buttons", tick) == []
    assert tick.s.buttons.pressed_s is None
    tick.s.buttons = replace(tick.s.buttons, ordered=True)
    assert seen("buttons", tick) == ["ESTOP.0"]
    state = tick.s.drive.newest
    assert state is not None
    tick.s.drive.newest = state.model_copy(update={"estop_pressed": True})
    tick.s.buttons = replace(tick.s.buttons, ordered=False)
    assert seen("buttons", tick) == ["ESTOP.0"]
    assert tick.s.buttons.pressed_s is None
    note_pressed(tick)
    pressed_s: float | None = tick.s.buttons.pressed_s
    assert pressed_s == NOW


def test_a_stop_link_that_is_pressed_is_said() -> None:
    robot = RobotDescription.model_validate({"inputs": {"estop_link": True}})
    world = World(core=config(robot))
    world.extra = Inbox(estop_link=EstopLink(seq=1, pressed=True))
    world.tick()
    assert world.is_in(Mode.ESTOPPED)
    assert world.asked("reset") == "estop_pressed"
