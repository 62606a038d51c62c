"""Watch a running robot from outside: what the bridge says and where the simulator really has it.

Owns one wire session as JUDGE and a thread that drains it; every message is kept with the moment
of its receipt on this process's monotonic clock. Knows no planner and no goal.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from itertools import pairwise
from math import hypot
from pathlib import Path
from types import TracebackType
from typing import Generic, Self, TypeVar

from tests.contact import SEEN
from tests.e2e.polling import until
from wire import DriveState, Event, Mode, SimTruth, Status
from wire.keys import DRIVE_STATE, EVENT, SIM_TRUTH, STATUS, Party
from wire.session import Session, Subscriber, open_session

KEEP = 60_000
PERIOD_S = 0.008
STANDING_MPS = 0.02
STANDING_RADPS = 0.05
STANDING_FOR_S = 0.1
"""Bodies rock as they come to rest."""

M = TypeVar("M", Status, SimTruth, DriveState, Event)


def still(truth: SimTruth) -> bool:
    """Tell whether the robot stood at one instant."""
    return abs(truth.twist.v_mps) < STANDING_MPS and abs(truth.twist.w_radps) < STANDING_RADPS


class Log(Generic[M]):
    """Keep what one key said, with the moment of receipt."""

    def __init__(self, ears: Subscriber[M], kind: type[M]) -> None:
        self._ears: Subscriber[M] = ears
        self._kind: type[M] = kind
        self._kept: deque[tuple[float, M]] = deque(maxlen=KEEP)

    def drain(self, now_s: float) -> None:
        """Take what has come."""
        self._kept.extend(
            (now_s, item) for item in self._ears.drain().items if isinstance(item, self._kind)
        )

    def since(self, from_s: float, to_s: float = float("inf")) -> list[tuple[float, M]]:
        """Return what came in a span of our monotonic clock."""
        return [entry for entry in tuple(self._kept) if from_s <= entry[0] <= to_s]

    @property
    def last(self) -> M:
        """Return the newest; waits for a first one."""
        until(lambda: len(self._kept) > 0, 10.0, f"a {self._kind.__name__}")
        return self._kept[-1][1]

    @property
    def last_s(self) -> float:
        """Return when the newest came; minus infinity before the first."""
        return self._kept[-1][0] if self._kept else float("-inf")


class Judge:
    """Keep the robot's own story and the truth beside it."""

    def __init__(self, home: Path, robot_id: str = "r1") -> None:
        self.session: Session = open_session(Party.JUDGE, robot_id, home)
        self.statuses = Log(self.session.subscriber(STATUS), Status)
        self.truths = Log(self.session.subscriber(SIM_TRUTH), SimTruth)
        self.drives = Log(self.session.subscriber(DRIVE_STATE), DriveState)
        self.events = Log(self.session.subscriber(EVENT), Event)
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._watch, daemon=True)
        self._thread.start()

    def _watch(self) -> None:
        while not self._ending.wait(PERIOD_S):
            now_s = time.monotonic()
            for log in (self.statuses, self.truths, self.drives, self.events):
                log.drain(now_s)

    def close(self) -> None:
        """End the thread, then the session."""
        self._ending.set()
        self._thread.join()
        self.session.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    # The moment ---------------------------------------------------------------------------------

    @property
    def status(self) -> Status:
        """Return the bridge's newest word."""
        return self.statuses.last

    @property
    def truth(self) -> SimTruth:
        """Return where the robot really is."""
        return self.truths.last

    def standing(self) -> bool:
        """Tell whether the robot really stands, and has for a moment."""
        self.truths.last  # noqa: B018  # waits for a first one
        newest = self.truths.since(self.truths.last_s - STANDING_FOR_S)
        return all(still(truth) for _, truth in newest)

    def until_mode(self, *modes: Mode, limit_s: float = 15.0) -> Status:
        """Wait until the bridge is in one of the modes."""
        return until(
            lambda: self.status if self.status.mode in modes else None,
            limit_s,
            f"mode {'/'.join(modes)}",
            self.describe,
        )

    def until_moving(self, speed_mps: float = 0.15, limit_s: float = 10.0) -> float:
        """Wait until the robot really drives in ACTIVE; return that moment."""
        until(
            lambda: self.status.mode is Mode.ACTIVE and self.truth.twist.v_mps > speed_mps,
            limit_s,
            f"driving faster than {speed_mps} m/s",
            self.describe,
        )
        return time.monotonic()

    def until_standing(self, limit_s: float) -> float:
        """Wait until the robot really stands; return that moment."""
        until(self.standing, limit_s, "standing", self.describe)
        return time.monotonic()

    def describe(self) -> str:
        """Say where things are, for a failed test."""
        status, truth = self.status, self.truth
        pose, codes = truth.base_in_map, [e.code for _, e in self.events.since(0.0)][-8:]
        rows = [f"{row.row} {row.action} {row.evidence}" for row in status.rows]
        return (
            f"mode {status.mode} held {status.held} epoch {status.epoch} owner {status.owner} "
            f"waiting {status.waiting_for} rows {rows} leg {status.leg} truth ({pose.x_m:.2f}, "
            f"{pose.y_m:.2f}) v {truth.twist.v_mps:.3f} w {truth.twist.w_radps:.3f}; events {codes}"
        )

    # A span -------------------------------------------------------------------------------------

    def path_m(self, from_s: float, to_s: float = float("inf")) -> float:
        """Return how far the robot really drove in a span."""
        poses = [truth.base_in_map for _, truth in self.truths.since(from_s, to_s)]
        return sum(hypot(b.x_m - a.x_m, b.y_m - a.y_m) for a, b in pairwise(poses))

    def assert_stood(self, from_s: float, to_s: float | None = None) -> None:
        """Hold that neither wheels nor robot moved in a span."""
        end_s = time.monotonic() if to_s is None else to_s
        truths = self.truths.since(from_s, end_s)
        assert truths, f"no truth was heard in {end_s - from_s:.2f} s"
        fast = [
            (f"{at_s - from_s:+.2f} s", truth.twist) for at_s, truth in truths if not still(truth)
        ]
        assert not fast, f"moved: {fast[:5]}; {self.describe()}"
        first, last = truths[0][1].base_in_map, truths[-1][1].base_in_map
        crept_m = hypot(last.x_m - first.x_m, last.y_m - first.y_m)
        assert crept_m < STANDING_MPS, f"crept {crept_m:.3f} m"

    def assert_never_moves(self, seconds: float) -> None:
        """Watch for so long and hold that nothing moved."""
        began_s = time.monotonic()
        until(lambda: time.monotonic() - began_s >= seconds, seconds + 1.0, "time passing")
        self.assert_stood(began_s)

    def assert_no_contact(self) -> None:
        """Hold that the robot touched nothing since the simulator started."""
        touched = self.truth.contacts_total
        assert touched == 0, f"{SEEN}: {touched}; {self.describe()}"
