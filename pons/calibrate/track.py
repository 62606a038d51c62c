"""Keep what was said during one run, and line it up by tick. Knows messages; no sessions, no clock.

The drive's own numbering is the time base: a state's ``seq`` counts its ticks, and its ``echo_seq``
names the very command that it worked under. So neither this process's delays nor a host that
stalls bend what is measured.
"""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass, field
from math import pi
from typing import TYPE_CHECKING

from pons.calibrate.errors import RunLost
from wire import wrap

if TYPE_CHECKING:
    from wire import DriveCommand, DriveState, SimTruth

TICK_S = 0.01
"""Drive states and commands come at 100 Hz."""
MOST_MISSING = 8
"""Ticks in a row; across more, what was told in between is a guess."""


@dataclass(frozen=True, slots=True)
class TrackTick:
    """Give one drive tick of both wheels: commanded and, where heard, real speeds."""

    seq: int
    told: tuple[float, float]
    did: tuple[float, float] | None


@dataclass
class DriveTrack:
    """Hold one run."""

    states: list[DriveState] = field(default_factory=list)
    told: dict[int, DriveCommand] = field(default_factory=dict)
    behind: list[int] = field(default_factory=list)
    """How many commands the newest state was behind the newest command, each time one came."""
    marks: dict[str, int] = field(default_factory=dict)
    """Drive ticks at which something was begun."""
    truth: SimTruth | None = None
    true_turn_rad: float = 0.0
    """What the truth has turned since the run began, counted through."""

    def hear_state(self, state: DriveState) -> None:
        """Take one drive state."""
        if not self.states or state.seq > self.states[-1].seq:
            self.states.append(state)

    def hear_truth(self, truth: SimTruth) -> None:
        """Take one word of truth."""
        if self.truth is not None:
            self.true_turn_rad += wrap(truth.base_in_map.yaw_rad - self.truth.base_in_map.yaw_rad)
        self.truth = truth

    def mark(self, name: str) -> None:
        """Remember that something begins now."""
        self.marks[name] = self.states[-1].seq if self.states else 0

    def turned_rad(self) -> tuple[float, float]:
        """Return how far each wheel turned in the run."""
        first, last = self.states[0], self.states[-1]
        return last.left_rad - first.left_rad, last.right_rad - first.right_rad

    def ticks(self) -> list[TrackTick]:
        """Return every tick from the first state to the last.

        Raises:
            RunLost: too much was not heard, or another drive speaks.
        """
        if len(self.states) < 2 or not self.told:
            raise RunLost("run_lost", "no drive states or commands were heard")
        if self.states[0].boot_id != self.states[-1].boot_id:
            raise RunLost("encoder_fault", "the drive started anew")
        known = sorted(self.told)
        ticks: list[TrackTick] = []
        before: DriveState | None = None
        for state in self.states:
            ticks += self._fill_gap(before, state, known)
            did = (state.left_radps, state.right_radps)
            ticks.append(TrackTick(state.seq, self._told_at(state.echo_seq, known), did))
            before = state
        return ticks

    def _fill_gap(
        self, before: DriveState | None, state: DriveState, known: list[int]
    ) -> list[TrackTick]:
        """Fill ticks whose states were not heard; commands in between are known all the same."""
        if before is None:
            return []
        gap = state.seq - before.seq
        if gap - 1 > MOST_MISSING:
            raise RunLost("run_lost", f"{gap - 1} drive states in a row were not heard")
        share = (state.echo_seq - before.echo_seq) / gap
        return [
            TrackTick(
                before.seq + n, self._told_at(before.echo_seq + round(n * share), known), None
            )
            for n in range(1, gap)
        ]

    def _told_at(self, seq: int, known: list[int]) -> tuple[float, float]:
        """Return a command's speeds; between two that were heard, interpolate."""
        at = bisect_left(known, seq)
        low, high = known[max(0, at - 1)], known[min(at, len(known) - 1)]
        if high == seq or low >= high:
            return self.told[high].left_radps, self.told[high].right_radps
        share = min(1.0, (seq - low) / (high - low))
        a, b = self.told[low], self.told[high]
        return (
            a.left_radps + share * (b.left_radps - a.left_radps),
            a.right_radps + share * (b.right_radps - a.right_radps),
        )


def unwound(turn_rad: float, near_rad: float) -> float:
    """Return the turn that differs by whole turns and lies nearest to the wheels' figure."""
    return turn_rad + 2 * pi * round((near_rad - turn_rad) / (2 * pi))
