"""Keep the state of the hand on the stick. The only writer of ``stick``.

Whether a hand may take the robot over is decided in :mod:`bridge.core.modes.teleop`; here stands
what it must have shown before: released, then neutral, in this epoch.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.state_orders import Stick

if TYPE_CHECKING:
    from bridge.core.tick_context import TickContext
    from wire import Velocity

NEUTRAL_MPS, NEUTRAL_RADPS = 0.02, 0.05
_SOURCES = 8


def note_pressed(tick: TickContext) -> None:
    """Remember that an operator's dead-man is pressed now, of any stick."""
    tick.s.stick = replace(tick.s.stick, pressed_s=tick.now_s)


def note_released(tick: TickContext, source_id: str) -> None:
    """Remember a source that was seen with its dead-man released."""
    stick = tick.s.stick
    if source_id not in stick.released:
        tick.s.stick = replace(stick, released=(*stick.released, source_id)[-_SOURCES:])


def note_neutral(tick: TickContext, new: Velocity) -> None:
    """Remember a source that is neutral after it was seen released: it may take over."""
    stick = tick.s.stick
    neutral = abs(new.v_mps) <= NEUTRAL_MPS and abs(new.w_radps) <= NEUTRAL_RADPS
    if neutral and new.source_id in stick.released and new.source_id not in stick.ready:
        tick.s.stick = replace(stick, ready=(*stick.ready, new.source_id)[-_SOURCES:])


def give(tick: TickContext, new: Velocity, sent_s: float) -> None:
    """Let this source steer from now on."""
    tick.s.stick = replace(
        tick.s.stick,
        source_id=new.source_id,
        v_mps=new.v_mps,
        w_radps=new.w_radps,
        received_s=tick.now_s,
        sent_s=sent_s,
    )


def steer(tick: TickContext, new: Velocity, sent_s: float) -> None:
    """Take the newest velocity of the source that steers; an older origin makes nothing younger."""
    stick = tick.s.stick
    tick.s.stick = replace(
        stick,
        seq=new.seq,
        v_mps=new.v_mps,
        w_radps=new.w_radps,
        received_s=tick.now_s,
        sent_s=max(sent_s, stick.sent_s),
    )


def let_go(tick: TickContext) -> None:
    """Forget the hand: it must show itself released and neutral once more."""
    tick.s.stick = Stick(pressed_s=tick.s.stick.pressed_s)


def restart(tick: TickContext, *, keeps_hand: bool) -> None:
    """Begin a new epoch: numbers restart; only a hand that takes over now stays."""
    tick.s.stick = replace(tick.s.stick, seq=-1) if keeps_hand else Stick()
