"""Hold the stick: speak as a hand does, hear what drive, lidar and simulator say, notice trouble.

The bridge treats this like any stick: dead-man released and neutral first; limits, rows and gates
in force; a hand that falls silent lets go. Sessions, clock and waiting are given, so that the same
code drives real processes and a lockstep world.
"""

from __future__ import annotations

from collections import deque
from contextlib import contextmanager
from typing import TYPE_CHECKING

from pons.calibrate.errors import CalibrationRefusal, RunLost
from pons.calibrate.reference import SCANS, WallLook
from pons.calibrate.track import DriveTrack
from wire import (
    DriveCommand,
    DriveState,
    Mode,
    Odometry,
    Pose2,
    RowReport,
    Scan,
    SimTruth,
    Status,
    Velocity,
    distance,
)
from wire.keys import DRIVE_COMMAND, DRIVE_STATE, ODOM, SCAN, SIM_TRUTH, STATUS, TELEOP

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from wire.session import Session

SOURCE = "calibrate"
PERIOD_S = 0.05
SILENT_S = 1.0
TAKE_OVER_S, STAND_S, FIRST_S = 3.0, 6.0, 3.0
PASSES_S = 3.0
"""What a hand that has just ended leaves behind, another calibration's too, has passed by then."""
STANDS_S = 0.4
QUIET_S = 3.0
"""Rows of the drive clear by themselves within a second, once it is well."""
STANDING_MPS, STANDING_RADPS = 0.02, 0.05
TURNS_S, TURNS_RAD = 0.5, 0.02
"""A wheel that is asked to turn does so much in so long, or nobody sees it turn."""
DRIVE_ROWS = {
    "ENC_STALE", "DRIVER_NACK", "DRIVE_REBOOT", "RUNAWAY", "STUCK", "YAW_DISAGREE", "OVERCURRENT",
}  # fmt: skip
NO_GYRO = "no gyro"
"""What YAW_DISAGREE says for ever of a robot without one: no fault, and no run is lost by it."""
WAY_GATES = {"obstacle", "contact", "fence"}


class CalibrationRig:
    """Drive by teleop and listen."""

    def __init__(
        self,
        operator: Session,
        judge: Session,
        clock: Callable[[], float],
        wait: Callable[[], None],
    ) -> None:
        self._clock, self._wait = clock, wait
        self._mouth = operator.publisher(TELEOP)
        self._status = operator.subscriber(STATUS)
        self._odometry = operator.subscriber(ODOM)
        self._commands = judge.subscriber(DRIVE_COMMAND)
        self._states = judge.subscriber(DRIVE_STATE)
        self._scan = judge.subscriber(SCAN)
        self._truth = judge.subscriber(SIM_TRUTH)
        self.status: Status | None = None
        self.state: DriveState | None = None
        self.truth: SimTruth | None = None
        self.scans: deque[Scan] = deque(maxlen=SCANS)
        self.track: DriveTrack | None = None
        self.odometry: list[Odometry] | None = None
        """Where what the bridge reckons is kept; None keeps nothing."""
        self._odom: Pose2 | None = None
        self.way_m = 0.0
        """What odometry has come since the rig was made, back and forth."""
        self._heard_s = clock()
        self._said_s = 0.0
        self._seq = 0
        self._wish: tuple[float, float, bool] | None = None
        """Speed, turn and dead-man as they are said now; None says nothing."""

    @property
    def now_s(self) -> float:
        """Return the time."""
        return self._clock()

    def pump(self) -> None:
        """Let a moment pass: hear everybody, send all messages that are due."""
        self._wait()
        now_s = self._clock()
        status = self._status.newest()
        if status is not None:
            self.status, self._heard_s = status, now_s
        self._hear()
        self._hear_odometry()
        if self._wish is not None and now_s - self._said_s >= PERIOD_S - 1e-9:
            self._said_s = now_s
            self._say(*self._wish)

    def _hear(self) -> None:
        track = self.track
        for state in self._states.drain().items:
            if isinstance(state, DriveState):
                self.state = state
                if track is not None:
                    track.hear_state(state)
        for command in self._commands.drain().items:
            if isinstance(command, DriveCommand) and track is not None:
                track.told[command.seq] = command
                if self.state is not None:
                    track.behind.append(command.seq - self.state.echo_seq)
        for scan in self._scan.drain().items:
            if isinstance(scan, Scan):
                self.scans.append(scan)
        for truth in self._truth.drain().items:
            if isinstance(truth, SimTruth):
                self.truth = truth
                if track is not None:
                    track.hear_truth(truth)

    def _hear_odometry(self) -> None:
        for odometry in self._odometry.drain().items:
            if isinstance(odometry, Odometry):
                pose = odometry.base_in_odom
                self.way_m += distance(self._odom, pose) if self._odom is not None else 0.0
                self._odom = pose
                if self.odometry is not None:
                    self.odometry.append(odometry)

    def _say(self, v_mps: float, w_radps: float, dead_man: bool) -> None:
        if self.status is None:
            return
        self._seq += 1
        self._mouth.put(
            Velocity(
                source_id=SOURCE,
                epoch=self.status.epoch,
                seq=self._seq,
                seen=self.status.seq,
                v_mps=v_mps,
                w_radps=w_radps,
                dead_man=dead_man,
            )
        )

    # What a person does with a stick --------------------------------------------------------------

    def listen(self, *, needs_senses: bool = True) -> Status:
        """Wait for the first words of the bridge and, where they are needed, of drive and lidar.

        Raises:
            CalibrationRefusal: ``no_bridge``, ``no_drive`` or ``no_lidar``.
        """
        self._until(lambda: self.status is not None, FIRST_S)
        if self.status is None:
            raise CalibrationRefusal("no_bridge")
        if needs_senses:
            self._until(lambda: self.state is not None and len(self.scans) > 0, FIRST_S)
            if self.state is None:
                raise CalibrationRefusal("no_drive")
            if not self.scans:
                raise CalibrationRefusal("no_lidar", "no scan arrived")
        self._until(lambda: not self._is_mode({Mode.TELEOP, Mode.STOPPING}), PASSES_S)
        return self.status

    def take(self) -> None:
        """Take the stick over: released, neutral, then held.

        Raises:
            CalibrationRefusal, RunLost: the bridge does not give it.
        """
        self._wish = (0.0, 0.0, False)
        self._for(0.25)
        self._wish = (0.0, 0.0, True)
        self._until(self.is_driving, TAKE_OVER_S)
        if not self.is_driving():
            self._raise_why()
            raise RunLost("run_lost", "the bridge did not give the stick over")

    @contextmanager
    def hold(
        self,
        track: DriveTrack | None = None,
        odometry: list[Odometry] | None = None,
        stands_s: float = 0.0,
    ) -> Iterator[None]:
        """Hold the stick for one run, keeping what is heard; the robot stands when it ends.

        Raises:
            CalibrationRefusal, RunLost: the bridge does not give it.
        """
        self.track, self.odometry = track, odometry
        try:
            self._for(stands_s)
            self.take()
            yield
        finally:
            self.let_go()
            self.track = self.odometry = None

    def is_driving(self) -> bool:
        """Tell whether this hand moves the robot."""
        return self._is_mode({Mode.TELEOP})

    def steer(
        self, v_mps: float, w_radps: float, until: Callable[[], bool], limit_s: float
    ) -> None:
        """Ask for a velocity until something is true.

        Raises:
            CalibrationRefusal, RunLost: the bridge or the way stopped it, or it took too long.
        """
        self._wish = (v_mps, w_radps, True)
        end_s = self.now_s + limit_s
        next_s, angles = self.now_s + 2 * TURNS_S, self._angles()
        while not until():
            self.pump()
            self.look_out()
            if self.now_s >= end_s:
                self._raise_why()
                raise RunLost("run_lost", f"not done within {limit_s:.0f} s")
            if self.now_s >= next_s:
                seen = self._angles()
                if self._is_stopped():
                    self._raise_why()
                elif not max(abs(seen[0] - angles[0]), abs(seen[1] - angles[1])) >= TURNS_RAD:
                    raise RunLost("encoder_fault", f"the wheels' angles stay at {seen}")
                next_s, angles = self.now_s + TURNS_S, seen

    def _is_stopped(self) -> bool:
        """Tell whether the bridge lets the robot stand: a gate, a row."""
        sent = self.status.sent if self.status is not None else None
        return sent is None or (
            abs(sent.v_mps) < STANDING_MPS and abs(sent.w_radps) < STANDING_RADPS
        )

    def _angles(self) -> tuple[float, float]:
        state = self.state
        if state is None:  # a drive in the bridge itself says nothing here; its odometry moves
            return (self._odom.yaw_rad if self._odom is not None else 0.0), self.way_m
        return state.left_rad, state.right_rad

    def let_go(self) -> None:
        """Release the dead-man and wait until the robot stands. Never raises for the robot."""
        self._wish = (0.0, 0.0, False)
        self._until(lambda: not self.is_driving() and self.stands(), STAND_S)
        self._for(STANDS_S)
        self._wish = None

    def settle(self, patience_s: float) -> bool:
        """Wait for the drive's rows to clear, then for a person to arm; tell whether one did.

        A stop that was pressed is the end of it.
        """
        self._until(self._quiet, QUIET_S)
        self._until(lambda: self._is_mode({Mode.HOLD, Mode.ESTOPPED}), patience_s)
        return self._is_mode({Mode.HOLD})

    def _is_mode(self, modes: set[Mode]) -> bool:
        return self.status is not None and self.status.mode in modes

    def _quiet(self) -> bool:
        status = self.status
        return status is not None and not any(_ails(row) for row in status.rows)

    def stands(self) -> bool:
        """Tell whether the wheels stand, as far as the bridge measures."""
        measured = self.status.measured if self.status is not None else None
        return (
            measured is not None
            and abs(measured.v_mps) < STANDING_MPS
            and abs(measured.w_radps) < STANDING_RADPS
        )

    def look(self) -> WallLook:
        """Stand and look: scans and truth that are new."""
        self.scans.clear()
        self._until(lambda: len(self.scans) == SCANS, FIRST_S)
        if len(self.scans) < SCANS:
            raise CalibrationRefusal("no_lidar", "no scans arrive")
        return WallLook(self.truth, tuple(self.scans))

    # Trouble --------------------------------------------------------------------------------------

    def look_out(self) -> None:
        """See whether this hand still has the robot.

        Raises:
            CalibrationRefusal, RunLost: it has not.
        """
        if self.now_s - self._heard_s > SILENT_S:
            raise CalibrationRefusal("no_bridge", "the bridge fell silent during a run")
        if not self.is_driving():
            self._raise_why()

    def _raise_why(self) -> None:
        status = self.status
        if status is None:
            raise CalibrationRefusal("no_bridge")
        if status.mode is Mode.ESTOPPED:
            raise CalibrationRefusal("estopped")
        rows = {row.row: row.evidence for row in status.rows}
        for row in status.rows:
            if _ails(row):
                raise RunLost("encoder_fault", f"{row.row}: {row.evidence}")
        if status.mode is Mode.FAULT:
            raise CalibrationRefusal("fault", ", ".join(rows))
        if status.mode is Mode.DISARMED:
            raise CalibrationRefusal("not_armed", "disarmed during a run")
        if status.blocked or (status.limits.by in WAY_GATES and self._is_stopped()):
            raise RunLost("blocked", f"by {status.limits.by}")
        if not self.is_driving():
            why = ", ".join(f"{name}: {seen}" for name, seen in rows.items()) or status.mode.value
            raise RunLost("run_lost", why)

    def _until(self, done: Callable[[], bool], limit_s: float) -> None:
        end_s = self.now_s + limit_s
        while not done() and self.now_s < end_s:
            self.pump()

    def _for(self, seconds: float) -> None:
        self._until(lambda: False, seconds)


def _ails(row: RowReport) -> bool:
    """Tell whether a row says that the drive ails."""
    return row.row in DRIVE_ROWS and row.evidence != NO_GYRO
