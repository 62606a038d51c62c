"""Let messages of one tick arrive in every order: the decision is the same.

The wire drains by key, in one fixed order, so between keys the order of arrival must not matter.
Bytes go through the real link on the lockstep bus; each order is one step from the same state.
"""

from __future__ import annotations

from itertools import combinations, permutations
from typing import TYPE_CHECKING, cast

import pytest

from bridge.core import ON_TIME, Decision, step
from bridge.link import BridgeLink
from tests.bridge.core.fake_planner import MAP_ID, PERIOD_S
from tests.bridge.core.reached import reached
from tests.bridge.core.scripted import World
from tools.lockstep import LockstepBus
from wire import (
    VIRTUAL_KEY,
    Grant,
    Heartbeat,
    OpRequest,
    Record,
    Stop,
    Velocity,
    keys,
    sign,
)
from wire.keys import Key, Party

if TYPE_CHECKING:
    from wire.session import Session

Said = tuple[Key[Record], Record]


def op(world: World, kind: str, key: Key[OpRequest]) -> Said:
    status = world.shown
    proof = sign(VIRTUAL_KEY, kind, "r1", status.nonce, f"{kind}-1")  # type: ignore[arg-type]  # kinds come from the list below
    request = OpRequest(id=f"{kind}-1", source="test", proof=proof)
    return cast("Key[Record]", key), request


def messages(world: World) -> list[Said]:
    """Return one message of each kind, all of them to be obeyed."""
    status, planner = world.shown, world.brain
    mission = status.grant.mission if status.grant is not None else "m2"
    beat = Heartbeat(
        planner_id=planner.planner_id, epoch=status.epoch, seen=status.seq, used=status.seq
    )
    grant = Grant(
        planner_id=planner.planner_id,
        epoch=status.epoch,
        seen=status.seq,
        mission=mission,
        metres=5.0,
        seconds=9.0,
    )
    stick = Velocity(
        source_id="stick",
        epoch=status.epoch,
        seq=1,
        seen=status.seq,
        v_mps=0.0,
        w_radps=0.0,
        dead_man=False,
    )
    planner.mission = mission
    horizon = planner.horizon(status)
    assert horizon.map_id == MAP_ID
    return [
        (cast("Key[Record]", keys.STOP), Stop(id="s1", source="test")),
        op(world, "arm", keys.ARM),
        op(world, "disarm", keys.DISARM),
        op(world, "resume", keys.RESUME),
        (cast("Key[Record]", keys.HELLO), planner.hello(status)),
        (cast("Key[Record]", keys.GRANT), grant),
        (cast("Key[Record]", keys.HEARTBEAT), beat),
        (cast("Key[Record]", keys.LOCALIZATION), world._localization()),
        (cast("Key[Record]", keys.TELEOP), stick),
        (cast("Key[Record]", keys.WAYPOINTS), horizon),
        (cast("Key[Record]", keys.SCAN), world._scan()),
    ]


class Door:
    """Be the bridge's link and everybody who talks to it, for one tick at a time."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.bus = LockstepBus(1, {})
        self.link = BridgeLink(cast("Session", self.bus.port(Party.BRIDGE)), "r1", VIRTUAL_KEY)
        others = self.bus.port(Party.PLANNER)
        self.publishers = {
            key.path: others.publisher(key) for key, _ in messages(reached("active"))
        }
        world.now_s += PERIOD_S
        self.drive = (world.drive.tick(world.now_s),)

    def decide(self, order: tuple[Said, ...]) -> Decision:
        self.bus.tick += 1
        for key, message in order:
            self.publishers[key.path].put(message)
        chance = f"{self.world.state.tick:016x}"
        inbox = self.link.drain(self.drive, ON_TIME, real_time=True, chance=chance)
        assert not inbox.rejected
        return step(self.world.core, self.world.state, inbox, self.world.now_s)


@pytest.mark.nightly(keep=4)
@pytest.mark.parametrize("start", ["disarmed", "hold_granted", "active", "stopping_by_person"])
@pytest.mark.parametrize("count", [2, 3, 4])
def test_the_order_of_arrival_between_kinds_changes_nothing(start: str, count: int) -> None:
    world = reached(start)
    said = messages(world)
    door = Door(world)
    sets = list(combinations(said, count))
    for chosen in sets if count < 4 else sets[:: 11 if start == "active" else 23]:
        first, *others = permutations(chosen)
        expected = door.decide(first)
        for order in others:
            assert door.decide(order) == expected, [key.path for key, _ in order]


def test_five_kinds_in_all_their_orders_and_the_stop_wins_in_each() -> None:
    world = reached("active")
    said = {key.path: (key, message) for key, message in messages(world)}
    paths = ("cmd/stop", "op/resume", "cmd/grant", "cmd/heartbeat", "cmd/waypoints")
    door = Door(world)
    decisions = [door.decide(order) for order in permutations(said[path] for path in paths)]
    assert len(decisions) == 120
    assert all(decision == decisions[0] for decision in decisions)
    after = decisions[0].state
    assert after.held is not None
    assert after.grants.mission is None
    assert after.mode.value == "STOPPING"


def test_heartbeats_of_one_tick_count_as_the_newest_of_them() -> None:
    world = reached("active")
    status = world.shown
    beats = [
        (
            cast("Key[Record]", keys.HEARTBEAT),
            Heartbeat(
                planner_id="p1", epoch=status.epoch, seen=status.seq - back, used=status.seq - back
            ),
        )
        for back in range(4)
    ]
    door = Door(world)
    decisions = [door.decide(order) for order in permutations(beats)]
    assert all(decision == decisions[0] for decision in decisions)
