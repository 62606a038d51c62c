"""Kill and freeze the brain at random moments of a drive and see when the bridge holds.

Real bridge, simulator and localization; the brain is a stub that speaks with the planner's own link
code. Counted from the newest echoed status to the tick that decided HOLD2, in periods of the loop's
absolute schedule: what the host took away is included, a tick's own lateness is rounded off. A
restart unasked is motion after a kill before a person acted.
"""

from __future__ import annotations

import time
from contextlib import ExitStack
from random import Random
from typing import TYPE_CHECKING, Any

from tools.bench.context import until
from tools.bench.figures import none_in
from tools.bench.planner_stubs import Legs, Stub
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import SLOW, BenchRobot
from wire import Mode

if TYPE_CHECKING:
    from collections.abc import Callable

    from tools.bench.context import BenchLab
    from wire import Status

NAME = "brain_silent"
TITLE = "brain silent -> HOLD2"
LONG_ONLY = False
GOAL = "each <= 31"
TICK_S = 0.01
BODY = ("sim", "localization", "bridge")
PER_SLICE = 20
MOVING_MPS = 0.1
SPEEDS_MPS = (0.5, 0.2)
WATCH_S = 0.15
"""How long a new brain asks in vain before a person resumes."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take 10 kills and 10 freezes, in a long run 280 of each; every second slice is slow."""
    rows: list[ReportRow] = []
    for way, take in (("kill", _kills), ("freeze", _freezes)):
        count = lab.count(1, 14)
        runs = list(lab.slices(way, count, lambda index, take=take: _run(lab, index, take)))  # type: ignore[misc]  # the default binds the loop's function
        ticks = [round(age / TICK_S) for run in runs for age in run["ages_s"]]
        slowest = min((run["speed"] for run in runs), default=0.0)
        late = sum(tick > 31 for tick in ticks)
        asked = sum(run["cycles"] for run in runs)
        other = sum(len(run["otherwise"]) for run in runs)
        note = (
            f"{late} over 31; {len(ticks)} of {asked} out of ACTIVE, {other} while another row "
            f"held already; slowest run's simulator {slowest:.2f} x"
        )
        for fast in SPEEDS_MPS[: len(runs)]:
            at = [round(a / TICK_S) for r in runs if r["speed_mps"] == fast for a in r["ages_s"]]
            note += f"; most {max(at, default=0)} at {fast} m/s (n {len(at)})"
        samples = [float(tick) for tick in ticks]
        rows.append(row_of(f"{way} -> HOLD2", "ticks", GOAL, samples, note, valid=slowest >= SLOW))
        if way == "kill":
            unasked = sum(run["unasked"] for run in runs)
            said = none_in(asked) if unasked == 0 else f"{unasked} of {asked}"
            rows.append(ReportRow("restarts unasked after a kill", "", "0", value=said))
    return rows


def _run(
    lab: BenchLab, index: int, take: Callable[[BenchLab, BenchRobot, Random, ExitStack, Legs], int]
) -> dict[str, Any]:
    chance, speed_mps = Random(index), SPEEDS_MPS[index % len(SPEEDS_MPS)]
    with lab.folder() as home, BenchRobot(home, "two_room", tapped=True, only=BODY) as robot:
        with ExitStack() as stubs:
            robot.make_ready()
            robot.forget()
            unasked = take(lab, robot, chance, stubs, Legs(robot, speed_mps))
        noted = robot.end_bridge()
        held = [s for s in noted["silences"] if s["from"] == Mode.ACTIVE.value]
        return {
            "ages_s": [one["age_s"] for one in held if one["age_s"] is not None],
            "cycles": _trials(lab),
            "speed_mps": speed_mps,
            "unasked": unasked,
            "speed": robot.speed,
            "otherwise": [s for s in noted["silences"] if s["from"] != Mode.ACTIVE.value],
        }


def _trials(lab: BenchLab) -> int:
    """Return how often a slice kills or freezes."""
    return lab.count(PER_SLICE // 2, PER_SLICE)


def _kills(lab: BenchLab, robot: BenchRobot, chance: Random, stubs: ExitStack, legs: Legs) -> int:
    """Kill stub after stub; return how often one of them moved unasked."""
    unasked = 0
    following = _stub(robot, stubs, 0)
    count = _trials(lab)
    for number in range(count):
        lab.say(f"kill {number + 1}/{count}")
        stub, following = following, _stub(robot, stubs, number + 1)
        _send_off(robot, stub, legs, number)
        if number > 0:  # this planner's id is new: it must wait for a person
            unasked += _moved_within(robot, WATCH_S)
        _until_moving(robot)
        time.sleep(chance.uniform(0.0, 0.3))
        stub.kill()
        until(lambda: _stands(robot.status), 5.0, "standing after a kill", 0.002)
        stub.end()
    return unasked


def _freezes(lab: BenchLab, robot: BenchRobot, chance: Random, stubs: ExitStack, legs: Legs) -> int:
    """Freeze one stub again and again; it goes on by itself each time."""
    stub = _stub(robot, stubs, 0)
    _send_off(robot, stub, legs, 0)
    count = _trials(lab)
    for number in range(count):
        lab.say(f"freeze {number + 1}/{count}")
        _until_moving(robot)
        time.sleep(chance.uniform(0.0, 0.3))
        stub.freeze()
        time.sleep(chance.uniform(0.5, 0.8))
        until(lambda: _stands(robot.status), 5.0, "standing after a freeze", 0.002)
        stub.thaw()
    return 0


def _stub(robot: BenchRobot, stubs: ExitStack, number: int) -> Stub:
    stub = Stub(robot, f"stub-{number}")
    stubs.callback(stub.end)
    return stub


def _send_off(robot: BenchRobot, stub: Stub, legs: Legs, number: int) -> None:
    status = robot.status
    until(lambda: robot.status is not None and robot.status.base_in_map is not None, 5.0, "a pose")
    pose = status.base_in_map if status is not None else None
    if pose is not None:
        stub.go(f"mission-{number}", legs.between(pose, "living_room", "kitchen"))


def _until_moving(robot: BenchRobot) -> None:
    """Let a person resume where the bridge holds, until the robot drives."""
    end_s = time.monotonic() + 10.0
    while not _moves(robot.status):
        status = robot.status
        if status is not None and status.mode is Mode.DISARMED:
            robot.operate("arm")  # the host held the simulator up; the bridge disarmed by ENC_STALE
        if status is not None and status.held is not None and status.owner is not None:
            robot.operate("resume")
        time.sleep(0.005)
        if time.monotonic() > end_s:
            until(lambda: _moves(robot.status), 0.1, f"driving ({robot.describe()})")


def _moved_within(robot: BenchRobot, seconds: float) -> int:
    end_s = time.monotonic() + seconds
    while time.monotonic() < end_s:
        status = robot.status
        if status is not None and (status.mode is Mode.ACTIVE or _moves(status)):
            return 1
        time.sleep(0.005)
    return 0


def _moves(status: Status | None) -> bool:
    return (
        status is not None
        and status.mode is Mode.ACTIVE
        and abs(status.measured.v_mps) > MOVING_MPS
    )


def _stands(status: Status | None) -> bool:
    return (
        status is not None
        and status.mode in (Mode.HOLD, Mode.STOPPING)
        and abs(status.measured.v_mps) < 0.02
    )
