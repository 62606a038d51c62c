"""Be ``pons up``: one run after the other, changing over where a person asks for that on the page.

From the demo robot to the home's own, to set-up and back, to a map that grows and to the site that
was made of it. Each begins as any start does: the robot stands, and metal is disarmed. What can't
be begun leaves in force what ran before it.
"""

from __future__ import annotations

import os
import signal
import sys
from typing import TYPE_CHECKING

from pons.children import begins_in_set_up, may_take_robot
from pons.home_lock import HomeLock, HomeTaken, HomeUnwritable
from pons.key import offer_key
from pons.launch_checks import (
    CannotStart,
    ChildRefusal,
    change_map,
    check,
    check_port,
    in_chinese,
    site_flaw,
    take_robot,
)
from pons.launch_words import CHANGED_BACK, chinese_line
from pons.running import RunningNote
from pons.supervisor import REFUSED_TO_START
from pons.terminal import pick
from pons.up import Supervisor, describe_base, say
from wire import EXIT_MAP, ConfigError

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

    from pons.authority import IssuedCertificate
    from pons.settings import LaunchSettings
    from wire import RobotDescription

    _Changeover = Callable[[LaunchSettings], tuple[LaunchSettings, RobotDescription]]
    _Handler = Callable[[int, FrameType | None], None]

PRIVATE = 0o077
"""What a robot keeps (sentences, recordings, places, logs) is for the user who runs it."""


def run(settings: LaunchSettings, *, planner: bool = True) -> int:
    """Be ``pons up``; without a planner the robot waits for another brain."""
    os.umask(PRIVATE)  # of the children too
    try:
        robot = check(settings)
        with HomeLock(settings.home):
            if not robot.drive.virtual:
                offer_key(settings)
            if planner:
                check_port(settings)
            if settings.domain is not None:
                from pons.domain import keep_domain

                settings, words = keep_domain(settings, robot)
                say(words)
            issued = _certify(settings) if planner and settings.tls else None
            return _run_each(settings, robot, planner=planner, issued=issued)
    except (CannotStart, HomeTaken, HomeUnwritable, ConfigError) as why:
        print(f"pons up: {_explain(settings, why, planner=planner)}", file=sys.stderr)
        return REFUSED_TO_START


def _run_each(
    settings: LaunchSettings,
    robot: RobotDescription,
    *,
    planner: bool,
    issued: IssuedCertificate | None,
) -> int:
    """Run what was asked for until no other is; what is refused before it was ready is undone."""
    before: tuple[LaunchSettings, RobotDescription] | None = None
    changed = False
    while True:
        try:
            with RunningNote(settings, robot.id) as note:
                came = _supervise(settings, robot, note, planner, issued, has_changed=changed)
            if isinstance(came, int):
                return came
            before, changed = (settings, robot), True
            settings, robot = came(settings)
        except (CannotStart, ConfigError) as why:
            if before is None or (isinstance(why, ChildRefusal) and why.is_late):
                raise
            say(f"{_explain(settings, why, planner=planner)}\n{pick(*CHANGED_BACK)}")
            (settings, robot), before = before, None


def _explain(settings: LaunchSettings, why: Exception, *, planner: bool) -> str:
    told = str(why)
    if isinstance(why, ChildRefusal):
        told += site_flaw(settings, told, planner=planner)
    return told + (in_chinese(why) or chinese_line(told))


def _certify(settings: LaunchSettings) -> IssuedCertificate:
    """Return this robot's certificate; the library that makes it is loaded for this alone."""
    from pons.tls import prepare

    return prepare(settings)


def _supervise(
    settings: LaunchSettings,
    robot: RobotDescription,
    note: RunningNote,
    planner: bool,
    issued: IssuedCertificate | None,
    *,
    has_changed: bool,
) -> int | _Changeover:
    """Return the exit status, or what a person asked to change over to."""
    where = settings.site.name if settings.canvas is None else f"a home to map: {settings.mapping}"
    set_up = planner and begins_in_set_up(settings, robot)
    while True:
        supervisor = Supervisor(
            settings,
            robot,
            note,
            planner=planner,
            issued=issued,
            set_up=set_up,
            has_changed=has_changed,
        )
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, _handler(supervisor))
        what = describe_base(settings, robot)
        say(f"starting {robot.id} ({what}) in {where} (state in {settings.home})")
        status = supervisor.run()
        if supervisor.change is None:
            return status
        if supervisor.change == EXIT_MAP:
            return change_map
        if may_take_robot(settings):
            return take_robot
        set_up, has_changed = not set_up, True
        robot = check(settings)  # a trial has written to it


def _handler(supervisor: Supervisor) -> _Handler:
    def handle(number: int, _frame: FrameType | None) -> None:
        say(f"{signal.Signals(number).name}: taking everything down")
        supervisor.change = None
        supervisor.end()

    return handle
