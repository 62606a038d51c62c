"""A planner that believes in another robot, fence or map is told so, and what to do about it."""

from __future__ import annotations

import pytest

from tests.bridge.core.scripted import World
from wire import PROTOCOL, Hello


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
    assert world.planner is not None
    plain = world.planner.hello

    def changed(status: object) -> Hello:
        return plain(status).model_copy(update={field: came})  # type: ignore[arg-type]

    world.planner.hello = changed  # type: ignore[method-assign]
    world.ready()
    world.run(0.5)
    assert world.state.ownership.owner is None
    assert world.status is not None
    (answer,) = [item for item in world.status.answers if item.kind == "hello"]
    assert (answer.accepted, answer.code) == (False, code)
    assert f"came {came}, expected " in answer.detail
    assert to_do in answer.detail
