"""A goal tells by what door it came, what was answered to it, and who stopped it; a restart too."""

from __future__ import annotations

from pathlib import Path

from planner.mission.events import Confirm, Reply, Resume, Stopped, Submitted
from planner.mission.journal_records import read_mission
from planner.mission.state import MAX_ANSWERS
from planner.plan import Ask, GoalState, Language, StepPlan
from planner.site import Site
from tests.planner.mission.driving import SUCCEEDED
from tests.planner.mission.live import KITCHEN, planner, run
from tests.planner.mission.lockstep import go
from tests.planner.mission.rethinking import Rethinking
from tests.planner.mission.test_mission_dialogue import which


def test_what_was_answered_stays_beside_its_question_and_survives_the_journal() -> None:
    ask = StepPlan(steps=(Ask(question="Shall I go on?"),))
    world = Rethinking(thoughts=[which("Which room?"), ask])
    world.run(0.2)
    goal = world.give(None)
    world.event(Reply(goal, "the one with the bed", "page"))
    world.run(0.2)
    world.event(Reply(goal, "yes", "voice"))
    world.run_until(goal, SUCCEEDED)
    kept = read_mission(world.goal(goal).model_dump_json())
    told = [(a.asked.en if a.asked else "", a.said, a.by) for a in kept.answers]
    assert told == [
        ("Which room?", "the one with the bed", "page"),
        ("Shall I go on?", "yes", "voice"),
    ]
    assert kept.answers[0].unix_s < kept.answers[1].unix_s


def test_a_yes_by_a_button_has_no_words_and_answers_are_bounded() -> None:
    world = Rethinking(thoughts=[go("kitchen")])
    world.run(0.2)
    goal = world.give(None, confirm=True)
    for _ in range(2 * MAX_ANSWERS):
        world.event(Reply(goal, "perhaps", "cli"))
    assert len(world.goal(goal).answers) == MAX_ANSWERS
    world.event(Confirm(goal, "page"))
    assert [(a.said, a.by) for a in world.goal(goal).answers][-2:] == [
        ("perhaps", "cli"),
        (None, "page"),
    ]


def test_a_stopped_goal_tells_who_stopped_it_until_it_goes_on(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN) as world:
            goal = await world.missions.submit("go to the kitchen", by="cli")
            await world.reach(goal.id, GoalState.RUNNING)
            await world.missions.stop("page")
            stopped = world.missions.goal(goal.id)
            assert (stopped.by, stopped.stopped_by, stopped.reason) == ("cli", "page", "stop")
            await world.missions.resume(goal.id)
            assert world.missions.goal(goal.id).stopped_by is None

    run(story())


def test_a_sentence_that_stops_tells_its_door_too() -> None:
    world = Rethinking(thoughts=[go("kitchen")])
    world.run(0.2)
    goal = world.give(None)
    world.event(Submitted("s", "stop", Language.EN, stop=True, by="voice"))
    assert world.goal(goal).stopped_by == "voice"
    world.event(Resume(goal))
    world.event(Stopped("cli"))
    assert world.goal(goal).stopped_by == "cli"
