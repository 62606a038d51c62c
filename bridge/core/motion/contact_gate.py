"""Block motion that goes on into a bumper's contact or towards a cliff.

By direction: what leads away passes slowly, and so does a turn in place, which sweeps nothing but
the disc itself. Bumpers sit front and rear, the cliff sensor in front; one that is not told counts
as pressed. Knows no modes and no rows.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.geometry.kinematics import scale_twist
from bridge.core.motion.braking import CREEP_MPS, CREEP_RADPS
from wire.geometry import Twist2

if TYPE_CHECKING:
    from wire import DriveState


def touched_input(state: DriveState | None, v_mps: float) -> str | None:
    """Name the input that forbids going on in this direction; None if none does."""
    if state is None:
        return None
    if v_mps > 0.0:
        if state.bumper_front is not False:
            return "bumper_front"
        return "cliff" if state.cliff is not False else None
    return "bumper_rear" if v_mps < 0.0 and state.bumper_rear is not False else None


def contact_gate(state: DriveState | None, twist: Twist2) -> Twist2:
    """Return the part of a motion that passes while the drive state shows a contact or a cliff."""
    if state is None or state.bumper_front is state.bumper_rear is state.cliff is False:
        return twist
    if touched_input(state, twist.v_mps) is not None:
        return Twist2(0.0, min(max(twist.w_radps, -CREEP_RADPS), CREEP_RADPS))
    v, w = abs(twist.v_mps), abs(twist.w_radps)
    share = min(1.0, CREEP_MPS / v if v > 0.0 else 1.0, CREEP_RADPS / w if w > 0.0 else 1.0)
    return scale_twist(twist, share)
