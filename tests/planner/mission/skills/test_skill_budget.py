"""A search or a count ends with its metres and seconds, tells where it looked, and stands."""

from __future__ import annotations

from planner.mission.skills import DriveLeg, Fail, Finish, Observe, Way
from planner.mission.skills.skill_state import CountState
from tests.planner.mission.skills.looking import looking, thing


def test_a_search_ends_with_its_budget() -> None:
    for act in (looking("find", spent_m=56.0), looking("find", spent_s=541.0)):
        assert isinstance(act, Fail)
        assert act.reason == "not_found"
        assert act.said is not None
        assert "used up" in act.said.en


def test_no_way_is_begun_that_the_rest_of_the_budget_does_not_last_for() -> None:
    far = thing(x_m=8.0, room="kitchen")
    assert isinstance(looking("find", far, spent_m=40.0), DriveLeg)
    lost = looking("find", far, spent_m=54.0)
    assert isinstance(lost, Observe), "what is here costs no metres"
    assert isinstance(looking("find", thing(y_m=1.6), spent_m=54.0), DriveLeg), "a turn is no way"


def test_who_counts_begins_no_such_way_either_and_says_so() -> None:
    state, act = CountState(), looking("count")
    while not (isinstance(act, DriveLeg) and act.way is Way.ROUTE):  # until another room is due
        state = act.then or state
        act = looking("count", state=state)
    told = looking("count", state=state, spent_m=54.9)
    assert isinstance(told, Finish)
    assert told.said is not None
    assert "used up" in told.said.en
