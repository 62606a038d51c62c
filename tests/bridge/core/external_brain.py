"""Be another brain, which steers by velocity."""

from __future__ import annotations

from dataclasses import replace

from tests.bridge.core.fake_planner import FakePlanner
from tests.bridge.core.scripted import World
from wire import Velocity


def external_world() -> World:
    """Arm a world that an external brain owns and has a grant in."""
    planner = FakePlanner(planner_id="x1", mission="m1")
    planner.next_horizon_s = 1e9
    world = World(planner=planner)
    hello = planner.hello

    def as_external(status: object) -> object:
        return hello(status).model_copy(update={"kind": "external"})  # type: ignore[arg-type]

    planner.hello = as_external  # type: ignore[method-assign,assignment]
    world.armed()
    world.run(0.3)
    assert world.state.ownership.owner is not None
    assert world.state.ownership.owner.kind == "external"
    assert world.state.grants.mission == "m1"
    return world


def say(
    world: World, v_mps: float, w_radps: float = 0.0, *, held: bool = True, seq: int | None = None
) -> None:
    status = world.shown
    world.ids += 1
    velocity = Velocity(
        source_id="x1",
        epoch=status.epoch,
        seq=world.ids if seq is None else seq,
        seen=status.seq,
        v_mps=v_mps,
        w_radps=w_radps,
        dead_man=held,
    )
    world.extra = replace(world.extra, external=(velocity,))


def drive_for(world: World, seconds: float, v_mps: float = 0.3, w_radps: float = 0.0) -> None:
    for _ in range(round(seconds / 0.05)):
        say(world, v_mps, w_radps)
        world.run(0.05)
