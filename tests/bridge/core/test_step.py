"""Hold the order of one step by single calls on states made by hand."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core import Inbox, RejectedAt, initial
from bridge.core.state_motion import Gate
from tests.bridge.core.fake_planner import PERIOD_S
from tests.bridge.core.reached import reached
from tests.bridge.core.scripted import World, config
from wire import IDENTITY, DecodeFailure, Mode


def test_a_run_begins_in_its_first_epoch_without_a_nonce() -> None:
    state = initial(config(), 7.0)
    assert (state.epoch_no, state.operator.nonce_no, state.tick, state.command_seq) == (1, 0, 0, 0)
    assert state.now_s == state.started_s == state.mode_since_s == 7.0
    assert state.operator.nonce_made_s == 7.0
    assert state.mode is Mode.BOOT
    assert not state.motion.powered


def test_a_tick_is_counted_dated_and_metered() -> None:
    world = reached("active")
    before = world.state
    world.tick()
    after = world.state
    assert (after.tick, after.command_seq) == (before.tick + 1, before.command_seq + 1)
    assert after.now_s == pytest.approx(before.now_s + PERIOD_S)
    moved_m = after.odometry.travelled_m - before.odometry.travelled_m
    assert moved_m > 0.003
    assert before.grants.metres - after.grants.metres == pytest.approx(moved_m)
    assert before.grants.seconds - after.grants.seconds == pytest.approx(PERIOD_S)
    assert before.grants.operator_metres - after.grants.operator_metres == pytest.approx(moved_m)
    world.now_s -= 1.0
    world.tick()
    assert world.state.now_s == after.now_s, "a clock that runs backwards stands still"


def test_before_it_listens_a_tick_lets_go_what_is_over() -> None:
    world = reached("active")
    state = world.state
    state.bad_bucket = 3.0
    state.operator = replace(state.operator, nonce_made_s=world.now_s - 60.0)
    state.ownership = replace(state.ownership, echo_s=world.now_s - 0.35)
    world.brain.silent = True
    nonce, epoch = state.operator.nonce_no, state.epoch_no
    world.tick()
    assert world.state.bad_bucket == pytest.approx(3.0 - PERIOD_S / 0.5)
    assert world.state.operator.nonce_no == nonce + 1
    assert world.state.ownership.owner is None
    assert world.state.epoch_no == epoch + 1


def everything(world: World) -> Inbox:
    """Return one of each message that a stop voids."""
    kept: dict[str, object] = {}
    for name in ("hellos", "grants", "heartbeats", "waypoints"):
        for inbox, _ in world.inboxes:
            if getattr(inbox, name):
                kept[name] = getattr(inbox, name)
    return replace(Inbox(), **kept)  # type: ignore[arg-type]  # names of its fields


def test_a_stop_voids_all_that_came_with_it_but_not_where_the_robot_is() -> None:
    recorded = World(keep=True).driving()
    inbox = everything(recorded)
    world = reached("active")
    world.brain.silent = True
    world.teleop(0.2, held=True)
    stick = world.extra.teleop
    world.extra = replace(inbox, teleop=stick, external=stick)
    world.stop()
    decision = world.tick()
    assert list(decision.reasons).count("void_by_stop") == 6
    assert world.is_in(Mode.STOPPING)
    assert decision.status is not None
    assert decision.status.base_in_map is not None, "it still knows where it is"


def test_a_blocked_way_is_judged_on_what_would_be_asked_and_nothing_is_followed() -> None:
    world = reached("hold_granted")
    world.brain.goal_m, world.brain.next_horizon_s = (5.0, 0.0), 0.0
    world.state.gate = Gate(blocked=True)
    kept = world.state.motion.follow
    judged = []
    for _ in range(100):
        world.tick()
        judged.append(world.state.gate.free_scans)
        assert world.state.motion.asked.v_mps == 0.0 or not world.state.gate.blocked
        if not world.state.gate.blocked:
            break
        assert world.state.motion.follow == kept
        kept = world.state.motion.follow
    assert judged[-2:] == [4, 0], "five free scans open the way"
    assert sorted(set(judged)) == [0, 1, 2, 3, 4]


def test_who_has_arrived_leaves_active_in_the_same_tick() -> None:
    world = reached("active")
    world.brain.goal_m = None
    world.brain.next_horizon_s = 0.0
    world.until(Mode.HOLD, 3.0)
    assert world.state.source == ""
    assert world.here != IDENTITY


@pytest.mark.parametrize("granted", [True, False])
def test_a_blocked_way_is_forgotten_once_nothing_is_granted(*, granted: bool) -> None:
    world = reached("hold_granted" if granted else "hold")
    world.brain.goal_m = None
    world.state.gate = Gate(blocked=True)
    world.tick()
    assert world.state.gate.blocked is granted
    assert (world.state.grants.mission is not None) is granted


def test_a_new_leg_is_followed_from_its_beginning() -> None:
    world = reached("active")
    learnt = world.state.motion.follow
    state = world.state
    state.leg = replace(state.leg, mission="m0")  # what was followed was another mission's
    state.motion.follow = replace(learnt, tries=9)
    world.brain.next_horizon_s = 0.0
    for _ in range(100):
        world.tick()
        if world.state.leg.mission == "m1":
            break
    assert world.state.leg.mission == "m1"
    assert world.state.motion.follow.tries == 0


def test_bytes_that_are_no_message_are_counted_and_charged_to_whoever_drives() -> None:
    world = reached("active")
    before = world.state.voice.dropped
    why = DecodeFailure(code="not_json", detail="")
    world.extra = replace(Inbox(), rejected=(RejectedAt(key="cmd/waypoints", why=why),))
    decision = world.tick()
    assert "rejected_not_json" in decision.reasons
    assert world.state.bad_bucket == 1.0
    world.run(0.1)
    assert world.state.voice.dropped > before
