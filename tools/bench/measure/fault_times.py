"""Break each thing while the robot drives, in lockstep, and see when the bridge says what.

Ticks from the tick in which it broke to the first new row (or what else ended the drive), and on
to the tick from which the robot truly stands. The core, the link code and the physics are the
shipped ones; time is simulated, so nothing of this machine is in it.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from tools.bench.report import ReportRow, row_of
from tools.lockstep import TICK_S, LockstepWorld
from tools.lockstep.world_fork import fork_world
from wire import Mode, Pose2, SimFault

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "fault_times"
TITLE = "simulated faults: ticks until the bridge acts"
LONG_ONLY = True
SEEDS = 10
START = Pose2(1.2, 0.8, 0.0)
CRUISE_MPS = 0.35
WATCH_S = 8.0


@dataclass(frozen=True, slots=True)
class FaultTrial:
    """Tell what became of one fault."""

    fault: str
    first: str
    """The row that came up first, or what else the bridge said; empty where nothing came."""
    first_ticks: int | None
    stood_ticks: int | None
    """None where the robot drove on for as long as it was watched."""
    contacts: int
    rows: tuple[str, ...]


def trial(
    fault: SimFault, seed: int, watch_s: float = WATCH_S, after_s: float = WATCH_S
) -> FaultTrial:
    """Drive, break it, watch for so long, and no longer than ``after_s`` from the first word on."""
    world = fork_world(_cruising(seed))
    known = set(world.bridge.state.rows)
    world.sim.break_down(fault)
    first, first_ticks, stood_ticks, rows = "", None, None, dict[str, None]()
    for tick in range(1, round(watch_s / TICK_S) + 1):
        world.tick()
        rows |= dict.fromkeys(name for name in world.bridge.state.rows if name not in known)
        if first_ticks is None and (first := _first_notice(world, rows)):
            first_ticks = tick
        if stood_ticks is None and world.standing:
            stood_ticks = tick
        elif stood_ticks is not None and not world.standing:
            stood_ticks = None  # it went on
        if first_ticks is not None and (tick - first_ticks) * TICK_S >= after_s:
            break
    return FaultTrial(fault.value, first, first_ticks, stood_ticks, world.contacts, tuple(rows))


@lru_cache(maxsize=SEEDS)
def _cruising(seed: int) -> LockstepWorld:
    """Drive off; every fault of this seed breaks the same drive."""
    world = LockstepWorld(seed=seed, start=START)
    world.say("go to the living room")
    world.run_until(lambda w: w.status.mode is Mode.ACTIVE and w.twist.v_mps > CRUISE_MPS, 30.0)
    return world


def _first_notice(world: LockstepWorld, rows: dict[str, None]) -> str:
    """Name what the bridge noticed: its first row, or a gate that shut the way."""
    if rows:
        return next(iter(rows))
    state = world.bridge.state
    shut = state.gate.blocked or state.gate.shut_since_s is not None
    return f"gate {state.motion.bound_by}" if shut else ""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Break everything, each with several seeds."""
    rows = []
    for fault in SimFault:
        if fault.value.startswith("camera_"):  # the bridge does not see
            continue
        data = list(
            lab.slices(fault.value, lab.count(3, SEEDS), lambda i, f=fault: asdict(trial(f, i + 1)))  # type: ignore[misc]  # the default binds the loop's fault
        )
        seen = [float(one["first_ticks"]) for one in data if one["first_ticks"] is not None]
        stood = [float(one["stood_ticks"]) for one in data if one["stood_ticks"] is not None]
        what = ", ".join(sorted({one["first"] or "nothing" for one in data}))
        contacts = sum(one["contacts"] for one in data)
        note = f"{what}; seen {len(seen)}, stood {len(stood)} of {len(data)}; contacts {contacts}"
        rows.append(_times(f"{fault.value} -> said", seen, "not told", note))
        rows.append(_times(f"{fault.value} -> stands", stood, "drives on", ""))
    return rows


def _times(what: str, ticks: list[float], otherwise: str, note: str) -> ReportRow:
    if not ticks:
        return ReportRow(what, "ticks", "", value=otherwise, note=note)
    return row_of(what, "ticks", "", ticks, note)
