"""Stop the wheels when no fresh command came for the time-out. Pure; told the time.

Law: an old command can never keep wheels turning, whatever its sender believes. Age runs from
RECEIPT on the drive's own clock; a command whose seq does not rise within its boot is no sign of
life. On expiry the wheels ramp to zero and the torque goes off; the next command starts afresh.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from wire.value import value

if TYPE_CHECKING:
    from wire import DriveCommand


@value
class WheelTargets:
    """Ask both motors for speeds; without torque they are braked."""

    left_radps: float
    right_radps: float
    torque: bool
    timed_out: bool


def towards_zero(value: float, step: float) -> float:
    """Move a value towards zero by at most ``step``, never through it."""
    return max(0.0, value - step) if value >= 0.0 else min(0.0, value + step)


class DeadMan:
    """Turn received commands into the motors' targets, tick by tick."""

    def __init__(self, timeout_s: float, ramp_radps2: float) -> None:
        self._timeout_s = timeout_s
        self._ramp_radps2 = ramp_radps2
        self._command: DriveCommand | None = None
        self._received_s = 0.0
        self._asked_s = 0.0
        self._wheels = WheelTargets(0.0, 0.0, torque=False, timed_out=True)

    @property
    def echo(self) -> tuple[str | None, int]:
        """Return boot and seq of the newest accepted command."""
        return (None, 0) if self._command is None else (self._command.boot, self._command.seq)

    def receive(self, command: DriveCommand, now_s: float) -> bool:
        """Take a command that arrived at ``now_s``; False when it is a repeat or from the past."""
        last = self._command
        if last is not None and command.boot == last.boot and command.seq <= last.seq:
            return False
        self._command, self._received_s = command, now_s
        return True

    def wheels(self, now_s: float) -> WheelTargets:
        """Return the motors' targets now. Call once per tick with a clock that never goes back."""
        elapsed_s, self._asked_s = now_s - self._asked_s, now_s
        command = self._command
        if command is not None and 0.0 <= now_s - self._received_s <= self._timeout_s:
            on = command.enable
            speeds = (command.left_radps, command.right_radps) if on else (0.0, 0.0)
            self._wheels = WheelTargets(*speeds, torque=on, timed_out=False)
        else:
            self._wheels = self._ramp_down(elapsed_s)
        return self._wheels

    def _ramp_down(self, elapsed_s: float) -> WheelTargets:
        """Ramp down by the time that really passed: after a freeze this ends at once."""
        step = self._ramp_radps2 * max(0.0, elapsed_s)
        left = towards_zero(self._wheels.left_radps, step)
        right = towards_zero(self._wheels.right_radps, step)
        moving = left != 0.0 or right != 0.0
        return WheelTargets(left, right, torque=self._wheels.torque and moving, timed_out=True)
