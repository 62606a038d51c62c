"""Run the localization stand-in as a process: read truth and odometry, publish at a steady rate.

Knows the session and the clock. What it says, and when it keeps silent, is standin.py's business.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from wire import Odometry, SimTruth, keys

if TYPE_CHECKING:
    from collections.abc import Callable

    from localization.standin import StandIn
    from wire.session import Session

PERIOD_S = 0.05


class LocalizationNode:
    """Connect one stand-in to the wire."""

    def __init__(self, stand_in: StandIn, session: Session) -> None:
        self._stand_in = stand_in
        self._truth = session.subscriber(keys.SIM_TRUTH)
        self._odom = session.subscriber(keys.ODOM)
        self._out = session.publisher(keys.LOCALIZATION)

    def run(self, stopped: Callable[[], bool]) -> None:
        """Answer at each deadline until told to stop; missed deadlines are skipped."""
        next_s = time.monotonic() + PERIOD_S
        while not stopped():
            time.sleep(max(0.0, next_s - time.monotonic()))
            now_s = time.monotonic()
            next_s = max(next_s + PERIOD_S, now_s)
            self._turn(now_s)

    def _turn(self, now_s: float) -> None:
        for truth in self._truth.drain().items:
            if isinstance(truth, SimTruth):
                self._stand_in.hear_truth(truth)
        for odometry in self._odom.drain().items:
            if isinstance(odometry, Odometry):
                self._stand_in.hear_odometry(odometry)
        answer = self._stand_in.answer(now_s)
        if answer is not None:
            self._out.put(answer)
