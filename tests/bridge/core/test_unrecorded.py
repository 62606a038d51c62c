"""A run that is not recorded is driven on and said; only arming is refused, by its code."""

from __future__ import annotations

from tests.bridge.core.scripted import World
from wire import Mode

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
