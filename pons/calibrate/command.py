"""Be ``pons calibrate``: open the sessions, drive, show what would change, ask, write.

Nothing is written before the last yes, and on Ctrl-C the robot is let go: it stands.
"""

from __future__ import annotations

import signal
import sys
import time
from typing import TYPE_CHECKING

from pons.calibrate.errors import CalibrationRefusal
from pons.calibrate.gyro_track import find_track
from pons.calibrate.odometry_radius import find_radius
from pons.calibrate.procedure import CalibrationPlan, calibrate
from pons.calibrate.reference import MEASURED
from pons.calibrate.robot_toml import difference, edit_values, replace
from pons.calibrate.session import CalibrationRig
from pons.launch_words import chinese_line
from pons.robot.presets import is_shipped
from pons.terminal import pick
from wire import ConfigError, load_robot
from wire.keys import Party
from wire.session import open_session

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

    from pons.calibrate.findings import CalibrationFinding
    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_REFUSED, EXIT_INTERRUPTED = 0, 3, 130
PUMP_S = 0.004
NOTHING = "nothing was written", "未写入任何内容"


def run(
    settings: LaunchSettings,
    *,
    reference: str | None,
    measured_m: list[float] | None,
    shuttles: int,
    patience_s: float,
    yes: bool,
    track: bool = False,
) -> int:
    """Calibrate; 0 written or nothing to change, 3 refused, 130 interrupted."""
    signal.signal(signal.SIGTERM, _interrupt)
    try:
        if is_shipped(settings.robot):
            made = f"pons robot new NAME --from {settings.robot.stem}"
            raise CalibrationRefusal("shipped_robot_toml", made)
        text = settings.robot.read_text("utf-8") if settings.robot.is_file() else ""
        stamp = time.gmtime()
        kind = MEASURED if measured_m is not None else reference
        asked = CalibrationPlan(kind, shuttles, patience_s=patience_s)
        when = time.strftime("%FT%TZ", stamp)
        found = _measure(settings, asked, measured_m or [], when, track=track)
        return _write(settings, text, found, time.strftime("%Y%m%dT%H%M%SZ", stamp), yes=yes)
    except CalibrationRefusal as refused:
        print("\n".join(refused.lines()), file=sys.stderr)
        return EXIT_REFUSED
    except (ConfigError, OSError) as trouble:
        print(f"{trouble}{chinese_line(str(trouble))}\n{pick(*NOTHING)}", file=sys.stderr)
        return EXIT_REFUSED
    except KeyboardInterrupt:
        print(
            f"{pick('interrupted: the robot stands', '已中断：机器人已停')}; {pick(*NOTHING)}",
            file=sys.stderr,
        )
        return EXIT_INTERRUPTED


def _interrupt(_number: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt


def _measure(
    settings: LaunchSettings,
    plan: CalibrationPlan,
    typed: list[float],
    when: str,
    *,
    track: bool,
) -> list[CalibrationFinding]:
    robot = load_robot(settings.robot)
    metres = _metres(typed)
    with (
        open_session(Party.OPERATOR, robot.id, settings.home) as operator,
        open_session(Party.JUDGE, robot.id, settings.home) as judge,
    ):
        rig = CalibrationRig(operator, judge, time.monotonic, lambda: time.sleep(PUMP_S))
        if track:
            return find_track(rig, robot, plan, when, _say)
        if robot.drive.port is not None:
            return find_radius(rig, robot, plan, when, _say, lambda: next(metres))
        return calibrate(rig, robot, plan, when, _say, lambda: next(metres))


def _metres(typed: list[float]) -> Iterator[float]:
    """Yield what a person measured: first what came with the command, then what is typed now.

    Raises:
        CalibrationRefusal: ``no_measure``.
    """
    yield from typed
    while True:
        if not sys.stdin.isatty():
            raise CalibrationRefusal("no_measure", f"{len(typed)} were given; one for each run")
        answer = input("how far did it go, by tape? [m] ")
        try:
            yield float(answer)
        except ValueError:
            raise CalibrationRefusal("no_measure", f"{answer!r}") from None


def _write(
    settings: LaunchSettings, before: str, found: list[CalibrationFinding], stamp: str, *, yes: bool
) -> int:
    """Show the difference, ask, write."""
    for one in found:
        print(f"{one.name:<24} {one.was:g} -> {one.value:g}   ({one.evidence})")
    after = edit_values(before, found)
    print(difference(settings.robot, before, after), flush=True)
    if not yes and not _ask_to_write(settings):
        raise CalibrationRefusal("not_confirmed", "" if sys.stdin.isatty() else "--yes writes it")
    kept = replace(settings.robot, before, after, stamp)
    _say(f"wrote {settings.robot}; the old one is {kept.name}")
    _say("start `pons up` anew for it to count; the robot is held: `pons resume` frees it")
    return EXIT_DONE


def _ask_to_write(settings: LaunchSettings) -> bool:
    if not sys.stdin.isatty():
        return False
    return input(f"write {settings.robot}? [y/N] ").strip().lower() in {"y", "yes", "是"}


def _say(text: str) -> None:
    print(f"calibrate: {text}", flush=True)
