"""An order's number and keys are its own for ever: no other order or request takes its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.mission.errors import ReservedKey
from planner.mission.state import RESERVED_KEYS
from planner.orders.order import key_of
from planner.plan import GoalState
from planner.state_database import StateDatabase
from tests.planner.orders.fakes import MovedClocks, kept_in
from tests.planner.orders.test_with_missions import home, told


async def test_a_new_order_is_done_though_the_newest_one_was_removed(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    first = await kept.give("in 20 seconds say hello")
    await kept.run_s(21.0)
    kept.missions.end("goal-1")
    await kept.run_s(1.0)
    await kept.orders.intake.remove(first.id)
    second = await kept.give("in 20 seconds go to the kitchen")
    await kept.run_s(21.0)
    assert (first.id, second.id) == ("o1", "o2")
    assert [text for _, text, *_ in kept.missions.given] == ["say hello", "go to the kitchen"]


@pytest.mark.parametrize("old", [False, True], ids=["now", "older tables"])
async def test_a_number_is_not_used_again_by_a_later_program(tmp_path: Path, old: bool) -> None:
    clock = MovedClocks()
    kept = await kept_in(tmp_path, clock)
    await kept.give("every hour say hello")
    await kept.give("every hour go to the kitchen")
    database = StateDatabase(tmp_path)
    if old:  # as tables were before numbers were marked
        with database.change() as connection:
            connection.execute("DELETE FROM order_facts WHERE name = 'last_number'")
    database.close()
    later = await kept_in(tmp_path, clock)
    await later.orders.intake.remove("o2")
    newest = await kept_in(tmp_path, clock)
    assert (await newest.give("every hour say bye")).id == "o3"


async def test_a_number_is_known_from_the_goals_of_an_order_that_older_tables_forgot(
    tmp_path: Path,
) -> None:
    kept = await kept_in(tmp_path)
    kept.missions.put("goal-1", "say hello", GoalState.PAUSED, "order:o7")
    again = await kept_in(tmp_path, kept.clock, kept.missions)
    assert (await again.give("every hour say bye")).id == "o8"


async def test_an_order_of_an_older_program_gets_keys_of_its_own(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    order = await kept.give("every hour say hello")
    database = StateDatabase(tmp_path)
    old = order.model_copy(update={"nonce": ""})
    with database.change() as connection:
        connection.execute("UPDATE standing_orders SET record = ?", (old.model_dump_json(),))
    database.close()
    again = await kept_in(tmp_path, kept.clock)
    again = await kept_in(tmp_path, kept.clock)  # the key is written down, too
    again.missions.keys[key_of(old, 1)] = "claimed before"
    await again.run_s(3601.0)
    [(_, text, key, _)] = again.missions.given
    assert text == "say hello"
    assert key == key_of(again.orders.keeper.book.orders["o1"], 1) != key_of(old, 1)


async def test_the_keys_of_two_orders_and_of_two_homes_differ(tmp_path: Path) -> None:
    homes = [await kept_in(tmp_path / name) for name in ("a", "b")]
    orders = [await kept.give(f"every hour say {i}") for kept in homes for i in (1, 2)]
    assert len({key_of(order, 1) for order in orders}) == 4
    assert all(key_of(order, 1).startswith(RESERVED_KEYS) for order in orders)


@pytest.mark.parametrize("key", ["standing-order:o1:1", "standing-order:"])
async def test_no_request_claims_a_key_of_a_standing_order(tmp_path: Path, key: str) -> None:
    async with home(tmp_path) as made:
        missions = made.together.missions
        with pytest.raises(ReservedKey) as refused:
            await missions.submit("say hi", idempotency_key=key)
        assert refused.value.code == "idempotency_reserved"
        assert key in refused.value.message.zh
        assert missions.loop.book.missions == {}
        stopped = await missions.submit("stop", idempotency_key=key)  # a stop always counts
        assert "top" in told(stopped)
