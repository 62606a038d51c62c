"""Watch one robot from outside: truth, the bridge's words, and what is said aloud.

Two threads keep what comes with the moment of receipt on this process's clock: one drains a judge's
session, one listens to the planner's event stream as a page does, again and again.
"""

from __future__ import annotations

import json
import threading
import time
from collections import deque
from contextlib import suppress
from typing import TYPE_CHECKING

from websockets.exceptions import WebSocketException
from websockets.sync.client import connect

from sim import PERIODS
from tools.bench.chaos.verdict import TruthSample
from wire import SimTruth, Status, load_robot
from wire.keys import SIM_TRUTH, STATUS, Party
from wire.session import open_session

if TYPE_CHECKING:
    from types import TracebackType
    from typing import Self

    from pons.settings import LaunchSettings

KEEP = 20_000
PERIOD_S = 0.01
FRESH_S = 0.5
AGAIN_S = 0.05
STANDING_FOR_S = 0.2
BridgeState = tuple[float, str, tuple[str, ...]]
"""From when on the bridge said so, its mode, and the rows in force."""


class Witness:
    """Hear one robot."""

    def __init__(self, settings: LaunchSettings) -> None:
        """Describe it; entering the context begins to listen."""
        self._settings = settings
        self._ending = threading.Event()
        self._truths: deque[TruthSample] = deque(maxlen=KEEP)
        self._said: deque[tuple[float, str, str]] = deque(maxlen=1000)
        self._states: deque[BridgeState] = deque(maxlen=KEEP)
        self.listening = threading.Event()
        """Set while the planner's events are heard."""
        self.status: Status | None = None
        self.status_s = float("-inf")

    def __enter__(self) -> Self:
        robot_id = load_robot(self._settings.robot).id
        self._session = open_session(Party.JUDGE, robot_id, self._settings.home)
        self._statuses = self._session.subscriber(STATUS)
        self._ears = self._session.subscriber(SIM_TRUTH)
        self._threads = [threading.Thread(target=run) for run in (self._watch, self._listen)]
        for thread in self._threads:
            thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._ending.set()
        for thread in self._threads:
            thread.join()
        self._session.close()

    def _watch(self) -> None:
        while not self._ending.wait(PERIOD_S):
            now_s = time.monotonic()
            if isinstance(status := self._statuses.newest(), Status):
                self.status, self.status_s = status, now_s
                state = (status.mode.value, tuple(row.row for row in status.rows))
                if not self._states or self._states[-1][1:] != state:
                    self._states.append((now_s, *state))
            self._truths.extend(
                _sample(now_s, truth)
                for truth in self._ears.drain().items
                if isinstance(truth, SimTruth)
            )

    def _listen(self) -> None:
        settings = self._settings
        url = f"ws://{settings.host}:{settings.port}/v1/events"
        while not self._ending.wait(AGAIN_S):
            with (
                suppress(OSError, WebSocketException, ValueError),
                connect(url, open_timeout=2.0, close_timeout=0.5, max_size=None) as socket,
            ):
                socket.recv(2.0)  # where everything stands
                self.listening.set()
                while not self._ending.is_set():
                    with suppress(TimeoutError):
                        self._hear(str(socket.recv(0.25)))
            self.listening.clear()

    def _hear(self, text: str) -> None:
        if '"say"' not in text[:200]:
            return
        change = json.loads(text).get("change", {})
        if change.get("type") == "say":
            self._said.append((time.monotonic(), str(change["goal"]), str(change["text"])))

    # What was heard -----------------------------------------------------------------------------

    def trace(self, from_s: float) -> list[TruthSample]:
        """Return the truth since a moment."""
        return [sample for sample in tuple(self._truths) if sample.at_s >= from_s]

    def states(self, from_s: float) -> list[BridgeState]:
        """Return the bridge's states since a moment, and the one that it was in then."""
        states = list(self._states)
        first = max((n for n, state in enumerate(states) if state[0] <= from_s), default=0)
        return states[first:]

    def sayings_since(self, from_s: float) -> list[tuple[str, str]]:
        """Return goal and words of all that was said since a moment."""
        return [(goal, words) for at_s, goal, words in tuple(self._said) if at_s >= from_s]

    def live_status(self) -> Status | None:
        """Return the bridge's newest word while both bridge and simulator speak."""
        now_s = time.monotonic()
        truth_s = self._truths[-1].at_s if self._truths else float("-inf")
        fresh = now_s - self.status_s < FRESH_S and now_s - truth_s < FRESH_S
        return self.status if fresh else None

    def stands(self) -> bool:
        """Tell whether the robot truly stands, and has for a moment."""
        newest = self.trace(time.monotonic() - STANDING_FOR_S)
        return bool(newest) and all(sample.stands for sample in newest)

    def describe(self) -> str:
        """Say in a line what the bridge said last, and how long ago."""
        status = self.status
        if status is None:
            return "the bridge said nothing"
        age_s = time.monotonic() - self.status_s
        rows = ", ".join(f"{row.row} {row.action}" for row in status.rows)
        held = status.held.reason if status.held else None
        owner = status.owner.planner_id if status.owner else None
        lacks = ", ".join(status.waiting_for)
        return (
            f"{status.mode.value} {age_s:.1f} s ago, held {held}, owner {owner}, "
            f"rows {rows or '-'}, lacks {lacks or '-'}, blocked {status.blocked}"
        )


def _sample(now_s: float, truth: SimTruth) -> TruthSample:
    return TruthSample(
        at_s=now_s,
        boot=truth.boot_id,
        world_s=truth.seq * PERIODS.truth_ticks * PERIODS.tick_s,
        x_m=truth.base_in_map.x_m,
        y_m=truth.base_in_map.y_m,
        v_mps=truth.twist.v_mps,
        w_radps=truth.twist.w_radps,
        contacts=truth.contacts_total,
    )
