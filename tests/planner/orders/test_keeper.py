"""Orders fire once, are written down before, are told when missed, keep their numbers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from planner.mission.errors import QueueFull, ReservedKey
from planner.mission.state import RESERVED_KEYS
from planner.orders.errors import OrderRefusal
from planner.orders.order import FiringState, key_of
from planner.plan import GoalState, QuietHours
from planner.state_database import StateDatabase, StateUnavailable
from tests.planner.orders.fakes import NOON_UNIX_S, FakeMissions, MovedClocks, kept_in
from tests.planner.orders.test_with_missions import home, told
from wire import HeldReason, Mode, StandingHold


async def test_an_order_fires_at_its_time_and_once(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    order = await kept.give("every day at 12:10 go to the kitchen")
    await kept.run_s(599.0)
    assert kept.missions.given == []
    await kept.run_s(2.0)
    assert [(text, source) for _, text, _, source in kept.missions.given] == [
        ("go to the kitchen", f"order:{order.id}")
    ]
    kept.missions.end("goal-1")
    await kept.run_s(120.0)
    [firing] = await kept.orders.keeper.history(order.id, 10)
    assert (firing.state, firing.goal, firing.code) == (FiringState.ENDED, "goal-1", "done")
    assert 0.0 <= firing.at_unix_s - firing.due_unix_s <= 1.0
    assert len(kept.missions.given) == 1


async def test_the_newest_runs_of_all_orders_are_told_together(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    assert await kept.orders.keeper.newest(10) == ()
    first = await kept.give("every day at 12:10 go to the kitchen")
    second = await kept.give("every day at 12:20 go to the kitchen")
    await kept.run_s(601.0)
    kept.missions.end("goal-1")
    await kept.run_s(601.0)
    newest = await kept.orders.keeper.newest(10)
    assert [firing.order for firing in newest] == [second.id, first.id]
    assert [firing.order for firing in await kept.orders.keeper.newest(1)] == [second.id]


async def test_a_reminder_is_said_and_told(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    order = await kept.give("remind me in 20 minutes to take the cake out")
    await kept.run_s(1201.0)
    assert [text for _, text, _, _ in kept.missions.given] == ["say “take the cake out”"]
    assert kept.missions.told() == [("reminder", "reminder")]
    assert kept.orders.intake.find(order.id).ended


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"mode": Mode.DISARMED}, "disarmed"),
        ({"mode": Mode.ESTOPPED}, "estop"),
        ({"mode": Mode.FAULT}, "fault"),
        ({"mode": Mode.TELEOP}, "teleop"),
        ({"held": StandingHold(id="h1", reason=HeldReason.STOP)}, "held"),
    ],
)
async def test_nothing_fires_while_the_robot_may_not_move(
    tmp_path: Path, changes: dict[str, Any], why: str
) -> None:
    kept = await kept_in(tmp_path)
    order = await kept.give("every day at 12:01 go to the kitchen")
    kept.missions.say_status(**changes)
    await kept.run_s(100.0)
    assert kept.missions.given == []
    assert kept.missions.told() == [("missed", why)]
    [firing] = await kept.orders.keeper.history(order.id, 10)
    assert (firing.state, firing.reason) == (FiringState.MISSED, why)
    kept.missions.say_status()
    await kept.run_s(100.0)
    assert kept.missions.given == []  # it is not caught up


async def test_a_pause_by_a_person_keeps_orders_waiting_until_the_next_order(
    tmp_path: Path,
) -> None:
    kept = await kept_in(tmp_path)
    await kept.give("every 10 minutes say hello")
    kept.missions.put("mine", "go to the study", GoalState.PAUSED)
    kept.missions._book.missions["mine"] = kept.missions._book.missions["mine"].model_copy(
        update={"reason": "operator"}
    )
    await kept.run_s(601.0)
    assert kept.missions.told() == [("missed", "paused")]
    kept.missions.put("next", "go to the kitchen", GoalState.SUCCEEDED)
    await kept.run_s(601.0)
    assert len(kept.missions.given) == 1


async def test_a_silent_bridge_is_waited_for_after_a_start_and_told_later(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await kept.give("every day at 12:00 say hello")  # tomorrow
    await kept.give("in 5 minutes say hello")
    kept.missions.silent = True
    await kept.run_s(301.0)
    assert kept.missions.told() == [("missed", "bridge_silent")]


async def test_a_run_is_missed_while_the_last_one_goes_on(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await kept.give("every 5 minutes go to the kitchen")
    await kept.run_s(601.0)
    assert len(kept.missions.given) == 1
    assert kept.missions.told() == [("missed", "still_running")]


async def test_a_paused_goal_of_an_order_gives_way_to_its_next_run(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await kept.give("every 5 minutes go to the kitchen")
    await kept.run_s(301.0)
    kept.missions.end("goal-1", GoalState.PAUSED)
    await kept.run_s(300.0)
    assert kept.missions.cancelled == ["goal-1"]
    assert len(kept.missions.given) == 2


async def test_what_is_due_while_the_planner_is_off_is_told_in_one_word(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    order = await kept.give("every hour go to the kitchen")
    await kept.turn()
    clock = kept.clock
    clock.pass_s(5 * 3600.0 + 100.0)
    clock.monotonic_s = 7.0  # another boot
    again = await kept_in(tmp_path, clock)
    await again.run_s(10.0)
    assert again.missions.given == []
    assert again.missions.told() == [("missed", "was_off")]
    [firing] = await again.orders.keeper.history(order.id, 10)
    assert firing.count == 5
    await again.run_s(3600.0)
    assert len(again.missions.given) == 1


async def test_a_firing_that_was_cut_off_before_its_goal_is_told_and_not_begun(
    tmp_path: Path,
) -> None:
    kept = await kept_in(tmp_path)
    order = await kept.give("every day at 12:01 go to the kitchen")

    async def die(*_: Any) -> str:
        raise KeyboardInterrupt

    kept.missions.give = die  # type: ignore[method-assign, assignment]
    with pytest.raises(KeyboardInterrupt):
        await kept.run_s(61.0)
    again = await kept_in(tmp_path, kept.clock)
    await again.run_s(200.0)
    assert again.missions.given == []
    assert again.missions.told() == [("missed", "interrupted")]
    [firing] = await again.orders.keeper.history(order.id, 10)
    assert firing.reason == "interrupted"


async def test_a_firing_that_was_cut_off_after_its_goal_is_found_again(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    order = await kept.give("every day at 12:01 go to the kitchen")

    give_goal = kept.missions.give

    async def die(*given: Any) -> str:
        await give_goal(*given)
        raise KeyboardInterrupt

    kept.missions.give = die  # type: ignore[method-assign, assignment]
    with pytest.raises(KeyboardInterrupt):
        await kept.run_s(61.0)
    again = await kept_in(tmp_path, kept.clock, kept.missions)
    await again.run_s(10.0)
    again.missions.end("goal-1")
    await again.run_s(1.0)
    [firing] = await again.orders.keeper.history(order.id, 10)
    assert (firing.state, firing.code) == (FiringState.ENDED, "done")
    assert len(again.missions.given) == 1


async def test_what_can_not_be_written_down_does_not_fire(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = await kept_in(tmp_path)
    await kept.give("in 5 minutes go to the kitchen")

    def full(*_: Any) -> None:
        raise StateUnavailable(tmp_path, OSError(28, "No space left on device"))

    monkeypatch.setattr(kept.orders.keeper._store, "keep", full)
    await kept.run_s(310.0)
    assert kept.missions.given == []
    assert kept.missions.told() == [("missed", "orders_unwritable")]
    with pytest.raises(OrderRefusal) as refused:
        await kept.give("every day at eight say hello")
    assert refused.value.code == "orders_unwritable"


async def test_a_full_queue_is_told(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    order = await kept.give("in 5 minutes go to the kitchen")
    kept.missions.refusal = QueueFull(33)
    await kept.run_s(301.0)
    assert kept.missions.told() == [("missed", "queue_full")]
    assert kept.orders.intake.find(order.id).missed == 1


async def test_quiet_hours_leave_out_what_comes_again_and_not_what_was_asked_for(
    tmp_path: Path,
) -> None:
    quiet = QuietHours(12 * 60, 13 * 60)
    kept = await kept_in(tmp_path, quiet=quiet)
    again = await kept.give("every 30 minutes say hello")
    await kept.give("remind me in 40 minutes")
    await kept.run_s(3599.0)
    assert [text for _, text, _, _ in kept.missions.given] == ["say “the time has come”"]
    assert kept.missions.told() == [("reminder", "reminder")]
    [left_out] = await kept.orders.keeper.history(again.id, 10)
    assert (left_out.state, left_out.count) == (FiringState.QUIET, 1)
    await kept.run_s(2.0)
    assert len(kept.missions.given) == 2


async def test_a_paused_order_is_not_due_and_goes_on_when_resumed(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    order = await kept.give("every 10 minutes say hello")
    await kept.orders.intake.pause(order.id)
    await kept.run_s(1300.0)
    await kept.orders.intake.pause(order.id, paused=False)
    await kept.run_s(400.0)
    assert kept.missions.told() == []
    assert len(kept.missions.given) == 0
    await kept.run_s(200.0)
    assert len(kept.missions.given) == 1


async def test_a_goal_that_waits_for_a_word_is_told(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await kept.give("in 5 minutes go to the kitchen")
    await kept.run_s(301.0)
    kept.missions.end("goal-1", GoalState.AWAITING_CONFIRMATION)
    await kept.run_s(2.0)
    assert kept.missions.told() == [("asks", "done")]


async def test_a_clock_behind_what_was_written_down_is_not_believed_at_once(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await kept.give("every day at 12:30 say hello")
    await kept.turn()
    clock = MovedClocks(NOON_UNIX_S - 86_400.0 + 1700.0, 3.0)  # no battery behind its clock
    again = await kept_in(tmp_path, clock, FakeMissions(clock))
    await again.run_s(300.0)  # by this clock it is 12:33, yesterday
    assert again.missions.given == []
    clock.unix_s = NOON_UNIX_S + 1790.0  # set by the network
    await again.run_s(20.0)
    assert len(again.missions.given) == 1


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
