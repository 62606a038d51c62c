"""Start the whole robot, keep it running, take it all down: one run of ``pons up``.

Starts simulator (on a virtual drive), localization, bridge and planner, and once these are ready
the simulated camera; restarts what dies, waiting longer each time; arms the simulator once; prints
the one URL when the planner says it is ready. On Ctrl-C, SIGTERM or its own death nothing is left
running.
"""

from __future__ import annotations

import signal
import threading
import time
from contextlib import suppress
from math import inf
from typing import TYPE_CHECKING

from pons.children import children, set_up_children
from pons.http import PlannerDown, PlannerProblem, call
from pons.kept_sockets import KeptSockets
from pons.launch_checks import CannotStart, ChildRefusal
from pons.launch_words import (
    NO_LIDAR,
    SEARCHES,
    SET_UP,
    UNREACHED,
    brain_example,
    what_to_try,
)
from pons.readiness import Readiness, ask_readiness
from pons.robot_processes import PATIENCE_S
from pons.supervisor import REFUSED_TO_START
from pons.terminal import pick
from wire import EXIT_MAP, EXIT_SET_UP
from wire.doors import BRIDGE_DOOR
from wire.sockets import Endpoints

if TYPE_CHECKING:
    from pons.authority import IssuedCertificate
    from pons.running import RunningNote
    from pons.settings import LaunchSettings
    from wire import RobotDescription

POLL_S = 0.05
READY_LIMIT_S = 60.0
UNREACHED_TOLD_S = 3.0
"""A robot's computer that answers at all does so within this time."""
_NO_ROS2 = "ros2_no_"
"""How the codes begin that say that nobody answers there (ros2/trouble.py)."""
ARM_RETRY_S = 0.5
SEARCH_TOLD_S = 20.0
"""A home in which it is clear where the robot is takes a tenth of it."""
LOOK_S = 0.5
"""The longest that a removed socket stays unreachable, or a log longer than its bound."""
_CHANGERS = frozenset({"planner", "setup"})


class Supervisor:
    """Own the children of one ``pons up``."""

    def __init__(
        self,
        settings: LaunchSettings,
        robot: RobotDescription,
        note: RunningNote,
        *,
        planner: bool,
        issued: IssuedCertificate | None = None,
        set_up: bool = False,
        has_changed: bool = False,
    ) -> None:
        self._is_patient = has_changed or set_up or _is_of_ros2(settings, robot)
        """The page is all that this person has: it is not taken away for being slow."""
        self._told_up: set[str] = set()
        self._said_late = self._said_search = self._said_unreached = False
        self.change: int | None = None
        """The status with which a child asked for a changeover; None: none is asked for."""
        self._set_up = set_up
        self._trust = issued.trust_lines() if issued else ()
        self._settings = settings
        self._robot, self._note = robot, note
        self._planner = planner
        self._ending = threading.Event()
        self._children = (
            set_up_children(settings, issued)
            if set_up
            else children(settings, robot, planner=planner, issued=issued)
        )
        self._said_ready = False
        self._readiness = Readiness.WAITING
        self._searches_since_s, self._searched_s = inf, -inf
        self._armed = not robot.drive.virtual  # on metal a person arms
        self._next_arm_s = 0.0
        self._next_look_s = 0.0
        self._sockets = KeptSockets(settings.home)

    def end(self, *_: object) -> None:
        """Ask the loop to finish; safe in a signal handler."""
        self._ending.set()

    def run(self) -> int:
        """Supervise until asked to end; return the exit status."""
        began_s = time.monotonic()
        try:
            while not self._ending.is_set():
                now_s = time.monotonic()
                self._tend(now_s)
                self._greet(now_s, began_s)
                self._ending.wait(POLL_S)
        finally:
            self._take_down()
        return 0

    def _tend(self, now_s: float) -> None:
        for child in self._children:
            if child.kill_if_hung(now_s):
                say(f"{child.name} hangs: killed. Its log: {child.log}")
            status = child.died(now_s)
            if status == REFUSED_TO_START:
                told = f"{child.name} refused to start:\n{child.last_words()}"
                raise ChildRefusal(told, is_late=self._said_ready)
            if status in (EXIT_SET_UP, EXIT_MAP) and child.name in _CHANGERS:
                self.change = status
                self.end()
                return
            if status is not None:
                self._sockets.forget(child.name)
                wait_s = child.next_start_s - now_s
                say(f"{child.name} ended ({describe(status)}); again in {wait_s:.1f} s. "
                    f"Its log: {child.log}")  # fmt: skip
            if child.due(now_s) and (self._said_ready or not child.waits_for_ready):
                child.start(now_s)
        if now_s >= self._next_look_s:
            self._next_look_s = now_s + LOOK_S
            self._look_after_files()

    def _look_after_files(self) -> None:
        self._note.keep()
        for child in self._children:
            child.bound_log()
            if child.name not in self._told_up and self._sockets.is_kept(child.name):
                self._told_up.add(child.name)  # of its first start alone: later ones are told above
                say(f"  {child.name} is up")
            if child.process is not None:
                for path in self._sockets.look_after(child.name):
                    say(f"{path} was removed, and is there again")

    def _greet(self, now_s: float, began_s: float) -> None:
        """Arm the simulator once, then print the URL once."""
        if self._said_ready:
            return
        if now_s >= self._next_arm_s:
            self._next_arm_s = now_s + ARM_RETRY_S
            if self._ready() and self._arm():
                self._said_ready = True
                self._say_ready(now_s - began_s)
                return
            self._tell_unreached(now_s - began_s)
        if self._readiness is Readiness.SEARCHING:  # a person may tell it where it is
            self._searches_since_s = min(self._searches_since_s, now_s)
            self._searched_s = now_s
            if now_s - self._searches_since_s > SEARCH_TOLD_S and not self._said_search:
                self._said_search = True
                say(f"{self._settings.url}\n{pick(*SEARCHES)}")
            return
        if now_s - max(began_s, self._searched_s) > READY_LIMIT_S:
            text = (
                f"not_ready: the {'planner' if self._planner else 'bridge'} was not ready within "
                f"{READY_LIMIT_S:.0f} s; logs are in {self._settings.home / 'logs'}"
            )
            if not self._is_patient:
                raise CannotStart(text)
            if not self._said_late:
                say(text)
            self._said_late = True

    def _tell_unreached(self, after_s: float) -> None:
        """Say once why the robot's ROS 2 computer is not reached; dialling goes on."""
        if self._said_unreached or after_s < UNREACHED_TOLD_S:
            return
        newest = next((each.last_words(1) for each in self._children if each.name == "ros2"), "")
        if _NO_ROS2 in newest:
            self._said_unreached = True
            cause = newest[newest.index(_NO_ROS2) :]
            say(f"{self._settings.url}\nrobot_unreached: {cause}\n  {pick(*UNREACHED)}")

    def _say_ready(self, after_s: float) -> None:
        if self._planner:
            say(f"ready after {after_s:.1f} s: {self._settings.url}")
            for line in self._trust:
                say(line)
            metal = not self._robot.drive.virtual
            say(pick(*SET_UP) if self._set_up else what_to_try(self._settings, arms=metal))
        else:
            socket_path = Endpoints(self._settings.home).socket(BRIDGE_DOOR)
            say(f"ready after {after_s:.1f} s, without a planner: {socket_path}")
            say(f"try: {brain_example(self._settings.home)}")

    def _ready(self) -> bool:
        if not self._planner:
            return True  # arming asks the bridge itself
        self._readiness = ask_readiness(self._settings, set_up=self._set_up)
        return self._readiness is Readiness.READY

    def _arm(self) -> bool:
        if self._armed:
            return True
        if not self._planner:
            from pons.bridge_client import arm_direct

            self._armed = arm_direct(self._settings)
        else:
            with suppress(PlannerDown, PlannerProblem):
                answer = call(self._settings, "POST", "/v1/arm", {}, timeout_s=3.0)
                self._armed = bool(answer.get("accepted"))
        return self._armed

    def _take_down(self) -> None:
        """End the planner first, so that the bridge still brakes; the drive last."""
        for child in reversed(self._children):
            child.stop(PATIENCE_S)
            self._sockets.forget(child.name)


def _is_of_ros2(settings: LaunchSettings, robot: RobotDescription) -> bool:
    return robot.ros2 is not None and not settings.twin


def describe_base(settings: LaunchSettings, robot: RobotDescription) -> str:
    """Say what is driven: a robot.toml that lost its [drive] is a simulated robot."""
    drive = robot.drive
    if drive.virtual:
        return "simulated"
    if settings.twin:
        return f"{drive.kind}, played by its twin"
    base = drive.kind if drive.port is None else f"{drive.kind} at {drive.port}"
    return base + (pick(*NO_LIDAR) if robot.lidar.is_simulated else "")


def describe(status: int) -> str:
    """Say how a process ended."""
    return f"signal {signal.Signals(-status).name}" if status < 0 else f"exit status {status}"


def say(text: str) -> None:
    """Print one line for the person, at once."""
    print(f"pons: {text}", flush=True)
