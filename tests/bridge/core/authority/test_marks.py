"""Marks of the map: proof first, while the robot drives, and never before one it can't stop at."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core import initial
from bridge.core.geometry.fence import build_fence
from bridge.core.inbox import FenceArrival, FenceDone
from tests.bridge.core.fake_planner import MAP_ID
from tests.bridge.core.reached import reached
from tests.bridge.core.scripted import World
from wire import MarksFile
from wire.fence import fence_text
from wire.fingerprint import fingerprint

Box = tuple[float, float, float, float]


def text_of(*boxes: Box, map_id: str = MAP_ID) -> str:
    outlines = tuple(((x0, y0), (x1, y0), (x1, y1), (x0, y1)) for x0, y0, x1, y1 in boxes)
    return fence_text(MarksFile(version=1, map_id=map_id, keep_outs=outlines))


FAR = text_of((4.0, 4.0, 5.0, 5.0))


def send(
    world: World, text: str = FAR, request_id: str = "m1", *, authentic: bool = True,
    nonce: str | None = None,
) -> None:  # fmt: skip
    """Put a request in the next tick, as the link hands it over."""
    shown = world.shown.nonce if world.status is not None else "none"
    used = shown if nonce is None else nonce
    arrived = FenceArrival(request_id, "cli", used, authentic, text if authentic else "")
    world.extra = replace(world.extra, marks=(*world.extra.marks, arrived))
    world.tick()


def done(world: World, code: str = "ok", request_id: str = "m1") -> None:
    world.extra = replace(world.extra, marks_done=FenceDone(request_id, code, "1 marks"))
    world.tick()


def draw(world: World, text: str = FAR) -> str:
    send(world, text)
    done(world)
    return world.verdict("m1")


@pytest.mark.parametrize("state", ["disarmed", "hold", "active", "teleop"])
def test_proven_marks_count_in_any_mode_from_the_tick_that_says_so(state: str) -> None:
    world = reached(state)
    send(world)
    assert world.state.marks.asked is not None
    assert world.state.marks.text == ""
    send(world)  # repeated until it is echoed
    assert not [a for a in world.state.operator.answers if a.answer.id == "m1"], "not yet"
    done(world)
    assert world.verdict("m1") == "ok"
    marks = world.state.marks
    assert (marks.text, marks.asked) == (FAR, None)
    world.run(0.1)
    assert world.shown.marks_hash == fingerprint(FAR.encode())
    assert [e.code for e in world.events if e.code.startswith("marks_")] == [
        "marks_asked", "marks_accepted",
    ]  # fmt: skip
    send(world)
    assert world.state.marks is marks, "one id has one verdict"


def test_without_a_fitting_proof_nothing_is_prepared() -> None:
    world = reached("active")
    send(world, authentic=False)
    assert world.verdict("m1") == "bad_proof"
    send(world, request_id="m2", nonce="old.1.2")
    assert world.verdict("m2") == "old_nonce"
    assert world.state.marks.asked is None


def test_one_request_at_a_time_and_a_strange_outcome_changes_nothing() -> None:
    world = reached("hold")
    send(world)
    send(world, request_id="m2")
    assert world.verdict("m2") == "marks_busy"
    done(world, request_id="m9")
    assert world.state.marks.asked is not None
    done(world, "marks_unwritable")
    assert world.verdict("m1") == "marks_unwritable"
    assert world.state.marks.asked is None
    assert world.state.marks.hash is None
    done(world)
    assert world.state.marks.text == "", "nothing was asked"


def test_a_stop_of_the_same_tick_voids_a_request() -> None:
    world = reached("active")
    world.stop()
    send(world)
    assert world.verdict("m1") == "stopped"


def test_without_a_fence_there_is_nothing_to_take_away_from() -> None:
    world = reached("hold")
    world.core = replace(world.core, fence=None)
    send(world)
    assert world.verdict("m1") == "fence_missing"


def test_the_robot_is_never_put_inside() -> None:
    world = reached("hold")
    x, y = world.here.x_m, world.here.y_m
    assert draw(world, text_of((x - 0.5, y - 0.5, x + 0.5, y + 0.5))) == "mark_holds_robot"
    assert world.state.marks.text == ""


@pytest.mark.parametrize(("ahead_m", "code"), [(0.15, "mark_too_near"), (1.0, "ok")])
def test_a_driving_robot_must_be_able_to_stop_before_it(ahead_m: float, code: str) -> None:
    world = reached("active")
    world.run(0.5)
    assert world.sent.v_mps > 0.2
    x, y = world.here.x_m + ahead_m, world.here.y_m
    assert draw(world, text_of((x, y - 1.0, x + 1.0, y + 1.0))) == code


def test_a_standing_robot_needs_no_room_to_stop_in() -> None:
    world = reached("hold")
    world.run(0.5)
    x, y = world.here.x_m + 0.15, world.here.y_m
    assert draw(world, text_of((x, y - 1.0, x + 1.0, y + 1.0))) == "ok"


def test_the_gate_stops_before_a_mark_and_a_horizon_through_it_is_dropped_unscored() -> None:
    world = reached("active")
    ahead_m = world.here.x_m + 1.0
    assert draw(world, text_of((ahead_m, -2.0, ahead_m + 0.5, 2.0))) == "ok"
    scored = world.state.bad_bucket
    world.run(6.0)
    assert world.here.x_m < ahead_m
    assert world.state.bad_bucket == scored
    assert world.state.leg.refusal == "fence_crossed"


def test_what_an_earlier_run_was_left_with_counts_from_the_start() -> None:
    world = World()
    state = initial(replace(world.core, marks=FAR), 0.0)
    assert (state.marks.text, state.marks.hash) == (FAR, fingerprint(FAR.encode()))
    assert initial(world.core, 0.0).marks.hash is None


def test_outside_of_the_fence_marks_are_taken_as_they_are() -> None:
    world = reached("hold")
    fence = world.core.fence
    assert fence is not None
    x = world.here.x_m
    narrow = ((x + 0.5, -2.0), (5.0, -2.0), (5.0, 2.0), (x + 0.5, 2.0))
    world.core = replace(world.core, fence=build_fence(MAP_ID, (narrow,)))
    assert draw(world) == "ok"
