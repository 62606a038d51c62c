"""Judge what was seen and heard of an episode. Pure: told a trace, answers with counts.

A moment is one of this process's monotonic clock. How long a robot takes to stand is counted in the
simulator's own time, which stands while the simulator is frozen, as the simulated robot does.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import hypot

STANDS_MPS, STANDS_RADPS, STANDS_FOR_S = 0.02, 0.05, 0.1
"""Bodies rock as they come to rest."""
MOVES_MPS, MOVES_RADPS = 0.05, 0.15
CREPT_M = 0.03
STOP_S = 1.5
"""0.5 m/s at 1 m/s2 and the drive's lag make 0.6 s; a bridge that dies meanwhile leaves the drive
0.2 s to notice. The rest is for the moment between the bridge's word and our clock."""


@dataclass(frozen=True, slots=True)
class TruthSample:
    """Hold where the robot truly was, and how fast, at one instant."""

    at_s: float
    """When it was heard."""
    boot: str
    world_s: float
    """Simulated time since that boot."""
    x_m: float
    y_m: float
    v_mps: float
    w_radps: float
    contacts: int
    """Since that boot."""

    @property
    def stands(self) -> bool:
        """Tell whether it stood."""
        return abs(self.v_mps) < STANDS_MPS and abs(self.w_radps) < STANDS_RADPS

    @property
    def moves(self) -> bool:
        """Tell whether it moved beyond any rocking."""
        return not (abs(self.v_mps) < MOVES_MPS and abs(self.w_radps) < MOVES_RADPS)


@dataclass(frozen=True, slots=True)
class StopVerdict:
    """Tell what became of the motion after a confirmed stop."""

    moving: bool
    """It moved when the stop was confirmed: else nothing was there to be stopped."""
    stood_s: float | None
    """Simulated seconds until it stood; None where it did not within the trace."""
    late: bool
    again: str
    """What it did after it had stood; empty where it stayed."""

    @property
    def is_broken(self) -> bool:
        """Tell whether the stop did not hold."""
        return self.late or bool(self.again)


def judge_stop(trace: Sequence[TruthSample], confirmed_s: float, acts_s: float) -> StopVerdict:
    """Judge the span from a stop's confirmation to the first act of a person.

    A simulator that began anew in it has put the robot elsewhere: it must not move there at all.
    """
    span = [sample for sample in trace if confirmed_s <= sample.at_s < acts_s]
    boots = list(dict.fromkeys(sample.boot for sample in span))
    if not span:
        return StopVerdict(False, 0.0, False, "")
    lives = [[sample for sample in span if sample.boot == boot] for boot in boots]
    moving, stood = span[0].moves, _first_stand(lives[0])
    if stood is None:
        driven_s = lives[0][-1].world_s - lives[0][0].world_s
        late, stood_s, after = driven_s > STOP_S, None, []
    else:
        stood_s = stood.world_s - lives[0][0].world_s
        late, after = stood_s > STOP_S, [s for s in lives[0] if s.world_s >= stood.world_s]
    again = next((told for life in (after, *lives[1:]) if (told := _motion_line(life))), "")
    return StopVerdict(moving, stood_s, late, again)


def _first_stand(life: Sequence[TruthSample]) -> TruthSample | None:
    """Return the first instant from which it stood for a moment."""
    since: TruthSample | None = None
    for sample in life:
        if not sample.stands:
            since = None
        elif since is None:
            since = sample
        if since is not None and sample.world_s - since.world_s >= STANDS_FOR_S:
            return since
    return since


def _motion_line(life: Sequence[TruthSample]) -> str:
    """Say how a robot that was to stand moved; empty where it did not."""
    if not life:
        return ""
    first = life[0]
    for sample in life:
        after_s = f"{sample.at_s - first.at_s:.2f} s after it stood"
        if sample.moves:
            return f"{sample.v_mps:.2f} m/s, {sample.w_radps:.2f} rad/s, {after_s}"
        if (crept_m := hypot(sample.x_m - first.x_m, sample.y_m - first.y_m)) > CREPT_M:
            return f"crept {crept_m:.3f} m, {after_s}"
    return ""


def contacts(trace: Iterable[TruthSample]) -> int:
    """Count the contacts that began within a trace; a new simulator counts from zero."""
    count, last = 0, dict[str, int]()
    for sample in trace:
        known = last.get(sample.boot)
        if known is None and last:
            known = 0
        count += max(0, sample.contacts - (sample.contacts if known is None else known))
        last[sample.boot] = sample.contacts
    return count


def has_moved(trace: Iterable[TruthSample]) -> bool:
    """Tell whether the robot truly moved at all."""
    return any(sample.moves for sample in trace)


def said_twice(heard: Iterable[tuple[str, str]], sentences: Iterable[str]) -> list[str]:
    """Return the sentences that a goal said more than once.

    Args:
        heard: the goal and the words of each time that something was said.
        sentences: those that were to be said once.
    """
    times = Counter(heard)
    once = set(sentences)
    return sorted({words for (_, words), count in times.items() if count > 1 and words in once})
