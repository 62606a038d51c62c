"""Hold the one table of faults: detector, window, binding, action, clearing, words.

docs/safety.md, the dashboard's sentences and the exhaustive test are made from it. A row is one
detector with one or more stages; the worst active stage wins and none masks another. No row and no
parameter can be switched off.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

from bridge.core.faults.fault_messages import WORDS
from wire import Action

if TYPE_CHECKING:
    from collections.abc import Mapping


class Clears(StrEnum):
    """Name how a stage ends once its detector is clean."""

    AUTO = "AUTO"
    """Clean for ``clean_s``; such a stage may only CAP or HOLD2."""
    ON_GRANT = "ON_GRANT"
    """A hello (where the owner was lost) and a new grant."""
    ON_REARM = "ON_REARM"
    ON_RESET = "ON_RESET"
    REBOOT = "REBOOT"


ALL = ""
"""Binds value: acts whoever moves the robot, and while nobody does."""


@dataclass(frozen=True, slots=True)
class FaultStage:
    """Give one threshold of a row and its action."""

    name: str
    """Row and place in it, ``LIDAR_STALE.1``; unique."""
    row: str
    window: str
    action: Action
    clears: Clears = Clears.AUTO
    clean_s: float = 0.5
    binds: str = ALL
    """Letters of the sources it binds: W waypoints, T teleop, X external velocity; ALL."""
    cap_factor: float | None = None
    """On robot.toml's speed and turn limits."""
    cap_mps: float | None = None
    cap_zone: bool = False
    """To the speed of the zone that the robot is in."""


@dataclass(frozen=True, slots=True)
class FaultRow:
    """Give one row: its stages mildest first, and its words."""

    id: str
    detector: str
    en: str
    zh: str
    stages: tuple[FaultStage, ...]


def _row(row: str, detector: str, *stages: Mapping[str, object]) -> FaultRow:
    en, zh = WORDS[row]
    made = tuple(
        FaultStage(name=f"{row}.{index}", row=row, **stage)  # type: ignore[arg-type]  # keys are Stage's
        for index, stage in enumerate(stages)
    )
    return FaultRow(row, detector, en, zh, made)


def _do(
    window: str, action: Action, binds: str = ALL, clears: Clears = Clears.AUTO, **more: object
) -> dict[str, object]:
    return {"window": window, "action": action, "binds": binds, "clears": clears, **more}


_CAP, _HOLD2, _STOP1 = Action.CAP, Action.HOLD2, Action.STOP1
_FAST1, _CUT0 = Action.FAST1, Action.CUT0
_REARM, _RESET, _GRANT = Clears.ON_REARM, Clears.ON_RESET, Clears.ON_GRANT

ROWS: tuple[FaultRow, ...] = (
    _row("BRAIN_LATE", "the newest status that the owner has shown to have seen was sent; an "
         "external brain's too, because its velocity leads on as blindly as a horizon",
         _do("over 150 ms ago", _CAP, "WX", cap_factor=0.5)),
    _row("BRAIN_LOST", "that newest status was sent; the epoch changes and the ownership is freed",
         _do("over 300 ms ago", _HOLD2, "WX", _GRANT)),
    _row("BRAIN_GONE", "that newest status was sent, if a grant was given since arming and nobody "
         "steers by hand; it binds in HOLD without a grant too, because the loss has already taken "
         "that",
         _do("over 5 s ago", _STOP1, ALL, _REARM)),
    _row("BRAIN_STALE", "the status that the owner's mission loop last used was sent",
         _do("over 1 s ago", _HOLD2, "W")),
    _row("CMD_STALE", "the status on which the horizon or velocity was cut was sent",
         _do("longer ago than its ttl (0.5 s, at most 2 s)", _HOLD2, "W"),
         _do("over 0.25 s ago", _HOLD2, "X")),
    _row("CMD_BAD", "messages malformed, out of bounds, seq backwards, wrong map, first point "
         "over 0.5 m off, bad spacing, a segment through the fence; each dropped",
         _do("bucket +1 per bad, -1 per good or 0.5 s, trips at 5", _HOLD2, "WTX")),
    _row("CMD_FLOOD", "messages over rate x 0.25 x 1.2 + 1 in a sliding 250 ms; dropped",
         _do("4 windows", _HOLD2, "WTX")),
    _row("BUDGET", "the mission's grant or the operator's 500 m and 3600 s are spent; a new "
         "mission or an operator act clears it",
         _do("at once", _HOLD2, "WX", clean_s=0.0)),
    _row("HAND_BUDGET", "the 50 m and 600 s that a hand on the stick may drive after an operator's "
         "signed act are spent, a metre outside the fence as ten, or a stop took them; arm or "
         "resume gives them anew",
         _do("at once", _HOLD2, "T", clean_s=0.0)),
    _row("LIDAR_STALE", "age of the newest scan over 250 ms, or 5 equal scans while the robot "
         "moved 0.02 m",
         _do("at once", _HOLD2, "WTX", clean_s=1.0),
         _do("for 5 s", _STOP1, "WTX", _REARM)),
    _row("LIDAR_BLIND", "returns under 5 % of the baseline",
         _do("300 ms", _HOLD2, "WTX", clean_s=2.0),
         _do("5 s", _STOP1, "WTX", _REARM)),
    _row("LIDAR_SECTOR", "within 60 degrees of the way asked for, 12 degrees or more fell silent "
         "in one scan in which nothing beside them went away (one edge within 0.85 of the lidar's "
         "range), or stayed silent, as wide as they are, through 15 degrees of a turn on the "
         "spot, or have never returned since the start (both edges within 0.7); it asks for no "
         "map; a turn in place passes, and leads out of the hold",
         _do("0.2 s where it fell silent; at once where it turned with the robot or nothing ever "
             "came", _HOLD2, "WX", clean_s=2.0),
         _do("likewise", _CAP, "T", clean_s=2.0, cap_mps=0.1)),
    _row("NO_RANGE", "no obstacle source is configured or alive",
         _do("at once", _HOLD2, "WX"), _do("at once", _CAP, "T", cap_mps=0.2)),
    _row("SPEED_ZONE", "the robot is inside a speed zone of the fence or of the marks, or so near "
         "that it must slow down for it; elsewhere there is no speed to cap to, so it ends at once",
         _do("at once", _CAP, "WX", clean_s=0.0, cap_zone=True)),
    _row("POSE_LOST", "localization older than 300 ms, poor, or of another odom_id; an external "
         "brain is held too, because without a pose no fence and no zone can hold it",
         _do("at once", _HOLD2, "WX"), _do("at once", _CAP, "T", cap_mps=0.2)),
    _row("POSE_JUMP", "the robot displaced over 0.1 m or 5 degrees between two localizations, or "
         "over 0.2 m or 10 degrees by many, less 0.1 m and 0.05 rad per metre driven and 0.1 rad "
         "per radian turned; route and grant anew",
         _do("once", _HOLD2, "W", _GRANT),
         _do("takes a grant 3 times in 60 s", _STOP1, "WX", _REARM)),
    _row("STUCK", "told to move and measured still, or one wheel is, or an open leg makes no way; "
         "seen in one tick, so that its 2 s are all of the hold; a stop takes 0.9 s",
         _do("1 s; 5 s without progress; the grant is taken", _HOLD2, "WTX", clean_s=2.0),
         _do("3 in 5 min", _STOP1, "WTX", _REARM)),
    _row("RUNAWAY", "measured faster than anything sent in the last lag + 0.2 s (for a drive that "
         "reports seldom as much more as its windows are longer), or of other sign",
         _do("100 ms", _FAST1, ALL, _RESET), _do("250 ms", _CUT0, ALL, _RESET)),
    _row("YAW_DISAGREE", "odometry and gyro differ by over 0.3 rad/s, or the gyro is stale or not "
         "wired",
         _do("0.5 s", _CAP, "WTX", clean_s=2.0, cap_mps=0.3)),
    _row("ENC_STALE", "no state from the drive",
         _do("80 ms, or 2.5 reports of a drive that reports seldom", _HOLD2),
         _do("250 ms", _FAST1, ALL, _REARM)),
    _row("DRIVER_NACK", "states arrive whose echo is behind by",
         _do("100 ms, or 2.5 reports of a drive that reports seldom", _HOLD2),
         _do("500 ms", _STOP1, ALL, _RESET)),
    _row("DRIVE_FOREIGN", "the drive echoes a command that this bridge has not sent",
         _do("at once", _FAST1, ALL, _RESET)),
    _row("DRIVE_REBOOT", "the drive's boot id changed, or after 250 ms of silence it counts from a "
         "lower number; encoder deltas are zeroed anew",
         _do("at once", _STOP1, ALL, _REARM)),
    _row("OVERCURRENT", "peak or I2t of the motor current",
         _do("100 ms", _STOP1, ALL, _RESET)),
    _row("BATTERY", "charge, or sag under load",
         _do("under 20 % for 2 s", _CAP, ALL, clean_s=5.0, cap_mps=0.3),
         _do("under 10 % for 2 s", _STOP1, ALL, _REARM)),
    _row("DEAD_MAN", "the drive stops by itself in silence, but does not report it, so that no "
         "self test proves it: `pons robot try` has not seen it on this base, or it takes too long",
         _do("not seen", _CAP, ALL, Clears.REBOOT, cap_mps=0.3),
         _do("over 0.7 s, seen or claimed", _CAP, ALL, Clears.REBOOT, cap_mps=0.15)),
    _row("LOOP_LATE", "this loop: ticks over 5 ms late, missed ticks, gaps between ticks",
         _do("late five times in 1 s, or two ticks missed", _CAP, ALL, clean_s=2.0,
             cap_factor=0.5),
         _do("a gap over 100 ms", _HOLD2),
         _do("three such gaps in 10 s", _STOP1, ALL, _REARM)),
    _row("NOT_RT", "real-time rights refused on a drive that is not virtual",
         _do("at once", _CAP, ALL, Clears.REBOOT, cap_mps=0.2)),
    _row("ESTOP", "a stop input or a stop message; a stop button's link pressed, or silent 500 ms",
         _do("at once", _FAST1, ALL, _RESET)),
)  # fmt: skip

STAGES: dict[str, FaultStage] = {stage.name: stage for row in ROWS for stage in row.stages}
