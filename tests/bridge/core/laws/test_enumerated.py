"""Enumerate the state machine: every mode by every set of up to three rows at once.

Modes are reached by real runs of the scripted world. Rows are then forced into the latch's memory
as if their detectors saw trouble in this tick, all but ESTOP, which is the drive's real input, and
SPEED_ZONE, which also needs a zone to be in. What must follow comes from a table written by hand.
Of the 7 770 sets of three each mode takes every sixteenth, of the 666 pairs every fourth;
``make enumerate`` takes them all.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from itertools import combinations, islice

import pytest

from bridge.core import BridgeState, CoreConfig, Decision, Inbox, step
from bridge.core.faults.fault_table import STAGES
from bridge.core.geometry.fence import Zone, build_fence
from bridge.core.state import RowUp
from tests.bridge.core import oracle
from tests.bridge.core.fake_planner import MAP_ID, PERIOD_S
from tests.bridge.core.reached import MOVES, STARTS, reached
from wire import STILL, Action, HeldReason, Mode, Stop

Stages = tuple[str, ...]
ALL = tuple(oracle.TABLE)
SQUARE = ((-5.5, -5.5), (5.5, -5.5), (5.5, 5.5), (-5.5, 5.5))
ZONED = build_fence(MAP_ID, (SQUARE,), zones=(Zone(SQUARE, 0.3),))
WHOLE = os.environ.get("ENUMERATE") == "all"
EVERY = 1 if WHOLE else 16
LATCHED = {Mode.ESTOPPED, Mode.FAULT}


def test_the_table_by_hand_knows_every_stage() -> None:
    assert set(ALL) == set(STAGES)


@cache
def here(start: str) -> tuple[CoreConfig, BridgeState, Inbox, float]:
    """Return a mode that was reached, and a well-behaved world's next inbox."""
    world = reached(start)
    world.now_s += PERIOD_S
    world.ticks += 1
    return world.core, world.state, world._inbox(), world.now_s


def forced(start: str, stages: Stages, stops: tuple[Stop, ...] = ()) -> Decision:
    """Take one step in which trouble is seen in all these stages."""
    core, state, inbox, now_s = here(start)
    up = {name: RowUp(now_s, now_s + 1e-9, "forced") for name in stages if name != "ESTOP.0"}
    if "ESTOP.0" in stages:
        pressed = tuple(one.model_copy(update={"estop_pressed": True}) for one in inbox.drive)
        inbox = replace(inbox, drive=pressed)
    if "SPEED_ZONE.0" in stages:
        core = replace(core, fence=ZONED)
    if stops:
        inbox = replace(inbox, stops=stops)
    return step(core, replace(state, rows=state.rows | up), inbox, now_s)


def judge(start: str, stages: Stages) -> None:
    """Hold one case to the table by hand."""
    _, before, _, _ = here(start)
    _, mode, letters = STARTS[start]
    decision = forced(start, stages)
    after = decision.state
    up = set(after.rows)
    lost = set(stages) - up
    # A lost brain's row ends with an owner where nothing moves; a zone is none without a pose.
    moved = mode in {Mode.ACTIVE, Mode.STOPPING}
    assert lost <= (set() if moved else {"BRAIN_LOST.0"}) | ({"SPEED_ZONE.0"} - set(before.rows))
    action = oracle.worst(up, letters)
    reset = any(oracle.acts(one, letters) for one in up & oracle.NEEDS_RESET)
    if mode is Mode.BOOT:
        mode = Mode.SELFTEST  # in its first tick, whatever else is up
    if "ESTOP.0" in stages:
        expected = Mode.ESTOPPED
    else:
        expected = oracle.next_mode(mode, action, moves=start in MOVES, reset=reset)
    assert after.mode is expected, (start, stages, action, after.mode)
    if after.mode is Mode.STOPPING:
        check_stop(before, decision, action, reset=reset)
    if after.mode in oracle.MOVING:
        share = oracle.cap(up, letters)
        assert after.motion.cap == pytest.approx(share)
        had = before.motion.limiter.sent
        assert abs(after.motion.limiter.sent.v_mps) <= max(abs(had.v_mps), 0.5 * share) + 1e-9
    if mode in LATCHED:
        assert after.mode in LATCHED
    if decision.command is None:
        assert after.selftest.phase == "withhold"
    else:
        oracle.check_output(before, decision)


def check_stop(before: BridgeState, decision: Decision, action: Action, *, reset: bool) -> None:
    """Hold a stop in progress to the worst that ever acted in it."""
    stop, had = decision.state.stopping, before.stopping
    assert stop is not None
    least = Action.NONE if had is None else had.action
    assert oracle.ORDER.index(stop.action) == max(
        oracle.ORDER.index(action), oracle.ORDER.index(least)
    )
    assert stop.reset_needed is (reset or (had is not None and had.reset_needed))


def sets_of(count: int) -> Iterator[Stages]:
    return combinations(ALL, count)


@pytest.mark.parametrize("start", STARTS)
def test_every_mode_by_every_row(start: str) -> None:
    for stages in (*sets_of(0), *sets_of(1)):
        judge(start, stages)


@pytest.mark.parametrize("start", STARTS)
def test_every_mode_by_every_pair_of_rows(start: str) -> None:
    first = list(STARTS).index(start) % 4
    pairs = islice(sets_of(2), 0 if WHOLE else first, None, 1 if WHOLE else 4)
    for stages in pairs:
        judge(start, stages)


@pytest.mark.slow
@pytest.mark.parametrize("start", STARTS)
def test_every_mode_by_every_three_rows(start: str) -> None:
    first = list(STARTS).index(start) % EVERY  # another part in each mode
    for stages in islice(sets_of(3), first, None, EVERY):
        judge(start, stages)


def stop_wins(start: str, stages: Stages) -> None:
    """Let a stop come with the rows."""
    _, before, _, _ = here(start)
    after = forced(start, stages, (Stop(id="s-new", source="test"),)).state
    assert after.mode not in oracle.MOVING
    assert after.epoch_no > before.epoch_no
    assert after.grants.mission is None
    assert after.held is not None
    assert after.held.reason is HeldReason.STOP
    if before.mode in oracle.MOVING and after.mode is Mode.STOPPING:
        assert after.stopping is not None
        assert not after.stopping.resumes


@pytest.mark.parametrize("start", STARTS)
def test_a_stop_wins_in_every_mode_over_every_row(start: str) -> None:
    for stages in (*sets_of(0), *sets_of(1)):
        stop_wins(start, stages)


@pytest.mark.slow
@pytest.mark.parametrize("start", STARTS)
def test_a_stop_wins_in_every_mode_over_every_pair_of_rows(start: str) -> None:
    for stages in islice(sets_of(2), 0, None, EVERY):
        stop_wins(start, stages)


FOLLOWED = [one for one in sorted(MOVES) if STARTS[one][1] in oracle.MOVING]
FOLLOWED = FOLLOWED if WHOLE else ["active", "teleop"]


@pytest.mark.parametrize("start", FOLLOWED)
@pytest.mark.parametrize("stage", [one for one in ALL if oracle.TABLE[one][0] != "CAP"])
def test_after_a_row_fires_output_never_exceeds_its_stop_curve(start: str, stage: str) -> None:
    _, _, letters = STARTS[start]
    if stage != "ESTOP.0" and not oracle.acts(stage, letters):
        return
    world = reached(start)
    action = Action(oracle.TABLE[stage][0])
    if stage == "BRAIN_LOST.0":
        world.brain.silent = True  # or its return would end the row where the robot stands
    first_mps, begun_s = oracle.rim_mps(world.sent), world.now_s
    while world.now_s < begun_s + 0.8:
        at_s = world.now_s + PERIOD_S + 1e-9
        if stage == "ESTOP.0":
            world.drive.estop_pressed = True
        else:
            world.state.rows = world.state.rows | {stage: RowUp(begun_s, at_s, "forced")}
        before = world.state
        decision = world.tick()
        oracle.check_output(before, decision)
        sent = oracle.rim_mps(world.sent)
        assert sent <= oracle.curve_mps(first_mps, world.now_s - begun_s, action) + 1e-6
        assert world.mode not in oracle.MOVING
    assert world.sent == STILL


HARDER = ["LIDAR_STALE.0", "STUCK.1", "ENC_STALE.1", "RUNAWAY.1"]


@pytest.mark.parametrize("after_ticks", [1, 7, 25])
@pytest.mark.parametrize("second", HARDER[1:])
@pytest.mark.parametrize("first", HARDER[:3])
def test_a_harder_row_makes_the_stop_harder_and_a_milder_one_nothing(
    first: str, second: str, after_ticks: int
) -> None:
    world = reached("active")
    worst = max(first, second, key=lambda one: oracle.ORDER.index(Action(oracle.TABLE[one][0])))
    for tick in range(80):
        at_s = world.now_s + PERIOD_S + 1e-9
        rows = {first: RowUp(world.now_s, at_s, "forced")}
        if tick >= after_ticks:
            rows[second] = RowUp(world.now_s, at_s, "forced")
        world.state.rows = world.state.rows | rows
        before = world.state
        oracle.check_output(before, world.tick())
        if tick == after_ticks and world.is_in(Mode.STOPPING):
            assert world.state.stopping is not None
            assert world.state.stopping.action is Action(oracle.TABLE[worst][0])
    ends = {"HOLD2": Mode.HOLD, "STOP1": Mode.DISARMED, "FAST1": Mode.DISARMED, "CUT0": Mode.FAULT}
    world.run(0.5)
    assert world.mode is ends[oracle.TABLE[worst][0]]
