"""Hold the mode table to its laws, every mode by every cause."""

from __future__ import annotations

from bridge.core.modes.mode_table import LATCHED, TRANSITIONS, Cause, Fact, RequestCause, after
from bridge.core.tick_context import MOVING, POWERED
from tests.bridge.core.table import table
from wire import SEVERITY, Action, Mode

CAUSES: tuple[Cause, ...] = (*Action, *RequestCause, *Fact)


@table("cause", CAUSES)
@table("mode", Mode)
def test_what_is_absent_changes_nothing(mode: Mode, cause: Cause) -> None:
    assert after(mode, cause) == TRANSITIONS.get((mode, cause))


@table(("key", "to"), TRANSITIONS.items())
def test_every_transition_obeys_the_laws(key: tuple[Mode, Cause], to: Mode) -> None:
    mode, cause = key
    if to in POWERED and mode not in POWERED:
        assert cause is RequestCause.ARM, "powered implies armed by a person"
    if mode in LATCHED:
        assert cause in {RequestCause.RESET, Fact.UNPROVEN_RESET, RequestCause.ESTOP}
        assert to not in POWERED, "a reset never powers the robot"
    if isinstance(cause, Action):
        assert to not in MOVING, "no row ever makes the robot move"
        assert SEVERITY[cause] >= SEVERITY[Action.HOLD2], "NONE and CAP change no mode"
    if to in MOVING:
        assert cause in {Fact.CALLED, Fact.CLEARED, RequestCause.TELEOP}


@table("mode", sorted(POWERED))
@table("action", [Action.STOP1, Action.FAST1, Action.CUT0])
def test_a_row_that_takes_torque_ends_every_powered_mode(mode: Mode, action: Action) -> None:
    if mode is Mode.STOPPING and action is not Action.CUT0:
        return  # the stop in progress is made harder, the mode stays
    assert after(mode, action) in {Mode.STOPPING, Mode.FAULT}


@table("mode", [mode for mode in Mode if mode is not Mode.ESTOPPED])
def test_a_protective_stop_is_obeyed_everywhere(mode: Mode) -> None:
    assert after(mode, RequestCause.ESTOP) is Mode.ESTOPPED


def test_nothing_leaves_boot_but_the_self_test_or_a_stop() -> None:
    assert {cause for mode, cause in TRANSITIONS if mode is Mode.BOOT} == {
        Fact.UP,
        RequestCause.ESTOP,
    }
