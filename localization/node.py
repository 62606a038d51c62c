"""Run localization as a process: hear the wire, let the core think, publish at a steady rate.

Two nodes of one shape: the localizer's hears scans and odometry, the stand-in's the simulator's
truth in place of scans. What is said, and when there is silence, is the core's business.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Protocol

from localization.localizer_status import make_status
from wire import Odometry, PoseHint, SimTruth, keys

if TYPE_CHECKING:
    from collections.abc import Callable

    from localization.global_search import Candidate
    from localization.localizer import Localizer
    from localization.relocation import SearchRequest
    from localization.standin import StandIn
    from wire import LocalizerTrouble
    from wire.session import Session

PERIOD_S = 0.05
STATE_S = 0.2
"""Between two words on what the localizer does, where nothing changed."""


def run_periodically(turn: Callable[[float], None], stopped: Callable[[], bool]) -> None:
    """Call ``turn`` with the time at each deadline until told to stop; missed ones are skipped."""
    next_s = time.monotonic() + PERIOD_S
    while not stopped():
        time.sleep(max(0.0, next_s - time.monotonic()))
        now_s = time.monotonic()
        next_s = max(next_s + PERIOD_S, now_s)
        turn(now_s)


class SearchPort(Protocol):
    """Search a map beside the loop: in a process of its own, or in a test's time."""

    def ask(self, request: SearchRequest) -> None:
        """Send a request; its answer comes by :meth:`answers`, or never."""

    def answers(self) -> list[tuple[int, tuple[Candidate, ...]]]:
        """Return what was answered since the last call: request number and candidates."""

    @property
    def trouble(self) -> LocalizerTrouble | None:
        """Return why the newest request was not answered; None where it was, or is open."""


class LocalizerNode:
    """Connect a localizer and its search to the wire."""

    def __init__(
        self, localizer: Localizer, search: SearchPort, session: Session, boot_id: str
    ) -> None:
        self._localizer, self._search, self._boot_id = localizer, search, boot_id
        self._hint = session.subscriber(keys.LOC_HINT)
        self._state = session.publisher(keys.LOC_STATE)
        self._said: tuple[object, ...] = ()
        self._said_s = float("-inf")
        self._seq = 0
        self._scan = session.subscriber(keys.SCAN)
        self._odom = session.subscriber(keys.ODOM)
        self._out = session.publisher(keys.LOCALIZATION)

    def turn(self, now_s: float) -> None:
        """Take what came, use a scan, say where ``odom`` is."""
        for odometry in self._odom.drain().items:
            if isinstance(odometry, Odometry):
                self._localizer.hear_odometry(odometry)
        scan = self._scan.newest()
        if scan is not None:
            self._localizer.hear_scan(scan)
        for hint in self._hint.drain().items:
            if isinstance(hint, PoseHint):
                self._localizer.hear_hint(hint)
        for number, candidates in self._search.answers():
            self._localizer.hear_candidates(number, candidates)
        self._localizer.work(now_s)
        request = self._localizer.search_request()
        if request is not None:
            self._search.ask(request)
        answer = self._localizer.answer(now_s)
        if answer is not None:
            self._out.put(answer)
        self._say_state(now_s)

    def _say_state(self, now_s: float) -> None:
        one = self._localizer
        state, score = one.report_state(now_s)
        trouble = self._search.trouble
        news = (state, one.hint_answer, trouble)
        if news != self._said or now_s - self._said_s >= STATE_S:
            self._said, self._said_s = news, now_s
            self._seq += 1
            stamp, found = (self._boot_id, self._seq, now_s), one.candidates
            told = make_status(state.value, score, found, one.hint_answer, stamp, trouble)
            self._state.put(told)


class StandInNode:
    """Connect one stand-in to the wire."""

    def __init__(self, stand_in: StandIn, session: Session) -> None:
        self._stand_in = stand_in
        self._truth = session.subscriber(keys.SIM_TRUTH)
        self._odom = session.subscriber(keys.ODOM)
        self._out = session.publisher(keys.LOCALIZATION)

    def turn(self, now_s: float) -> None:
        """Hear both sources and say where ``odom`` is."""
        for truth in self._truth.drain().items:
            if isinstance(truth, SimTruth):
                self._stand_in.hear_truth(truth)
        for odometry in self._odom.drain().items:
            if isinstance(odometry, Odometry):
                self._stand_in.hear_odometry(odometry)
        answer = self._stand_in.answer(now_s)
        if answer is not None:
            self._out.put(answer)
