"""Hold the planner's door to its law: while it drives, a stop word leaves no robot driving.

The real door, engine, brain, bridge and physics in lockstep; only a plan made of the sentence, and
accepted, may move the robot on.
"""

from __future__ import annotations

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from planner.plan import GoalState
from tests.planner.language.laws.test_stop_laws import chinese, english
from tests.tools.lockstep.test_drives import Driving, off

__all__ = ["off"]
STANDS_WITHIN_S = 3.0


@given(st.data())
@settings(
    max_examples=max(12, settings().max_examples // 4),
    suppress_health_check=[HealthCheck.function_scoped_fixture],
    deadline=None,
)
def test_no_sentence_with_a_stop_word_leaves_the_robot_driving(
    off: Driving, data: st.DataObject
) -> None:
    world, goal = off()
    text = data.draw(english() | chinese())
    said = world.say(text)
    world.run_until(lambda w: w.standing, STANDS_WITHIN_S)
    assert world.status.held is not None, text
    assert goal.state is GoalState.PAUSED, text
    world.run(1.0)
    assert world.standing, text
    assert said.state in {GoalState.SUCCEEDED, GoalState.AWAITING_CONFIRMATION}, text


def test_words_that_make_no_plan_leave_the_hold_of_a_stop(off: Driving) -> None:
    world, goal = off()
    world.say("停")
    world.run_until(lambda w: w.standing and w.status.held is not None, STANDS_WITHIN_S)
    for text in ("emergency brake", "what is that?", "frobnicate", "don't go away", "你好"):
        world.say(text)
        world.run(0.5)
        assert world.status.held is not None, text
        assert world.standing, text
    assert goal.state is GoalState.PAUSED
    again = world.say("go to the living room")
    world.run_until(lambda w: w.status.held is None and not w.standing, 10.0)
    assert again.state is GoalState.RUNNING


def test_slow_down_halves_the_cap_of_what_runs(off: Driving) -> None:
    world, goal = off()
    world.run(3.0)
    before_mps = abs(world.status.measured.v_mps)
    said = world.say("slow down please")
    world.run(2.0)
    assert said.state is GoalState.SUCCEEDED
    assert goal.state is GoalState.RUNNING
    waypoints = world.planner.book.missions[goal.id].speed_share
    assert waypoints == 0.5
    assert abs(world.status.measured.v_mps) <= 0.5 * 0.5 + 0.02 < before_mps
