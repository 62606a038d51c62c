"""Read the protective-stop inputs: the drive's own, the button's link, and orders by message."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from wire import Mode

if TYPE_CHECKING:
    from bridge.core.tick_context import TickContext
    from wire import EstopLink


LINK_SILENT_S = 0.5
_UNPROVEN = frozenset({Mode.BOOT, Mode.SELFTEST})


def hear_link(tick: TickContext, link: EstopLink) -> None:
    """Take in the stop button link's message."""
    buttons = tick.s.buttons
    tick.s.buttons = replace(buttons, link_pressed=link.pressed, link_received_s=tick.now_s)


def note_pressed(tick: TickContext) -> None:
    """Remember when an input was last seen pressed, in the mode that this tick's orders left."""
    if pressed_input(tick) is not None:
        tick.s.buttons = replace(tick.s.buttons, pressed_s=tick.now_s)


def latch_order(tick: TickContext, *, ordered: bool) -> None:
    """Remember that a protective stop was asked for by message, until a reset."""
    tick.s.buttons = replace(tick.s.buttons, ordered=ordered)


def pressed_input(tick: TickContext) -> str | None:
    """Name the protective-stop input that is pressed now; None if none is."""
    drive, buttons = tick.s.drive.newest, tick.s.buttons
    if drive is not None and drive.estop_pressed is not False:
        if drive.estop_pressed is not None:
            return "the drive's stop input is pressed"
        if tick.s.mode not in _UNPROVEN:  # until then the self test waits for it
            return "the drive does not tell its stop input"
    if tick.config.robot.inputs.estop_link and buttons.link_received_s is not None:
        if buttons.link_pressed:
            return "the stop button's link says pressed"
        if not tick.now_s - buttons.link_received_s <= LINK_SILENT_S:
            return "the stop button's link is silent"
    return None
