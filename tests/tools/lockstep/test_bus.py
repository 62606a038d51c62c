"""The lockstep bus delivers what the key table promises, when and how often it was told to."""

from __future__ import annotations

import pytest

from tools.lockstep import Disturbance, LockstepBus
from wire import DecodeFailure, Heartbeat, Stop, keys
from wire.keys import Party

PAIR = frozenset({Party.PLANNER, Party.BRIDGE})


def stop(count: int) -> Stop:
    return Stop(id=f"stop-{count}", source="test")


def heard(
    bus: LockstepBus, disturbance: Disturbance | None = None, sends: int = 40
) -> list[list[str]]:
    """Send one stop a tick, and list what each tick brought."""
    ears = bus.port(Party.BRIDGE).subscriber(keys.STOP)
    mouth = bus.port(Party.PLANNER).publisher(keys.STOP)
    if disturbance is not None:
        bus.disturb(disturbance)
    ticks: list[list[str]] = []
    for count in range(sends + 10):
        bus.tick += 1
        if count < sends:
            mouth.put(stop(count))
        items = ears.drain().items
        ticks.append([item.id for item in items if isinstance(item, Stop)])
    return ticks


def flat(ticks: list[list[str]]) -> list[str]:
    return [name for tick in ticks for name in tick]


def test_each_message_arrives_once_and_in_order_within_the_latency() -> None:
    ticks = heard(LockstepBus(1, {PAIR: (1, 2)}))
    assert flat(ticks) == [f"stop-{count}" for count in range(40)]
    for count in range(40):
        arrived = next(index for index, names in enumerate(ticks) if f"stop-{count}" in names)
        assert arrived - count in (1, 2)


def test_a_pair_without_latency_has_it_in_the_same_tick() -> None:
    assert heard(LockstepBus(1, {}))[0] == ["stop-0"]


def test_the_same_seed_delays_alike_and_another_does_not() -> None:
    first, again, other = (heard(LockstepBus(seed, {PAIR: (1, 5)})) for seed in (1, 1, 2))
    assert first == again
    assert first != other


def test_lost_messages_are_lost_and_doubled_ones_come_twice() -> None:
    assert flat(heard(LockstepBus(1, {}), Disturbance(drop=1.0))) == []
    twice = flat(heard(LockstepBus(1, {}), Disturbance(duplicate=1.0)))
    assert twice == [f"stop-{count}" for count in range(40) for _ in range(2)]


def test_a_delay_keeps_order_unless_overtaking_is_asked_for() -> None:
    late = flat(heard(LockstepBus(1, {}), Disturbance(delay_ticks=(0, 3))))
    assert late == sorted(late, key=lambda name: int(name.split("-")[1]))
    mixed = flat(heard(LockstepBus(1, {}), Disturbance(delay_ticks=(0, 3), reorder=True)))
    assert mixed != late
    assert sorted(mixed) == sorted(late)


def test_a_disturbance_spoils_only_the_keys_and_the_sender_that_it_names() -> None:
    assert len(flat(heard(LockstepBus(1, {}), Disturbance(keys=("cmd/grant",), drop=1.0)))) == 40
    assert len(flat(heard(LockstepBus(1, {}), Disturbance(sender=Party.BRIDGE, drop=1.0)))) == 40


def test_a_ring_keeps_the_newest_and_only_four_are_parsed() -> None:
    bus = LockstepBus(1, {})
    ears = bus.port(Party.BRIDGE).subscriber(keys.STOP)
    mouth = bus.port(Party.PLANNER).publisher(keys.STOP)
    for count in range(100):
        mouth.put(stop(count))
    drained = ears.drain()
    assert drained.arrived == keys.SEQUENCED
    names = [item.id for item in drained.items if isinstance(item, Stop)]
    assert names == [f"stop-{count}" for count in range(96, 100)]
    assert ears.drain().arrived == 0


def test_a_part_that_left_says_and_hears_nothing_but_what_it_said_still_comes() -> None:
    bus = LockstepBus(1, {PAIR: (2, 2)})
    ears = bus.port(Party.BRIDGE).subscriber(keys.STOP)
    gone = bus.port(Party.PLANNER)
    mouth = gone.publisher(keys.STOP)
    mouth.put(stop(1))
    gone.close()
    mouth.put(stop(2))
    bus.tick += 2
    assert [item.id for item in ears.drain().items if isinstance(item, Stop)] == ["stop-1"]


def test_what_is_no_message_is_refused_where_it_is_read() -> None:
    bus = LockstepBus(1, {})
    ears = bus.port(Party.BRIDGE).subscriber(keys.HEARTBEAT)
    beat = Heartbeat.model_construct(planner_id="p", epoch="a-1", seen=-1, used=0)
    bus.port(Party.PLANNER).publisher(keys.HEARTBEAT).put(beat)
    assert isinstance(ears.drain().items[0], DecodeFailure)
    bus.port(Party.PLANNER).publisher(keys.HEARTBEAT).put(beat)
    with pytest.raises(TypeError, match="cannot be sent"):
        ears.newest()
