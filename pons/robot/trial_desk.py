"""Take a page's orders about trying the robot and say how it stands. Knows no session.

One thing at a time, each on a thread of its own: a trial, or a look at the ports. A trial begins
only with the operator's proof; a stop ends it at the next tick, from anybody and always.
"""

from __future__ import annotations

import secrets
import threading
import time
from collections import deque
from typing import TYPE_CHECKING, Final

from devices.camera_listing import list_cameras
from devices.port_listing import describe_port, list_ports
from pons.calibrate.errors import CalibrationRefusal
from pons.robot.command import (
    CODES,
    HEAD,
    adapter_words,
    camera_part,
    describe_code,
    printable,
    robot_part,
)
from pons.robot.page_person import MOST_CHARACTERS, PagePerson
from pons.robot.port_finder import question_ports
from pons.robot.trial_parties import TrialRefusal
from pons.robot.trial_run import load_triable, plan_steps, record_lines, refusal_of, try_robot
from pons.robot.trial_words import PROMPTS, REFUSALS
from wire import ConfigError, PortReport, Sentence, TrialOrder, TrialState, authentic
from wire.trial_dialogue import mark_of

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from devices.camera_listing import CameraEntry
    from pons.robot.port_finder import PortFinding
    from wire import RobotDescription
    from wire.trial_dialogue import TrialPhase

FIRST: Final = "wheels_up"
MOST_PORTS, MOST_LINES = 32, 64


class TrialDesk:
    """Hold the trial of one robot.toml."""

    def __init__(
        self, path: Path, key: bytes, boot: str, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """Describe the robot.

        Raises:
            TrialRefusal, ConfigError: it is not one that can be tried.
        """
        self._path, self._key, self._boot, self._clock = path, key, boot, clock
        self.robot = load_triable(path)
        self._tried = _date_of(self.robot)
        self.nonce = secrets.token_hex(8)
        """What the next begin must be proved under."""
        self.leaves = False
        """Somebody asked to drive, and the robot is tried."""
        self._phase: TrialPhase = "idle"
        self._by: str | None = None
        self._person: PagePerson | None = None
        self._work: threading.Thread | None = None
        self._is_trial = False
        self._refusal: TrialRefusal | None = None
        self._wrote: tuple[str, ...] = ()
        self._ports: tuple[PortReport, ...] | None = None
        self._part: tuple[str, ...] = ()
        self._heard: deque[str] = deque(maxlen=32)
        self._seq = 0

    @property
    def is_busy(self) -> bool:
        """Tell whether ports are open."""
        return self._work is not None and self._work.is_alive()

    @property
    def may_turn(self) -> bool:
        """Tell whether wheels may turn: a trial's line is open."""
        return self._is_trial and self.is_busy

    def take(self, order: TrialOrder) -> None:
        """Do what a page asks; an order that came before is not done twice."""
        if order.act == "watch":
            if order.id == self._by and self._person is not None:
                self._person.watch(order.answered)
            return
        if order.id in self._heard or self.is_busy:
            return
        self._heard.append(order.id)
        if order.act == "begin":
            self._begin(order)
        elif order.act == "find":
            self._phase = "finding"
            self._start(self._find)
        else:
            self._leave()

    def stop(self) -> None:
        """End a trial; :attr:`may_turn` falls when its wheels were told to stand."""
        if self._person is not None:
            self._person.stop()

    def close(self) -> None:
        """Stop, and wait until the lines are given back."""
        self.stop()
        if self._work is not None:
            self._work.join()

    def state(self) -> TrialState:
        """Say all of it."""
        self._seq += 1
        person, refusal = self._person, self._refusal
        asks = person.code if person is not None and self._phase == "trying" else None
        return TrialState(
            boot=self._boot,
            seq=self._seq,
            robot=self.robot.id,
            drive=self.robot.drive.kind,
            port=str(self.robot.drive.port)[:MOST_CHARACTERS],
            tried=self._tried,
            phase=self._phase,
            by=mark_of(self._by) if self._by is not None else None,
            plan=plan_steps(self.robot),
            steps=person.steps if person is not None else (),
            ask=person.asked if person is not None and asks is not None else 0,
            question=_sentence(PROMPTS[asks]) if asks is not None else None,
            code=refusal.code if refusal is not None else None,
            detail=refusal.detail[:MOST_CHARACTERS] if refusal is not None else "",
            cure=_sentence(REFUSALS[refusal.code]) if refusal is not None else None,
            wrote=self._wrote,
            ports=self._ports,
            part=self._part,
        )

    def _begin(self, order: TrialOrder) -> None:
        proof = order.proof
        fits = (
            proof is not None
            and secrets.compare_digest(proof.nonce, self.nonce)
            and authentic(self._key, "trial", self.robot.id, proof, order.id)
        )
        self._by, self._wrote, self._person = order.id, (), None
        if not fits:  # the nonce stays: else anybody's bad begin would keep the owner out
            self._refuse(TrialRefusal("trial_untold"))
            return
        self.nonce = secrets.token_hex(8)
        self._person = PagePerson(self._clock)
        self._person.tell(FIRST)
        self._phase, self._refusal = "trying", None
        self._start(self._try, is_trial=True)

    def _leave(self) -> None:
        self._look_again()
        if self._tried is None:
            self._refuse(TrialRefusal("trial_missing"))
        else:
            self.leaves = True

    def _start(self, work: Callable[[], None], *, is_trial: bool = False) -> None:
        self._is_trial = is_trial
        self._work = threading.Thread(target=work, name="trial", daemon=True)
        self._work.start()

    def _try(self) -> None:
        person = self._person
        if person is None:
            return
        try:
            self.robot = load_triable(self._path)  # a person may have mended it
            result = try_robot(self._path, self.robot, person)
        except TrialRefusal as refusal:
            self._refuse(refusal)
        except (ConfigError, CalibrationRefusal, OSError) as trouble:
            self._refuse(refusal_of(trouble))
        else:
            self._wrote = tuple(record_lines(result.record))
            self._look_again()
            self._phase = "proved"

    def _find(self) -> None:
        try:
            entries = list_ports()
            known = {entry.path.resolve() for entry in entries}
            for named in (self.robot.drive.port, self.robot.lidar.port):
                path = None if named is None else self._path.parent / named
                if path is not None and path.exists() and path.resolve() not in known:
                    entries.append(describe_port(path))
            found = question_ports(entries[:MOST_PORTS])
            cameras = list_cameras()[:MOST_PORTS]
            reports = [*map(_report, found), *map(_report_camera, cameras)]
            self._ports = tuple(reports[:MOST_PORTS])
            parts = list(robot_part(found))
            head = [] if parts or not cameras else [HEAD]
            part = [*parts, *head, *camera_part(cameras)]
            self._part = tuple(line[:MOST_CHARACTERS] for line in part)[:MOST_LINES]
        finally:
            self._phase = "idle" if self._refusal is None else "refused"

    def _refuse(self, refusal: TrialRefusal) -> None:
        self._refusal = refusal
        self._phase = "refused"

    def _look_again(self) -> None:
        """Read robot.toml anew: what a trial wrote, or a person."""
        try:
            self.robot = load_triable(self._path)
            self._tried = _date_of(self.robot)
        except (TrialRefusal, ConfigError):
            self._tried = None


def _date_of(robot: RobotDescription) -> str | None:
    trial = robot.valid_trial
    return None if trial is None else trial.date


def _sentence(pair: tuple[str, str]) -> Sentence:
    return Sentence(en=pair[0][:MOST_CHARACTERS], zh=pair[1][:MOST_CHARACTERS])


def _report_camera(one: CameraEntry) -> PortReport:
    cure = None if one.is_permitted else _sentence(describe_code("camera_forbidden", ""))
    return PortReport(
        path=str(one.path)[:MOST_CHARACTERS],
        adapter=printable(one.name)[:MOST_CHARACTERS],
        code="camera_found" if one.is_permitted else "camera_forbidden",
        device=f"camera uvc: {one.lasting}"[:MOST_CHARACTERS],
        cure=cure,
    )


def _report(one: PortFinding) -> PortReport:
    device, cure = "", None
    if one.answer is not None:
        device = f"{one.part} {one.kind}, {one.baud} baud: {one.answer.words}"
    elif one.code in CODES:
        cure = _sentence(describe_code(one.code, one.detail))
    if one.entry.twins:
        others = ", ".join(map(str, one.entry.twins))
        cure = _sentence(describe_code("port_twins", others))
    return PortReport(
        path=str(one.entry.path)[:MOST_CHARACTERS],
        adapter=adapter_words(one.entry)[:MOST_CHARACTERS],
        code=one.code,
        device=device[:MOST_CHARACTERS],
        cure=cure,
    )
