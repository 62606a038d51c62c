"""Describe a robot's drive: which it is, where its port is, how it moves and how it reports."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from pydantic import Field, model_validator

from wire.base import Record
from wire.bounded_types import DevicePath

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

PEAK_TIMES = 10.0
"""Motors stall at most at about ten times what they bear for ever: a peak beyond bounds nothing."""
ENCODER_S = 0.08
"""Without a state for so long row ENC_STALE is up, however often the drive reports."""
ANSWER_S = 0.1
"""With its echo behind by so much row DRIVER_NACK is up, however often the drive reports."""
REPORTS = 2.5
"""A drive that reports seldom may lose one report and send the next half a period late."""

_BATTERY_KEYS = ("battery_empty_v", "battery_full_v")
LINE_KEYS = ("port", "baud", "ticks_per_turn", *_BATTERY_KEYS)


@dataclass(frozen=True, slots=True)
class DriveKind:
    """Hold what is the same for every base of one kind."""

    needed: tuple[str, ...]
    """Keys about its line that robot.toml must have."""
    useful: tuple[str, ...]
    """Keys about its line that it may have."""
    report_s: float
    """Longest time between two states of a base in good order."""
    dead_man_s: float | None = None
    """Silence after which its firmware stops by itself, where a setting can't change that."""
    reports_dead_man: bool = True
    """It tells in each state whether its dead-man has fired, so that the self test can prove it."""
    has_gyro: bool = False
    """Its states bring the rate of turn."""


DRIVE_KINDS: Mapping[str, DriveKind] = {
    "sim": DriveKind((), (), 0.01),
    "pons_mcu": DriveKind(("port", "ticks_per_turn"), ("baud", *_BATTERY_KEYS), 0.01),
    "waveshare": DriveKind(
        ("port",), ("baud", *_BATTERY_KEYS), 0.06, reports_dead_man=False, has_gyro=True
    ),  # 20 Hz at most, and the turn of its loop
    "arduino": DriveKind(
        ("port", "ticks_per_turn"), ("baud",), 0.04, dead_man_s=2.0, reports_dead_man=False
    ),  # asked at 50 Hz, through adapters that wait 16 ms
    "turtlebot3": DriveKind(
        ("port",), (), 0.04, dead_man_s=0.5, reports_dead_man=False, has_gyro=True
    ),  # asked at 50 Hz for a table that is filled at 50 Hz
    "ros2": DriveKind((), (), 0.05),  # ros2_odom_slow says so where a base is slower
}


class DriveConfig(Record):
    """Choose the drive and state its known dynamics."""

    kind: Literal["sim", "pons_mcu", "waveshare", "arduino", "turtlebot3", "ros2"] = "sim"
    """``sim``: the simulated drive; the others are bases of metal (docs/drives.md)."""
    port: DevicePath | None = None
    """Serial port of the base; one below /dev/serial/by-id keeps its name."""
    baud: int | None = Field(default=None, ge=9_600, le=4_000_000)
    """None: as its firmware comes."""
    ticks_per_turn: int | None = Field(default=None, ge=8, le=4_000_000)
    """Of a wheel, not of its motor; all edges counted."""
    battery_empty_v: float | None = Field(default=None, ge=1.0, le=60.0)
    """With ``battery_full_v``: what the charge is reckoned from, straight between the two."""
    battery_full_v: float | None = Field(default=None, ge=1.0, le=60.0)
    lag_s: float = Field(default=0.06, ge=0.005, le=0.5)
    """Command to wheel response, never assumed better than this."""
    timeout_s: float = Field(default=0.2, ge=0.05, le=0.5)
    """The drive's own dead-man: without a command for this long it stops by itself."""
    dead_zone_radps: float = Field(default=0.05, ge=0.0, le=2.0)
    """The motor turns so much slower than told; the bridge adds it to every command but zero."""
    response_s: float = Field(default=0.049, ge=0.0, le=0.5)
    """First-order lag of motor and wheel, fed forward. The shortest measured: more would make the
    wheels change speed faster than meant. What exceeds lag_s does not count."""
    kp: float = Field(default=0.71, ge=0.0, le=2.0)
    """Wheel control, rad/s told per rad/s missing; 0 with ki_per_s 0 is feed-forward alone."""
    ki_per_s: float = Field(default=14.5, ge=0.0, le=40.0)
    max_correction: float = Field(default=0.2, ge=0.0, le=0.3)
    """Most that wheel control may add or take, as a share of the speed meant, beside the dead zone:
    a motor 15 % weak needs 0.18."""
    peak_current_a: float = Field(default=30.0, ge=0.5, le=500.0)
    """All motors together; OVERCURRENT after 0.1 s of more. Judged where the drive reports it."""
    continuous_current_a: float = Field(default=15.0, ge=0.2, le=400.0)
    """What may flow for ever; more heats the motors, to OVERCURRENT after 2 s at the peak."""

    @model_validator(mode="after")
    def _has_the_keys_of_its_kind(self) -> DriveConfig:
        wrong = "; ".join(_wrong_keys(self))
        if wrong:
            raise ValueError(wrong)
        return self

    @model_validator(mode="after")
    def _peak_is_more(self) -> DriveConfig:
        lasting_a, peak_a = self.continuous_current_a, self.peak_current_a
        if not lasting_a < peak_a:
            raise ValueError(
                f"drive.continuous_current_a {lasting_a} must be less than peak_current_a {peak_a}"
            )
        if not peak_a <= PEAK_TIMES * lasting_a:
            raise ValueError(
                f"drive.peak_current_a {peak_a} must be at most {PEAK_TIMES:g} times "
                f"continuous_current_a {lasting_a}: a peak that no motor reaches guards none"
            )
        return self

    @property
    def encoder_window_s(self) -> float:
        """Return how old the newest state may be before the robot is held (row ENC_STALE)."""
        return max(ENCODER_S, REPORTS * DRIVE_KINDS[self.kind].report_s)

    @property
    def answer_window_s(self) -> float:
        """Return how far the echo may be behind before the robot is held (row DRIVER_NACK)."""
        return max(ANSWER_S, REPORTS * DRIVE_KINDS[self.kind].report_s)

    @property
    def unseen_s(self) -> float:
        """Return by how much this drive's windows are longer than the shortest; mostly 0.

        So much longer the robot may go on before anybody sees that the drive no longer reports.
        """
        return max(self.encoder_window_s - ENCODER_S, self.answer_window_s - ANSWER_S)

    @property
    def late_s(self) -> float:
        """Return the lag that counts in every stopping distance: ``lag_s`` and ``unseen_s``."""
        return self.lag_s + self.unseen_s

    @property
    def dead_man_s(self) -> float:
        """Return the silence after which the base stops by itself, as its firmware claims [s]."""
        fixed_s = DRIVE_KINDS[self.kind].dead_man_s
        return self.timeout_s if fixed_s is None else fixed_s

    @property
    def reports_dead_man(self) -> bool:
        """Return whether each state tells that the dead-man has fired."""
        return DRIVE_KINDS[self.kind].reports_dead_man

    @property
    def virtual(self) -> bool:
        """Return whether the drive moves no metal; its kind says so, no setting can claim it."""
        return self.kind == "sim"


def _wrong_keys(drive: DriveConfig) -> Iterator[str]:
    """Yield what a kind of drive lacks, and what it was given though it can't use it."""
    needed, useful = DRIVE_KINDS[drive.kind].needed, DRIVE_KINDS[drive.kind].useful
    for key in needed:
        if getattr(drive, key) is None:
            yield f"drive.{key} is missing: kind {drive.kind!r} needs {', '.join(needed)}"
    for key in LINE_KEYS:
        if key not in needed + useful and getattr(drive, key) is not None:
            users = [name for name, kind in DRIVE_KINDS.items() if key in kind.needed + kind.useful]
            yield f"drive.{key} is for {', '.join(users)}, not for kind {drive.kind!r}"
    fixed_s = DRIVE_KINDS[drive.kind].dead_man_s
    if fixed_s is not None and drive.timeout_s != fixed_s and "timeout_s" in drive.model_fields_set:
        yield (
            f"drive.timeout_s {drive.timeout_s:g}: the firmware of kind {drive.kind!r} stops after "
            f"{fixed_s:g} s, whatever it is told; leave the key out"
        )
    empty_v, full_v = drive.battery_empty_v, drive.battery_full_v
    if (empty_v is None) != (full_v is None):
        yield "drive.battery_empty_v and battery_full_v come together or not at all"
    elif empty_v is not None and full_v is not None and not empty_v < full_v:
        yield f"drive.battery_empty_v {empty_v} must be less than battery_full_v {full_v}"
