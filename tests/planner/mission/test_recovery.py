"""The ladder's bounds, and what is remembered of shut ways, for any history."""

from __future__ import annotations

from math import hypot

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.mission import recovery
from planner.navigation.obstruction import Obstruction
from planner.navigation.route import WIDE_M
from wire import Pose2

HERE = (1.0, 1.0)
spots = st.tuples(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0))


def across(x_m: float, y_m: float) -> Obstruction:
    return Obstruction((x_m, y_m - 0.25), (x_m, y_m + 0.25))


def test_the_ladder_ends_after_about_25_s_and_backs_no_farther_than_the_bridge_allows() -> None:
    waits = sum(rung.seconds for rung in recovery.LADDER if rung.recovery is recovery.Recovery.WAIT)
    moves = sum(
        rung.seconds * max(1, len(rung.turns_rad))
        for rung in recovery.LADDER
        if rung.metres or rung.turns_rad
    )
    assert waits + moves <= 25.0
    assert recovery.LADDER[-1].recovery is recovery.Recovery.GIVE_UP
    assert all(rung.metres <= 0.3 and rung.speed_mps <= 0.1 for rung in recovery.LADDER)
    assert all(rung.metres <= rung.speed_mps * rung.seconds for rung in recovery.LADDER)


@given(spots, spots)
def test_a_robot_that_got_nowhere_stays_on_its_ladder(
    a: tuple[float, float], b: tuple[float, float]
) -> None:
    first = recovery.begin_ladder(recovery.FRESH, a)
    climbed = first.model_copy(update={"rung": 3})
    after = recovery.begin_ladder(climbed, b)
    far = hypot(a[0] - b[0], a[1] - b[1]) >= recovery.NEW_LADDER_M
    assert (after.rung, after.ladders) == ((0, 2) if far else (3, 1))


@given(st.lists(spots, max_size=40))
def test_no_history_climbs_for_ever(held_at: list[tuple[float, float]]) -> None:
    """Wherever it is held, again and again, the end of the last ladder is to give up."""
    record, rungs = recovery.FRESH, 0
    for spot in held_at:
        record = recovery.begin_ladder(record, spot)
        while recovery.rung_of(record).recovery is not recovery.Recovery.GIVE_UP:
            record = record.model_copy(update={"rung": record.rung + 1})
            rungs += 1
    assert rungs <= (recovery.MAX_LADDERS + 1) * len(recovery.LADDER)


def test_what_was_driven_for_recoveries_ends_them() -> None:
    assert recovery.rung_of(recovery.FRESH).recovery is recovery.Recovery.WAIT
    spent = recovery.FRESH.model_copy(update={"metres": recovery.MAX_RECOVERY_M + 0.1})
    assert recovery.rung_of(spent).recovery is recovery.Recovery.GIVE_UP
    nonsense = recovery.FRESH.model_copy(update={"metres": float("nan")})
    assert recovery.rung_of(nonsense).recovery is recovery.Recovery.GIVE_UP


def test_a_way_is_shut_for_a_minute_and_after_two_visits_until_it_is_seen_open() -> None:
    record = recovery.note_obstruction(
        recovery.begin_ladder(recovery.FRESH, HERE), across(2.0, 1.0), 100.0
    )
    assert recovery.shut_now(record, 100.0 + recovery.MEMORY_S) == (across(2.0, 1.0),)
    assert recovery.shut_now(record, 100.1 + recovery.MEMORY_S) == ()
    assert recovery.shut_now(record, 0.0) == (across(2.0, 1.0),), (
        "a clock that was set back forgets nothing"
    )
    again = recovery.note_obstruction(
        recovery.begin_ladder(record, (4.0, 1.0)), across(2.1, 1.1), 400.0
    )
    assert again.newest is not None
    assert (again.newest.visits, again.newest.since_unix_s) == (recovery.MAX_VISITS, 100.0)
    assert recovery.shut_now(again, 1e9) == (across(2.1, 1.1),)
    assert recovery.shut_now(recovery.note_open(again, again.shut[0]), 400.0) == ()


def test_seen_again_from_the_same_ladder_is_the_same_visit() -> None:
    record = recovery.begin_ladder(recovery.FRESH, HERE)
    for at_s in range(20):
        record = recovery.note_obstruction(record, across(2.0, 1.0 + 0.01 * at_s), 100.0 + at_s)
    assert record.newest is not None
    assert (len(record.shut), record.newest.visits) == (1, 1)


@given(st.lists(spots, max_size=60))
def test_the_memory_is_bounded(spots_seen: list[tuple[float, float]]) -> None:
    record = recovery.FRESH
    for at_s, (x_m, y_m) in enumerate(spots_seen):
        record = recovery.note_obstruction(record, across(x_m, y_m), float(at_s))
    assert len(record.shut) <= recovery.MAX_SHUT
    assert type(record).model_validate_json(record.model_dump_json()) == record


@pytest.mark.parametrize(("ladders", "times"), [(1, 1), (2, 1), (3, 2), (4, 3), (5, 4), (12, 4)])
def test_who_meets_another_one_again_and_again_stands_aside_longer(
    ladders: int, times: int
) -> None:
    """Two that come back to a door within the 8 s that one needs in it meet there again."""
    waits = []
    for at_mm in range(200):
        record = recovery.begin_ladder(recovery.FRESH, (0.001 * at_mm, 0.0)).model_copy(
            update={"ladders": ladders}
        )
        other = recovery.note_obstruction(
            record, across(2.0, 1.0), 100.0, moves=True, radius_m=WIDE_M + 0.02
        )
        waits.append(recovery.aside_s(other))
    assert min(waits) == pytest.approx(recovery.PASSING_S, abs=1.0)
    assert max(waits) == pytest.approx(recovery.PASSING_S + times * recovery.WIDE_S[1], abs=1.0)


def test_a_moved_goal_is_the_goals_own() -> None:
    goal = Pose2(3.0, 1.0, 0.5)
    record = recovery.FRESH.model_copy(update={"goal": (3.0, 1.0), "goal_moved": (2.6, 1.0)})
    assert record.aim(goal) == Pose2(2.6, 1.0, 0.5)
    assert record.aim(Pose2(3.0, 2.0, 0.5)) == Pose2(3.0, 2.0, 0.5)
    assert recovery.FRESH.aim(goal) == goal
