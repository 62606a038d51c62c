"""Say what rows must do, from a table written by hand: nothing here asks the core.

The laws of the bridge, judged from outside on one step: the state before, the decision after.
"""

from __future__ import annotations

from bridge.core import BridgeState, Decision
from wire import Action, Mode, Twist2

ORDER = (Action.NONE, Action.CAP, Action.HOLD2, Action.STOP1, Action.FAST1, Action.CUT0)
POWERED = {Mode.HOLD, Mode.ACTIVE, Mode.TELEOP, Mode.STOPPING}
MOVING = {Mode.ACTIVE, Mode.TELEOP}
HALF_SEPARATION_M = 0.25
EPS = 1e-9

# stage: action, the sources it binds ("" is all), and the factor on 0.5 m/s where it caps
TABLE: dict[str, tuple[str, str, float | None]] = {
    "BRAIN_LATE.0": ("CAP", "WX", 0.5),
    "BRAIN_LOST.0": ("HOLD2", "WX", None),
    "BRAIN_GONE.0": ("STOP1", "", None),
    "BRAIN_STALE.0": ("HOLD2", "W", None),
    "CMD_STALE.0": ("HOLD2", "W", None),
    "CMD_STALE.1": ("HOLD2", "X", None),
    "CMD_BAD.0": ("HOLD2", "WTX", None),
    "CMD_FLOOD.0": ("HOLD2", "WTX", None),
    "BUDGET.0": ("HOLD2", "WX", None),
    "HAND_BUDGET.0": ("HOLD2", "T", None),
    "LIDAR_STALE.0": ("HOLD2", "WTX", None),
    "LIDAR_STALE.1": ("STOP1", "WTX", None),
    "LIDAR_BLIND.0": ("HOLD2", "WTX", None),
    "LIDAR_BLIND.1": ("STOP1", "WTX", None),
    "LIDAR_SECTOR.0": ("HOLD2", "WX", None),
    "LIDAR_SECTOR.1": ("CAP", "T", 0.2),
    "NO_RANGE.0": ("HOLD2", "WX", None),
    "NO_RANGE.1": ("CAP", "T", 0.4),
    "SPEED_ZONE.0": ("CAP", "WX", 0.6),
    "POSE_LOST.0": ("HOLD2", "WX", None),
    "POSE_LOST.1": ("CAP", "T", 0.4),
    "POSE_JUMP.0": ("HOLD2", "W", None),
    "POSE_JUMP.1": ("STOP1", "WX", None),
    "STUCK.0": ("HOLD2", "WTX", None),
    "STUCK.1": ("STOP1", "WTX", None),
    "RUNAWAY.0": ("FAST1", "", None),
    "RUNAWAY.1": ("CUT0", "", None),
    "YAW_DISAGREE.0": ("CAP", "WTX", 0.6),
    "ENC_STALE.0": ("HOLD2", "", None),
    "ENC_STALE.1": ("FAST1", "", None),
    "DRIVER_NACK.0": ("HOLD2", "", None),
    "DRIVER_NACK.1": ("STOP1", "", None),
    "DRIVE_FOREIGN.0": ("FAST1", "", None),
    "DRIVE_REBOOT.0": ("STOP1", "", None),
    "OVERCURRENT.0": ("STOP1", "", None),
    "BATTERY.0": ("CAP", "", 0.6),
    "BATTERY.1": ("STOP1", "", None),
    "DEAD_MAN.0": ("CAP", "", 0.6),
    "DEAD_MAN.1": ("CAP", "", 0.3),
    "LOOP_LATE.0": ("CAP", "", 0.5),
    "LOOP_LATE.1": ("HOLD2", "", None),
    "LOOP_LATE.2": ("STOP1", "", None),
    "NOT_RT.0": ("CAP", "", 0.4),
    "ESTOP.0": ("FAST1", "", None),
}
NEEDS_RESET = {"RUNAWAY.0", "RUNAWAY.1", "DRIVER_NACK.1", "DRIVE_FOREIGN.0", "OVERCURRENT.0"}


def acts(stage: str, letters: str) -> bool:
    """Tell whether a stage acts on who moves the robot or holds a grant."""
    if stage == "ESTOP.0":
        return False  # a mode of its own
    binds = TABLE[stage][1]
    return not binds or bool(set(binds) & set(letters))


def worst(stages: set[str], letters: str) -> Action:
    """Return the worst action of the stages that act."""
    numbers = [ORDER.index(Action(TABLE[one][0])) for one in stages if acts(one, letters)]
    return ORDER[max(numbers, default=0)]


def cap(stages: set[str], letters: str) -> float:
    """Return the smallest factor of the stages that act and cap."""
    factors = [TABLE[one][2] for one in stages if acts(one, letters)]
    return min([factor for factor in factors if factor is not None], default=1.0)


def next_mode(mode: Mode, action: Action, *, moves: bool, reset: bool) -> Mode:
    """Return the mode that follows where nobody asks for anything.

    Args:
        mode: before.
        action: the worst.
        moves: the robot moves; a stop that finds it standing is over at once.
        reset: something acts that only a reset clears.
    """
    number = ORDER.index(action)
    if mode not in POWERED or number < ORDER.index(Action.HOLD2):
        return mode
    if action is Action.CUT0:
        return Mode.FAULT
    if mode is Mode.HOLD and action is Action.HOLD2:
        return Mode.HOLD
    if moves:
        return Mode.STOPPING
    if reset:
        return Mode.FAULT
    return Mode.HOLD if action is Action.HOLD2 else Mode.DISARMED


def rim_mps(twist: Twist2) -> float:
    """Return the speed of the faster wheel at its rim."""
    return abs(twist.v_mps) + HALF_SEPARATION_M * abs(twist.w_radps)


def check_output(before: BridgeState, decision: Decision) -> None:
    """Hold one step's command: one, powered only where it may be, no faster where told to stop."""
    after = decision.state
    had, sent = before.motion.limiter.sent, after.motion.limiter.sent
    assert decision.command is not None
    assert decision.command.seq == before.command_seq + 1
    if decision.command.enable:
        assert after.mode in POWERED | {Mode.ESTOPPED}
    else:
        assert decision.command.left_radps == decision.command.right_radps == 0.0
    if after.mode not in MOVING:
        assert rim_mps(sent) <= rim_mps(had) + EPS
    assert abs(sent.v_mps) <= 0.5 + EPS
    assert abs(sent.w_radps) <= 1.0 + EPS


def curve_mps(start_mps: float, elapsed_s: float, action: Action) -> float:
    """Return the most that a stop may still send at the rim, by FAULTS' numbers alone.

    Ordinary: 1 m/s2, built up and let go in 0.1 s each (10 m/s3); hardest: 2.5 m/s2 at once.
    """
    if action is Action.FAST1:
        return max(0.0, start_mps - 2.5 * elapsed_s)
    return max(0.0, start_mps - (elapsed_s - 0.1)) if elapsed_s < start_mps + 0.2 else 0.0
