"""Hold what an epoch voids, and who may own the robot."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.authority import epoch as hearing
from bridge.core.authority.epoch import new_epoch
from bridge.core.authority.requests import refuse_openly
from bridge.core.state_orders import Ownership, Stick
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import at, reached
from tests.bridge.core.scripted import World
from tests.bridge.core.table import table
from wire import PROTOCOL, HeldReason, Hello, Owner, StandingHold


@table(("start", "keep_stick"), [("active", False), ("active_external", True), ("teleop", True)])
def test_nothing_meant_for_the_old_epoch_outlives_it(start: str, keep_stick: bool) -> None:
    tick = at(start)
    s = tick.s
    s.ownership = replace(s.ownership, waypoints_seq=7, external_seq=8)
    s.leg = replace(reached("active").state.leg, refusal="fence")
    s.external = reached("active_external").state.external
    s.stick = stick = replace(reached("teleop").state.stick, seq=5)
    leg, epoch_no, owner = s.leg, s.epoch_no, s.ownership
    assert None not in (s.external, leg.horizon, leg.path)
    new_epoch(tick, "test", keep_stick=keep_stick)
    assert s.epoch_no == epoch_no + 1
    assert s.ownership == replace(owner, waypoints_seq=None, external_seq=None)
    assert s.leg == replace(leg, horizon=None, path=None, refusal=None)
    assert s.external is None
    assert s.stick == (replace(stick, seq=-1) if keep_stick else Stick())
    assert s.grants.mission is None
    assert tick.events == [("epoch", "test")]


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
    assert tick.s.held == (StandingHold(reason=HeldReason.NEW_PLANNER, id="p2") if other else None)
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


@pytest.mark.parametrize(
    ("field", "came", "code", "to_do"),
    [
        ("robot_hash", "e" * 16, "robot_mismatch", "the same robot.toml"),
        ("fence_hash", "e" * 16, "fence_mismatch", "the same fence.json"),
        ("map_id", "e" * 16, "map_mismatch", "the same map"),
        ("protocol", PROTOCOL + 1, "protocol_mismatch", "one version"),
    ],
)
def test_what_differs_is_named_with_both_values_and_a_remedy(
    field: str, came: object, code: str, to_do: str
) -> None:
    world = World()
    plain = world.brain.hello

    def changed(status: object) -> Hello:
        return plain(status).model_copy(update={field: came})  # type: ignore[arg-type]

    world.brain.hello = changed  # type: ignore[method-assign]
    world.ready()
    world.run(0.5)
    assert world.state.ownership.owner is None
    (answer,) = [item for item in world.shown.answers if item.kind == "hello"]
    assert (answer.accepted, answer.code) == (False, code)
    assert f"came {came}, expected " in answer.detail
    assert to_do in answer.detail
