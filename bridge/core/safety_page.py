"""Write docs/safety.md from the tables, so that it states nothing that the code does not do.

``python -m bridge.core.safety_page`` writes it; with ``--check`` it fails if that file
differs, with
``--print`` it prints it. Knows no tick.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from bridge.core.faults.fault_table import ALL, ROWS, FaultStage
from bridge.core.faults.hazards import HAZARDS, LAWS
from bridge.core.modes.mode_table import TRANSITIONS
from bridge.core.motion.braking import ALIKE, BEGIN_MPS, BETTER_STOPS
from bridge.core.state_motion import WEAK_SHARE
from pons_assets import ROOT, checkout
from wire import Action

if TYPE_CHECKING:
    from collections.abc import Iterator

PATH = ROOT / "docs" / "safety.md"

_SOURCES = {"W": "waypoints", "T": "teleop", "X": "external"}

_HEAD = """\
# What the bridge watches, and what it does about it

This page is printed from the bridge's tables by `python -m bridge.core.safety_page`; edit those.

The bridge wakes every 10 ms, looks at everything below, and sends the drive exactly one command.
It is protective software with measured behaviour, not a safety device: a planar lidar sees neither
stairs nor table tops, the fence is as true as localization, and a planner on the same user account
can do what that user can do ([security.md](security.md)). Wire a real stop button.

## Actions

The worst active row wins: {actions}.

| action | what it does |
|---|---|
| `CAP` | a factor on the limits of robot.toml, or a speed in m/s with the turn in proportion |
| `HOLD2` | ramp to zero, keep the torque |
| `STOP1` | ramp to zero, then disable the drive |
| `FAST1` | hardest ramp to zero, then disable the drive |
| `CUT0` | disable the drive now |

A row is a detector and a latch. What clears by itself (`AUTO`) may only cap or hold. A row bound to
a source acts only while that source moves the robot or holds a grant; elsewhere it is only shown.
No row and no parameter can be switched off.
"""

_MODES = """\
## Modes

What is absent from this table is forbidden. Outside ACTIVE and TELEOP the target is zero and the
output ramps to it. Powered modes are HOLD, ACTIVE, TELEOP and STOPPING; ESTOPPED keeps the torque
only until the robot stands. ESTOPPED and FAULT are latched: they are left by a reset alone.

| from | when | to |
|---|---|---|
"""

_GATES = """\
## Gates

The gates for obstacles, fence and contact work on the command, by direction: they scale it, down to
zero towards the trouble, and let pass slowly what loses no clearance. Shut for 0.5 s while a
planner's waypoints or an external brain's velocities move the robot (a tick in which something
passes gives back a quarter of a tick), a gate shows `blocked` and holds; what ends it is five scans
in a row in which the way that is asked for then is free for 0.3 m, of bumpers and of the fence.
Where there is a fence and no pose, nothing but a hand on the stick passes.

A hand on the stick may cross the fence at 0.2 m/s; each crossing is an event, `outside_fence`. Its
messages bear no proof, so what it may drive is metered by itself: 50 m and 600 s after an
operator's signed arm or resume, a metre outside the fence as ten (`HAND_BUDGET`).
Bumpers shut the way that they face, the cliff sensor the way ahead; away from them at most 0.1 m/s
and 0.3 rad/s pass.

A status gives free length and margin as far as the bridge looks: as a rule the path in which the
robot stands still from its fastest, 0.37 m by default, since nothing further off can change what
passes; 2 m where a scan is old or a tight curve was just left. At that length it means "or more".
"""


_HAZARDS = """\
## Hazards

What can go wrong, the row or gate that watches for it or the law that rules it out, the function in
`bridge/core` that does it, and the tests in `tests/bridge/core` that prove it. A test holds each
name in this table to exist.

| hazard | row, gate or law | function | tests |
|---|---|---|---|
"""


_PROOF = """\
## Who tests the tests

`make coverage` asks for every line and branch of `wire` and `bridge/core`. `make mutants` changes
the core one thing at a time, a bound, a sign, a number, a statement left out, and sees whether a
test fails. What has been tried, and each mutant that lives with the reason why:
[mutants.md](mutants.md).
"""


_BRAKING = f"""\
## Braking

Obstacle and fence gates let a speed pass that still stops within the free length:
v t + v²/2a = s. Both t (with the drive's lag) and a are robot.toml's, or worse where the robot's
own stops have shown it. Every ramp to standstill from {BEGIN_MPS:g} m/s on is judged by the
encoders against what was sent: the path left unexplained is lag; a robot that falls behind ever
more brakes weakly. What is worse counts from that stop on. What is better counts after
{BETTER_STOPS} better stops in a row, each from at least {ALIKE:g} of the speed that taught it, and
never beyond robot.toml. One worse stop begins the count anew.

The status shows what counts (`braking`: configured or learnt). It is kept in
`$PONS_HOME/braking/<robot>-<hash of robot.toml>.json`, read at start while nothing has torque; a
file that can't be read is said in the log and in every status, and robot.toml counts. After a
repair a person forgets it: `pons braking forget`, with the bridge down. Below {WEAK_SHARE:g} of
robot.toml's deceleration all speeds are capped by the same share (`weak_brakes`), so that a stop
still takes as long as its judge plans.

Encoders see wheels, not the floor: slip teaches nothing. The first stop of a robot that brakes
worse than robot.toml says is made by robot.toml's numbers.
"""


def safety_md() -> str:
    """Return the whole page."""
    actions = " < ".join(f"`{action.value}`" for action in Action)
    modes = "".join(
        f"| {mode.value} | {_cause(cause)} | {to.value} |\n"
        for (mode, cause), to in TRANSITIONS.items()
    )
    tables = (_MODES + modes, "".join(_rows()), _GATES, _BRAKING, "".join(_hazards()))
    return "\n".join((_HEAD.format(actions=actions), *tables, _PROOF, _sentences()))


def _cause(cause: object) -> str:
    return f"`{cause.value}`" if isinstance(cause, Action) else str(cause)


def _rows() -> Iterator[str]:
    yield "## Rows\n\n"
    yield "| row | what is seen | binds | window | action | clears |\n|---|---|---|---|---|---|\n"
    for row in ROWS:
        for index, stage in enumerate(row.stages):
            name = f"`{row.id}`" if index == 0 else ""
            seen = row.detector if index == 0 else ""
            yield (
                f"| {name} | {seen} | {_binds(stage)} | {stage.window} | {_does(stage)} "
                f"| {_clears(stage)} |\n"
            )


def _binds(stage: FaultStage) -> str:
    return "all" if stage.binds == ALL else ", ".join(_SOURCES[letter] for letter in stage.binds)


def _does(stage: FaultStage) -> str:
    if stage.cap_factor is not None:
        return f"`{stage.action.value}` {stage.cap_factor:g} of the limits"
    if stage.cap_mps is not None:
        return f"`{stage.action.value}` {stage.cap_mps:g} m/s"
    if stage.cap_zone:
        return f"`{stage.action.value}` the zone's speed"
    return f"`{stage.action.value}`"


def _clears(stage: FaultStage) -> str:
    if stage.clears.value != "AUTO":
        return f"`{stage.clears.value}`"
    return f"`AUTO`, clean for {stage.clean_s:g} s" if stage.clean_s > 0.0 else "`AUTO`, at once"


def _hazards() -> Iterator[str]:
    yield _HAZARDS
    for hazards in (HAZARDS, LAWS):
        for hazard in hazards:
            guard = f"`{hazard.guard}`" if hazard.guard.isupper() else hazard.guard
            tests = "<br>".join(f"`{test}`" for test in hazard.tests)
            yield f"| {hazard.what} | {guard} | `{hazard.function}` | {tests} |\n"


def _sentences() -> str:
    lines = "".join(f"| `{row.id}` | {row.en} | {row.zh} |\n" for row in ROWS)
    return f"## What a person reads\n\n| row | English | 中文 |\n|---|---|---|\n{lines}"


def main(arguments: list[str]) -> int:
    """Write, check or print the page."""
    checkout("writing docs/safety.md")
    page = safety_md()
    if not arguments:
        PATH.write_text(page, "utf-8")
    elif arguments == ["--check"]:
        if not (PATH.exists() and PATH.read_text("utf-8") == page):
            print(f"{PATH} is not what the tables say; run python -m bridge.core.safety_page")
            return 1
    else:
        print(page, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
