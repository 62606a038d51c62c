"""Hold what speaks against arming and against a reset."""

from __future__ import annotations

from dataclasses import replace

from bridge.core.authority.requests import bad_proof
from bridge.core.faults.fault_table import STAGES
from bridge.core.inbox import Inbox
from bridge.core.modes.operator import arm_lacks, ready_lacks, reset_lacks
from bridge.core.state import RowUp
from bridge.core.state_orders import PendingFence
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.scripted import World
from tests.bridge.core.table import table
from wire import IDENTITY, Mode

NOW_S = 10.0


def at(start: str) -> TickContext:
    """Return a tick at 10 s of a robot that has long stood and is being recorded."""
    tick = tick_of(reached(start))
    tick.now_s, tick.s.rows = NOW_S, {}
    tick.s.drive.received_s, tick.s.drive.still_since_s = NOW_S, 0.0
    tick.s.loop = replace(tick.s.loop, recorder_ok=True)
    return tick


@table(
    ("what", "codes"),
    [
        ("nothing", []),
        ("fence", ["fence_changing"]),
        ("moves", ["not_standing"]),
        ("stick", ["stick_not_neutral"]),
        ("stick_long_ago", []),
        ("unrecorded", ["disk_full"]),
    ],
)
def test_each_thing_alone_speaks_against_arming(what: str, codes: list[str]) -> None:
    tick = at("disarmed")
    if what == "fence":
        tick.s.fence_asked = PendingFence("f1", "test", "{}", IDENTITY)
    elif what == "moves":
        tick.s.drive.still_since_s = NOW_S - 0.4
    elif what.startswith("stick"):
        pressed_s = NOW_S - (0.24 if what == "stick" else 0.26)
        tick.s.stick = replace(tick.s.stick, pressed_s=pressed_s)
    elif what == "unrecorded":
        tick.s.loop = replace(tick.s.loop, recorder_ok=False)
        tick.inbox = Inbox(recorder_says="disk_full: nothing is left")
    assert [code for code, _ in ready_lacks(tick)] == codes


EPS = 1e-6


def tick_in(start: str) -> TickContext:
    return tick_of(reached(start))


@table(
    ("name", "age_s", "speaks"),
    [
        ("RUNAWAY.0", 2.0, True),
        ("RUNAWAY.0", 2.0 + EPS, False),
        ("ENC_STALE.0", 0.01 - EPS, True),
        ("ENC_STALE.0", 0.01 + EPS, False),
        ("LIDAR_STALE.0", 0.0, True),
        ("NO_RANGE.0", 0.0, False),
        ("LOOP_LATE.0", 0.0, False),
        ("BRAIN_GONE.0", 0.0, False),
    ],
)
def test_a_row_speaks_against_arming_while_it_is_dirty(
    name: str, age_s: float, speaks: bool
) -> None:
    tick = tick_in("disarmed")
    tick.s.rows = {name: RowUp(0.0, tick.now_s - age_s, "seen")}
    lacks = [(STAGES[name].row.lower(), "seen")] if speaks else []
    assert list(ready_lacks(tick)) == lacks


@table(
    ("change", "code"),
    [
        ("nothing", None),
        ("pressed_ago", "estop_just_released"),
        ("moves", "not_standing"),
        ("row", "runaway"),
        ("estop_row", None),
        ("other_row", None),
    ],
)
def test_a_reset_waits_for_one_thing_each(change: str, code: str | None) -> None:
    for age_s in (2.0 - EPS, 2.0 + EPS):
        tick = tick_in("fault")
        tick.s.rows = {}
        tick.s.buttons = replace(tick.s.buttons, pressed_s=None)
        if change == "pressed_ago":
            tick.s.buttons = replace(tick.s.buttons, pressed_s=tick.now_s - age_s)
        elif change == "moves":
            tick.s.drive.still_since_s = tick.now_s - age_s + 1.5
        elif change.endswith("row"):
            name = {"row": "RUNAWAY.0", "estop_row": "ESTOP.0"}.get(change, "ENC_STALE.1")
            tick.s.rows = {name: RowUp(0.0, tick.now_s - age_s, "seen")}
        lacks = [one for one, _ in reset_lacks(tick)]
        assert lacks == ([code] if code and age_s < 2.0 else [])


def test_nobody_is_armed_before_a_scan_has_come() -> None:
    world = reached("disarmed")
    world.state.lidar = replace(world.state.lidar, received_s=None)
    world.lidar_silent = True
    request_id = world.op("arm")
    world.tick()
    assert world.verdict(request_id) == "lidar_stale"


def test_every_reason_is_told_to_the_last() -> None:
    tick = tick_of(reached("active"))
    assert [code for code, _ in arm_lacks(tick)] == ["not_disarmed"]
    assert [code for code, _ in reset_lacks(tick)] == ["not_latched"]
    for nonce, authentic, code in ((None, True, "bad_proof"), ("b0.0", True, "old_nonce")):
        told = [one for one, _ in bad_proof(tick, "arm", "a1", nonce, authentic=authentic)]
        assert told == [code]


REASON = "No space left on device in /home/pons/recordings"


def unrecorded(world: World, says: str = f"disk_full: {REASON}") -> World:
    world.recorder_ok, world.recorder_says = False, says
    return world


def waiting(world: World) -> tuple[str, ...]:
    assert world.status is not None
    return world.status.waiting_for


def test_a_full_disk_stops_nobody_and_is_told_once() -> None:
    world = unrecorded(World().driving((3.0, 0.0)))
    world.run(2.0)
    assert world.mode is Mode.ACTIVE
    told = [event.detail for event in world.events if event.code == "disk_full"]
    assert told == [REASON]
    assert waiting(world) == ("disk_full",)
    world.recorder_ok, world.recorder_says = True, ""
    world.run(0.2)
    assert waiting(world) == ()
    assert [event.code for event in world.events].count("recorder_up") == 1


def test_arming_is_refused_by_code_and_sentence_until_there_is_room() -> None:
    world = unrecorded(World().ready())
    world.run(0.4)
    assert "disk_full" in waiting(world)
    request_id = world.op("arm")
    world.tick()
    assert world.verdict(request_id) == "disk_full"
    details = [item.answer.detail for item in world.state.operator.answers]
    assert REASON in details
    assert world.is_in(Mode.DISARMED)
    world.recorder_ok, world.recorder_says = True, ""
    world.run(0.4)
    request_id = world.op("arm")
    world.tick()
    assert world.verdict(request_id) == "ok"


def test_a_recorder_that_does_not_say_why_is_down() -> None:
    world = unrecorded(World().armed(), says="")
    world.run(0.1)
    assert waiting(world) == ("recorder_down",)
