"""Drive a Waveshare UGV base (lines: devices/waveshare.py).

The base keeps no setting: heartbeat, echo and reports are sent when the port opens and every second
again. No state is passed on before the base has printed the heartbeat back, so nothing is armed
without one. Whether the heartbeat has stopped the wheels the base does not tell: ``timed_out`` is
null. Its speeds are integrated and held to the whole centimetres that it counts.
"""

from __future__ import annotations

import logging
import re
import secrets
from collections import deque
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from bridge.drive.base_gyro import BaseGyro
from bridge.drive.base_trouble import BASE_TROUBLES
from bridge.drive.readings import charge_of, limit_radps
from devices import waveshare
from devices.waveshare import UgvEcho, UgvReader, UgvReport, UgvSetting, UgvText
from wire import DriveState

if TYPE_CHECKING:
    from bridge.drive.base import Braking
    from wire import DriveCommand, RobotDescription

log = logging.getLogger("bridge.drive")

SETTINGS_EVERY = 100
"""Commands: a second. A base that was reset obeys at once, but comes back with 3 s of heartbeat."""
UNSET_REPORTS = 60
"""Three seconds of reports without a word of the heartbeat are a trouble worth a line."""
KEPT = 50
"""Commands that an echo may name: a second's."""
SILENT_S = 1.0
"""A base that starts is silent for longer: what speaks after such a silence is another."""
_BITS_A_BYTE = 10
_TAG_NAME = re.compile(r"[0-9a-z]{4}")
_TAG_SEQ = re.compile(r"[0-9]{1,15}")
_MILLI = 1000.0
_DIGITS = 4
_SLIP_M = 0.03
"""Two whole centimetres may hide three."""
_FRESH_CM = 50
"""Ways of a base that began less than a second ago: it was told nothing to drive since."""
_OLDEST_S = 0.25
_SURGE_MPS2 = 3.0
"""A wheel of this weight class gains less, but for one that is lifted or hits something."""
_SURGE_SLACK_MPS = 0.15
_SURGE_S = 0.1
"""Two reports' time. After a longer gap a speed is not more likely to be true."""


class BoundedPath:
    """Integrate a wheel's speed between reports, held to the centimetres that the base counts."""

    def __init__(self) -> None:
        self._m: float | None = None
        self._mps, self._at_s = 0.0, 0.0

    def advance(self, mps: float, whole_cm: int, at_s: float) -> float:
        """Return the way [m] by now.

        Whether the base rounds or cuts off is its own: the truth is within 1 cm of what it says.
        """
        low_m, high_m = (whole_cm - 1) / 100.0, (whole_cm + 1) / 100.0
        if self._m is None:
            self._m = whole_cm / 100.0
        else:
            dt_s = min(max(at_s - self._at_s, 0.0), _OLDEST_S)
            self._m = min(max(self._m + (self._mps + mps) / 2.0 * dt_s, low_m), high_m)
        self._mps, self._at_s = mps, at_s
        return self._m


@dataclass(slots=True)
class _KnownBase:
    """Hold what is known of a base since it began."""

    is_set: bool = False
    """It has printed our heartbeat back."""
    waited: int = 0
    """Reports without that."""
    sent: deque[tuple[str, float, float]] = field(default_factory=lambda: deque(maxlen=KEPT))
    """Tags with the speeds that went with them."""
    heard_s: float | None = None
    last: UgvReport | None = None
    """The newest that was believed."""
    odd: UgvReport | None = None
    """One that no wheel can have come to from there; believed if the next report agrees."""
    left: BoundedPath = field(default_factory=BoundedPath)
    right: BoundedPath = field(default_factory=BoundedPath)
    echo_boot: str | None = None
    echo_seq: int = 0
    enabled: bool = False


class WaveshareProtocol:
    """Translate between the wire's messages and the base's lines."""

    kind = "waveshare"
    baud = waveshare.BAUD
    """A command of 45 bytes 50 times a second and a report of 180 bytes 20 times: with the echo 58
    of 115 kbaud come back."""
    braking: Braking = "brake"
    """Both drivers' inputs differ and the PWM is low: TB6612 then shorts the motor."""

    def __init__(self, robot: RobotDescription, boot: str) -> None:
        self._config, self._radius_m = robot.drive, robot.base.wheel_radius_m
        self.gyro = BaseGyro(robot)
        self._boot = boot
        self._name = secrets.token_hex(2)
        """Stands for ``boot`` in the tag."""
        self._heartbeat_ms = round(robot.drive.timeout_s * _MILLI)
        self._settings = waveshare.encode_settings(self._heartbeat_ms)
        self._reader = UgvReader()
        self._sent, self._stopped = 0, True
        self._seq = 0
        self.trouble: str | None = None
        """What keeps its reports from being passed on (base_trouble.py)."""
        self._starts = 0
        self._due = True
        self._base = _KnownBase()

    def begin(self) -> bytes:
        """Forget the unfinished line and the base; tell it all that it must know."""
        self._reader.reset()
        self._forget()
        return self._settings

    def encode(self, command: DriveCommand) -> bytes:
        """Return the line of every second command, of each that begins a stop, and the settings.

        The base reads its line once a turn of its loop, and prints back all that it reads: at 100
        lines a second it would fall behind.
        """
        stops = not command.enable or command.left_radps == command.right_radps == 0.0
        data = b""
        self._sent += 1
        if self._due or self._sent % SETTINGS_EVERY == 0:
            self._due, data = False, self._settings
        if command.seq % 2 == 0 or stops > self._stopped:
            tag = f"{self._name}-{command.seq}-{command.enable:d}"
            speeds = (0.0, 0.0) if stops else self._speeds_of(command)
            self._base.sent.append((tag, *speeds))
            data += waveshare.encode_speed(*speeds, tag)
            self._stopped = stops
        return data

    @property
    def spoilt(self) -> int:
        """Return how many lines could not be read."""
        return self._reader.spoilt_lines

    def question(self, seq: int) -> bytes:
        """Return nothing: the base speaks by itself."""
        return b""

    def _speeds_of(self, command: DriveCommand) -> tuple[float, float]:
        """Return both wheels' speeds [m/s], scaled to what the base does not ignore."""
        left_mps = command.left_radps * self._radius_m
        right_mps = command.right_radps * self._radius_m
        over = max(abs(left_mps), abs(right_mps)) / waveshare.FASTEST_MPS
        scale = 1.0 if over <= 1.0 else 1.0 / over
        return round(left_mps * scale, _DIGITS), round(right_mps * scale, _DIGITS)

    def decode(self, data: bytes, now_s: float) -> list[DriveState]:
        """Return the states that bytes read at ``now_s`` complete, oldest first."""
        states: list[DriveState] = []
        for line in self._reader.read(data):
            match line:
                case UgvReport():
                    ways_cm = self._take(line, now_s)
                    if ways_cm is not None:
                        states.append(self._state(line, ways_cm, now_s))
                case UgvEcho():
                    self._note_echo(line)
                case UgvSetting(waveshare.T_HEARTBEAT, value):
                    self._base.is_set = value == self._heartbeat_ms
                case UgvText() if line.words in waveshare.START_WORDS:
                    self._note_start("it printed that it starts")
                case _:
                    pass
        return states

    def _take(self, report: UgvReport, now_s: float) -> tuple[int, int] | None:
        """Note what a report shows of the base; return its ways [cm] if it may be passed on."""
        heard_s, self._base.heard_s = self._base.heard_s, now_s
        if report.ways_cm is None:
            self._say("base_firmware_old" if report.is_old else "base_no_encoders")
            return None
        if heard_s is not None and now_s - heard_s > SILENT_S:
            self._note_start(f"it was silent for {now_s - heard_s:.1f} s")
            self._base.heard_s = now_s
        if not self._follows(report, now_s - (heard_s or now_s)):
            return None
        if not self._base.is_set:
            self._base.waited += 1
            if self._base.waited > UNSET_REPORTS:
                self._say("base_not_set")
            return None
        self._say(None)
        return report.ways_cm

    def _follows(self, report: UgvReport, dt_s: float) -> bool:
        """Tell whether wheels can have come to this; what lasts is true, however odd.

        Lines have no checksum: a flipped bit makes 2.3 m/s of 0.3. A jump of the ways that lasts is
        a base that began anew, one of the speeds a wheel that was lifted, hit something or runs
        away, which is so told one report later, and by ENC_STALE before where reports are lost.
        """
        last, odd = self._base.last, self._base.odd
        if last is None or _can_follow(last, report, dt_s):
            self._base.last, self._base.odd = report, None
            return True
        if odd is None or not _can_follow(odd, report, dt_s):
            self._base.odd = report
            return False
        if not _is_near_way(last, report, dt_s):
            self._note_jump(last, report)
        self._base.last, self._base.odd = report, None
        return True

    def _state(self, report: UgvReport, ways_cm: tuple[int, int], now_s: float) -> DriveState:
        stamp_s = now_s - report.size * _BITS_A_BYTE / self.baud
        left_m = self._base.left.advance(report.left_mps, ways_cm[0], stamp_s)
        right_m = self._base.right.advance(report.right_mps, ways_cm[1], stamp_s)
        self._seq += 1
        state = DriveState(
            boot_id=f"ugv-{self._name}-{self._starts}",
            seq=self._seq,
            stamp_s=stamp_s,
            echo_boot=self._base.echo_boot,
            echo_seq=self._base.echo_seq,
            enabled=self._base.enabled,
            timed_out=None,
            left_rad=left_m / self._radius_m,
            right_rad=right_m / self._radius_m,
            left_radps=limit_radps(report.left_mps / self._radius_m),
            right_radps=limit_radps(report.right_mps / self._radius_m),
            battery=charge_of(report.volts, self._config),
            estop_pressed=False,
            bumper_front=False,
            bumper_rear=False,
            cliff=False,
        )
        self.gyro.note(report.inertial, state)
        return state

    def _note_echo(self, echo: UgvEcho) -> None:
        """Note which command the base printed back; a tag of another shape is nobody's.

        Lines have no checksum. One that came back with other speeds than were sent was misread on
        one of its ways: it is no echo, and the row DRIVER_NACK counts.
        """
        name, _, rest = echo.tag.partition("-")
        seq, _, enable = rest.partition("-")
        if not (_TAG_NAME.fullmatch(name) and _TAG_SEQ.fullmatch(seq) and enable in {"0", "1"}):
            return
        is_ours = name == self._name
        if is_ours and (echo.tag, echo.left_mps, echo.right_mps) not in self._base.sent:
            log.warning("base_misread: it printed back %s, which was not sent so", echo)
            return
        self._base.echo_boot = self._boot if is_ours else f"other-{name}"
        self._base.echo_seq, self._base.enabled = int(seq), enable == "1"

    def _note_start(self, why: str) -> None:
        """Take note that the base began anew: it knows no setting, and counts from nought."""
        if self._base.is_set:  # it says several things while it starts
            log.warning("base_reset: %s; its settings are sent anew", why)
        self._forget()

    def _note_jump(self, last: UgvReport, report: UgvReport) -> None:
        """Tell a base that counts from nought from one whose lines came spoilt; count both anew."""
        why = f"its ways jumped from {last.ways_cm} to {report.ways_cm} cm"
        if all(abs(way_cm) <= _FRESH_CM for way_cm in report.ways_cm or ()):
            self._note_start(why)
            return
        log.warning("base_spoilt: %s, not to nought: a line was spoilt; counted anew", why)
        self._forget()

    def _forget(self) -> None:
        self._starts += 1
        self._due = True
        self._base = _KnownBase()

    def _say(self, code: str | None) -> None:
        """Log a trouble once, not 20 times a second."""
        if code is not None and code != self.trouble:
            log.error("%s: %s", code, BASE_TROUBLES[code][0])
        self.trouble = code


def _can_follow(before: UgvReport, after: UgvReport, dt_s: float) -> bool:
    most_mps = _SURGE_SLACK_MPS + _SURGE_MPS2 * min(max(dt_s, 0.0), _SURGE_S)
    return (
        _is_near_way(before, after, dt_s)
        and abs(after.left_mps - before.left_mps) <= most_mps
        and abs(after.right_mps - before.right_mps) <= most_mps
    )


def _is_near_way(before: UgvReport, after: UgvReport, dt_s: float) -> bool:
    most_cm = 100.0 * (2 * waveshare.FASTEST_MPS * dt_s + _SLIP_M)
    pairs = zip(before.ways_cm or (), after.ways_cm or (), strict=True)
    return all(abs(one - other) <= most_cm for one, other in pairs)
