"""Hold what taking a grant or a hello changes, and the one reason for which each is refused."""

from __future__ import annotations

from dataclasses import replace

from bridge.core.authority import grants, ownership
from bridge.core.authority import hello as hearing
from bridge.core.authority.requests import refuse_openly
from bridge.core.state_orders import Grants, MissionLeft, Ownership
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from tests.bridge.core.test_quick_core import tick_of
from wire import PROTOCOL, Grant, Heartbeat, Held, HeldReason, Hello, Owner


def at(start: str) -> TickContext:
    return tick_of(reached(start))


def grant(tick: TickContext, mission: str = "new", metres: float = 5.0) -> Grant:
    seen = tick.s.voice.status_seq
    return Grant(planner_id="p1", epoch=tick.epoch, seen=seen, mission=mission, metres=metres,
                 seconds=9.0)  # fmt: skip


def test_a_grant_puts_the_last_one_in_the_book_and_takes_its_own_rest_out() -> None:
    tick = at("hold_granted")
    tick.s.grants = replace(
        tick.s.grants, metres=3.0, seconds=4.0, since_arm=False,
        book=(MissionLeft("new", 1.0, 2.0), MissionLeft("other", 7.0, 8.0)),
    )  # fmt: skip
    refuse_openly(tick, "grant", "new", "held", "for a test")
    tick.events.clear()
    had = tick.s.grants
    assert grants.hear_grant(tick, grant(tick)) == "new 1.0 m 2 s"
    assert tick.s.grants == Grants(
        "new", 1.0, 2.0, (MissionLeft("other", 7.0, 8.0), MissionLeft("m1", 3.0, 4.0)),
        had.operator_metres, had.operator_seconds, had.hand_metres, had.hand_seconds,
        since_arm=True,
    )  # fmt: skip
    assert tick.s.operator.refusals == ()
    again = tick.s.grants
    grants.hear_grant(tick, grant(tick, metres=50.0))
    assert tick.s.grants is again, "the same mission again changes nothing"
    other = grant(tick, "third").model_copy(update={"planner_id": "p2"})
    grants.hear_grant(tick, other)
    assert tick.s.grants is again


@table(("after_s", "granted"), [(-0.01, True), (0.0, False), (0.01, False)])
def test_a_grant_knows_of_the_jump_or_is_dropped(after_s: float, granted: bool) -> None:
    tick = at("hold")
    sent_s = tick.s.voice.ring[-1]
    tick.s.pose = replace(tick.s.pose, jumped_s=sent_s + after_s)
    grants.hear_grant(tick, grant(tick))
    assert (tick.s.grants.mission == "new") is granted
    assert ("grant_before_jump" in tick.reasons) is not granted
    assert tick.s.grants.metres == (5.0 if granted else 0.0)


def hello(tick: TickContext, **more: object) -> Hello:
    config = tick.config
    said = {"planner_id": "p2", "kind": "planner", "seen": tick.s.voice.status_seq,
            "protocol": PROTOCOL, "robot_hash": config.robot_hash,
            "fence_hash": config.fence_hash, "map_id": config.map_id}  # fmt: skip
    return Hello.model_validate(said | more)


@table("last", [None, "p2", "p1"])
def test_an_owner_is_taken_and_another_one_holds(last: str | None) -> None:
    tick = at("hold")
    tick.s.ownership = Ownership(last_owner_id=last, echo_s=None, waypoints_seq=7, external_seq=7)
    epoch = tick.s.epoch_no
    refuse_openly(tick, "hello", "p2", "not_standing", "for a test")
    hearing.hear_hello(tick, hello(tick))
    assert tick.s.operator.refusals == ()
    sent_s = tick.s.voice.ring[-1]
    owner = Owner(planner_id="p2", kind="planner")
    assert tick.s.ownership == Ownership(owner, "p2", sent_s, sent_s, None, None)
    other = last == "p1"
    assert tick.s.epoch_no == epoch + other
    assert tick.s.held == (Held(reason=HeldReason.NEW_PLANNER, id="p2") if other else None)
    assert tick.events[-1] == ("owner", "planner p2")


@table(
    ("change", "codes"),
    [
        ({"protocol": PROTOCOL + 1}, ["hello_protocol_mismatch"]),
        ({"robot_hash": "0" * 16}, ["hello_robot_mismatch"]),
        ({"fence_hash": "0" * 16}, ["hello_fence_mismatch"]),
        ({"map_id": "0" * 16}, ["hello_map_mismatch"]),
        ({"owner": True}, ["hello_owner_alive"]),
        ({"moving": True}, ["hello_not_standing"]),
        ({"age_s": 0.3}, []),
        ({"age_s": 0.3001}, ["hello_stale"]),
    ],
)
def test_a_hello_is_refused_for_one_reason_each(
    change: dict[str, object], codes: list[str]
) -> None:
    tick, change = at("hold"), dict(change)
    tick.now_s = float(str(change.pop("age_s", 0.0)))
    ring = tick.s.voice.ring
    tick.s.voice = replace(tick.s.voice, ring=(*ring[:-1], 0.0))
    tick.s.drive.received_s = tick.now_s
    tick.s.drive.still_since_s = None if change.pop("moving", False) else 0.0
    if not change.pop("owner", False):
        tick.s.ownership = Ownership()
    tick.s.ownership = replace(tick.s.ownership, echo_s=0.0)
    owned = tick.s.ownership
    hearing.hear_hello(tick, hello(tick, **change))
    assert tick.reasons == codes
    assert (tick.s.ownership == owned) is bool(codes)
    shown = [f"hello_{one.answer.code}" for one in tick.s.operator.refusals]
    assert shown == [code for code in codes if code != "hello_stale"]


def test_the_owners_own_hello_shows_that_it_lives() -> None:
    tick = at("active")
    tick.s.ownership = replace(tick.s.ownership, echo_s=0.0)
    before = tick.s.ownership
    hearing.hear_hello(tick, hello(tick, planner_id="p1"))
    assert tick.s.ownership == replace(before, echo_s=tick.s.voice.ring[-1])
    assert tick.reasons == []


@table(
    ("had_s", "back", "rightful", "used"),
    [
        (None, 0, True, True),
        (0.0, 0, True, True),
        (1e9, 0, True, False),
        (0.0, -1, True, False),  # of a status that was never sent
        (0.0, 0, False, False),
    ],
)
def test_what_a_brain_has_used_only_grows_newer(
    had_s: float | None, back: int, rightful: bool, used: bool
) -> None:
    tick = at("active")
    tick.s.ownership = replace(tick.s.ownership, used_s=had_s)
    newest = tick.s.voice.status_seq
    epoch = tick.epoch if rightful else "old-1"
    beat = Heartbeat(planner_id="p1", epoch=epoch, seen=newest, used=newest - back)
    ownership.hear_heartbeat(tick, beat)
    assert tick.s.ownership.used_s == (tick.s.voice.ring[-1] if used else had_s)
