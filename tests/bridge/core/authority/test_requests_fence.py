"""An operator's fence: proof first, only disarmed and standing, and arming waits for it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.authority.requests import hear_fence, nonce_text
from bridge.core.inbox import FenceArrival, FenceDone
from tests.bridge.core.reached import at
from tests.bridge.core.scripted import World
from wire import Mode

TEXT = '{"version":1}'


def send(
    world: World,
    request_id: str = "f1",
    *,
    authentic: bool = True,
    nonce: str | None = None,
    proof: bool = True,
) -> str:
    """Put a request in the next tick, as the link hands it over."""
    shown = world.shown.nonce if world.status is not None else "none"
    used = (shown if nonce is None else nonce) if proof else None
    arrived = FenceArrival(request_id, "cli", used, authentic, TEXT if authentic else "")
    world.extra = replace(world.extra, fences=(*world.extra.fences, arrived))
    return request_id


def done(world: World, code: str = "ok", request_id: str = "f1") -> None:
    world.extra = replace(world.extra, fence_done=FenceDone(request_id, code, "old -> new"))
    world.tick()


def said(world: World) -> list[str]:
    return [event.code for event in world.events if event.code.startswith("fence_")]


@pytest.fixture
def world() -> World:
    return World().ready()


def test_a_proven_request_is_handed_over_and_its_verdict_comes_with_the_writing(
    world: World,
) -> None:
    send(world)
    world.tick()
    asked = world.state.fence_asked
    assert asked is not None
    assert (asked.id, asked.source, asked.text) == ("f1", "cli", TEXT)
    send(world)
    world.run(0.2)
    assert not [a for a in world.state.operator.answers if a.answer.id == "f1"], "not yet"
    done(world)
    assert world.verdict("f1") == "ok"
    assert world.state.fence_asked is not None
    assert world.state.fence_asked.written
    assert world.state.fence_asked.text == ""
    assert said(world) == ["fence_asked", "fence_accepted"]
    accepted = next(event for event in world.events if event.code == "fence_accepted")
    assert accepted.detail == "by cli: old -> new"


def test_until_the_bridge_starts_anew_nobody_arms(world: World) -> None:
    send(world)
    world.tick()
    assert world.asked("arm") == "fence_changing"
    done(world)
    assert world.asked("arm") == "fence_changing"
    assert world.is_in(Mode.DISARMED)


def test_what_can_not_be_written_is_refused_and_arming_goes_on(world: World) -> None:
    send(world)
    world.tick()
    done(world, "fence_excludes_robot")
    assert world.verdict("f1") == "fence_excludes_robot"
    assert world.state.fence_asked is None
    assert said(world) == ["fence_asked", "fence_refused"]
    world.run(0.1)
    assert world.asked("arm") == "ok"


@pytest.mark.parametrize("mode", ["HOLD", "ACTIVE", "ESTOPPED", "SELFTEST"])
def test_in_any_other_mode_it_is_refused_loosening_or_not(mode: str) -> None:
    world = World()
    if mode == "SELFTEST":
        world.run(0.2)
    elif mode == "HOLD":
        world.armed()
    else:
        world.driving()
        if mode == "ESTOPPED":
            world.op("estop")
            world.run(0.1)
    assert world.mode.value == mode
    send(world)
    world.tick()
    assert world.verdict("f1") == "not_disarmed"
    assert world.state.fence_asked is None


def test_without_a_fitting_proof_nothing_is_looked_at(world: World) -> None:
    send(world, "f1", authentic=False)
    send(world, "f2", proof=False)
    send(world, "f3", nonce="boot1.999")
    world.tick()
    assert world.verdict("f1") == "bad_proof"
    assert world.verdict("f2") == "bad_proof"
    assert world.verdict("f3") == "old_nonce"
    assert world.state.fence_asked is None


def test_a_proof_works_once_whatever_is_forgotten(world: World) -> None:
    nonce = world.shown.nonce
    send(world)
    world.tick()
    done(world, "fence_unwritable")
    send(world, nonce=nonce)
    world.tick()
    assert world.verdict("f1") == "fence_unwritable", "one id, one verdict"
    world.state.operator = replace(world.state.operator, answers=())
    send(world, nonce=nonce)
    world.tick()
    assert world.verdict("f1") == "repeated"


def test_a_stop_in_the_same_tick_wins(world: World) -> None:
    world.stop()
    send(world)
    world.tick()
    assert world.verdict("f1") == "stopped"
    assert world.state.fence_asked is None


def test_two_at_once_are_one_and_a_refusal(world: World) -> None:
    send(world, "f1")
    world.tick()
    world.run(0.06)
    send(world, "f2")
    world.tick()
    assert world.verdict("f2") == "fence_busy"


def test_a_robot_that_nobody_located_gets_no_fence(world: World) -> None:
    world.localization_silent = True
    world.run(1.0)
    send(world)
    world.tick()
    assert world.verdict("f1") == "robot_unlocated"
    said = [item.answer.detail for item in world.state.operator.answers if item.answer.id == "f1"]
    assert said == ["where the robot stands is not known, so it may be outside"]


def test_an_answer_nobody_waits_for_changes_nothing(world: World) -> None:
    done(world, "ok", "other")
    assert world.state.fence_asked is None
    assert said(world) == []


def test_half_a_second_of_standing_is_long_enough() -> None:
    for still_s, refused in ((0.48, True), (0.52, False)):
        tick = at("disarmed")
        tick.s.drive.still_since_s = tick.now_s - still_s
        tick.robot_in_map = tick.s.odometry.base_in_odom
        arrived = FenceArrival("f1", "cli", nonce_text(tick), authentic=True, text=TEXT)
        hear_fence(tick, arrived)
        codes = [item.answer.code for item in tick.s.operator.answers if item.answer.id == "f1"]
        assert codes == (["not_standing"] if refused else [])
        assert (tick.s.fence_asked is None) is refused
