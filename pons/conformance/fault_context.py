"""Give a fault its means: the brain, the bridge, helpers, and the moments that count."""

from __future__ import annotations

import json
import time
from contextlib import ExitStack
from dataclasses import dataclass, field
from random import Random
from typing import TYPE_CHECKING

from pons.conformance.driver import mute, plain
from pons.conformance.record import between
from pons.conformance.verdict import CREEP_RADPS
from pons.conformance.worker_processes import PUPPET, HelperLost

if TYPE_CHECKING:
    from collections.abc import Callable

    from pons.conformance.adapter import Adapter
    from pons.conformance.driver import BrainDriver, Breaker
    from pons.conformance.reference_client import ReferenceBrain
    from pons.conformance.worker_processes import Helper, HelperPool
    from wire import Status

POLL_S = 0.005
STOOD_S = 0.2
"""Watched on for so long, once it stands."""
LIMIT_S = 5.0
WATCH_S = 0.8
GONE_S = 0.4
"""What a brain that fell silent has said is stale by then."""
MOVING_MPS, FAST_MPS = 0.15, 0.33


class NotBegun(Exception):
    """The good brain could not be brought to where the fault begins."""


@dataclass
class FaultContext:
    """Hold one play of one fault."""

    adapter: Adapter
    driver: BrainDriver
    helpers: HelperPool
    chance: Random
    patience_s: float
    """How long to wait for it to stand before that is called a failure."""
    stack: ExitStack = field(default_factory=ExitStack)
    from_s: float | None = None
    to_s: float | None = None

    @property
    def brain(self) -> ReferenceBrain:
        """Return the brain that is to go wrong."""
        return self.driver.brain

    @property
    def external(self) -> bool:
        """Tell whether it drives by velocity."""
        return self.brain.kind == "external"

    @property
    def command_key(self) -> str:
        """Return the key on which it drives."""
        return "cmd/external" if self.external else "cmd/waypoints"

    @property
    def status(self) -> Status:
        """Return the bridge's newest word. Raises NotBegun where there is none."""
        status = self.adapter.status()
        if status is None:
            raise NotBegun("the bridge says nothing")
        return status

    # Moments ------------------------------------------------------------------------------------

    def begin(self, breaker: Breaker | None = None) -> None:
        """From here on it is wrong."""
        self.from_s = time.monotonic()
        if breaker is not None:
            self.driver.breaker = breaker

    def end(self) -> None:
        """Up to here it was wrong."""
        self.to_s = time.monotonic()

    def wait(self, seconds: float = WATCH_S) -> None:
        """Let time pass."""
        time.sleep(seconds)

    def until_standing(self) -> None:
        """Wait until the wheels have been told to stand for a while, or patience ends."""
        end_s = time.monotonic() + self.patience_s
        while time.monotonic() < end_s and not self.told_to_stand(STOOD_S):
            time.sleep(POLL_S)

    def until(self, done: Callable[[], bool], what: str, limit_s: float = LIMIT_S) -> None:
        """Wait for something before the fault. Raises NotBegun."""
        end_s = time.monotonic() + limit_s
        while not done():
            if time.monotonic() > end_s:
                raise NotBegun(f"{what}: not within {limit_s:.0f} s; {self.describe()}")
            time.sleep(POLL_S)

    # What is seen -------------------------------------------------------------------------------

    def told_to_stand(self, for_s: float) -> bool:
        """Tell whether every command of a while was zero."""
        now_s = time.monotonic()
        if self.from_s is not None and now_s - self.from_s < for_s:
            return False
        newest = between(self.adapter.record.commands, now_s - for_s)
        return bool(newest) and all(
            max(abs(one.left_radps), abs(one.right_radps)) <= CREEP_RADPS or not one.enabled
            for one in newest
        )

    def moves(self) -> bool:
        """Tell whether the robot drives, and the bridge says so."""
        words, truths = self.adapter.record.words, self.adapter.record.truths
        moving = bool(truths) and abs(truths[-1].v_mps) > MOVING_MPS
        return moving and bool(words) and words[-1].moves

    def drives_fast(self) -> bool:
        """Tell whether it drives about as fast as it does."""
        return self.moves() and abs(self.adapter.record.truths[-1].v_mps) > FAST_MPS

    def describe(self) -> str:
        """Describe the bridge's status."""
        status = self.adapter.status()
        if status is None:
            return "the bridge says nothing"
        rows = ", ".join(row.row for row in status.rows) or "-"
        owner = status.owner.planner_id if status.owner else "nobody"
        held = status.held.reason if status.held else "not held"
        return f"{status.mode}, {held}, owner {owner}, rows {rows}"

    # Other processes ----------------------------------------------------------------------------

    def borrow(self) -> Helper:
        """Return a loaded helper that ends with this play. Raises NotBegun."""
        try:
            helper = self.helpers.take()
        except HelperLost as lost:
            raise NotBegun(str(lost)) from None
        self.stack.callback(helper.end)
        return helper

    def hand_over(self, through: str | None = None) -> Helper:
        """Let a brain of the same name, in a process of its own, drive on in place of ours."""
        brain, puppet = self.brain, self.borrow()
        self.driver.breaker = mute
        puppet.go({
            "be": PUPPET, "through": through, "kind": brain.kind, "brain_id": brain.brain_id,
            "mission": brain.mission, "missions": brain.missions, "leg": brain.leg,
            "heading": brain.heading, "start": brain.track.start, "end": brain.track.end,
        })  # fmt: skip
        time.sleep(GONE_S)
        self.until(self.drives_fast, "the handed-over brain drives")
        return puppet

    def rest(self, stop_id: str | None = None) -> None:
        """Bring the robot to stand under a live owner without a grant, armed and not held."""
        self.brain.asks = False
        self.driver.breaker = plain
        self.stop(stop_id or self.new_id())
        self.until(lambda: self.told_to_stand(0.1), "standing after a stop")
        self.until(self._has_resumed, "resume")

    def new_id(self) -> str:
        """Return an id that nobody has used."""
        return f"kit-{self.chance.getrandbits(48):x}"

    def stop(self, stop_id: str) -> None:
        """Say stop once."""
        self.adapter.say("cmd/stop", json.dumps({"id": stop_id, "source": "kit"}).encode())

    def _has_resumed(self) -> bool:
        status = self.status
        if status.held is not None:
            self.adapter.operate("resume")
            time.sleep(0.1)
            return False
        mine = status.owner is not None and status.owner.planner_id == self.brain.brain_id
        return mine and status.grant is None and status.mode == "HOLD"
