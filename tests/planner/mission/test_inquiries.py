"""Check that a question about the picture ends with whoever asked, and can't end the planner."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import replace
from typing import cast

import pytest

from planner.mission.activity import Activity, AskingImage, Driving, Observing
from planner.mission.effects import AskEyes
from planner.mission.events import Told
from planner.mission.perception_requests import EyeDoor
from planner.mission.reducer import asked_about_picture
from planner.mission.skills import AskImage, DriveLeg, Observe
from planner.mission.skills.perception import ImageAnswer
from planner.mission.state import MissionState
from planner.mission.tasks import Answers, MissionTasks, RouteService, Think
from planner.plan import Language, say_same
from tests.planner.mission.fakes import FACTS
from tests.planner.perception.watching import World
from wire import Pose2

Door = Callable[[AskEyes], Awaitable[Told]]


class Asking:
    """Hold helpers whose eyes are a function, and what came of them."""

    def __init__(self, door: Door) -> None:
        self.told: list[Told] = []
        self.broken: list[BaseException] = []
        nobody = cast("Think", None), cast("RouteService", None)
        answers = Answers(
            planned=lambda _: None,
            routed=lambda *_: None,
            obstacles=lambda: (),
            told=self.told.append,
            broken=self.broken.append,
        )
        eyes = EyeDoor(None)
        eyes.ask = door  # type: ignore[method-assign,assignment]  # another way to see
        self.helpers = MissionTasks(*nobody, answers, eyes)

    async def ask(self, ticket: int) -> None:
        """Ask, and let it begin."""
        self.helpers.help(AskEyes("g1", ticket, Language.EN, "what is there?"))
        await asyncio.sleep(0)


def answered(ask: AskEyes) -> Told:
    return Told(ask.id, ask.ticket, ImageAnswer(text=say_same("a sofa")))


def test_a_question_nobody_waits_for_is_cancelled_at_once() -> None:
    ended: list[int] = []

    async def hang(ask: AskEyes) -> Told:
        try:
            await asyncio.Event().wait()
        finally:
            ended.append(ask.ticket)
        return answered(ask)

    async def story() -> Asking:
        asking = Asking(hang)
        await asking.ask(1)
        asking.helpers.await_answer(1)
        await asyncio.sleep(0)
        assert ended == [], "it is waited for"
        await asking.ask(2)
        asking.helpers.await_answer(2)
        await asyncio.sleep(0)
        assert ended == [1]
        asking.helpers.await_answer(None)
        await asyncio.sleep(0)
        assert ended == [1, 2]
        await asking.helpers.close()
        return asking

    asking = asyncio.run(story())
    assert (asking.told, asking.broken) == ([], [])


def test_an_answer_is_told_and_a_fault_of_the_eyes_is_one() -> None:
    async def see(ask: AskEyes) -> Told:
        if ask.ticket == 2:
            raise ZeroDivisionError("a fault of ours")
        return answered(ask)

    async def story() -> Asking:
        asking = Asking(see)
        for ticket in (1, 2):
            await asking.ask(ticket)
        await asyncio.sleep(0)
        await asking.helpers.close()
        return asking

    asking = asyncio.run(story())
    assert [told.answer for told in asking.told] == [
        ImageAnswer(text=say_same("a sofa")),
        ImageAnswer(failure="unavailable"),
    ]
    assert asking.broken == [], "the mission loop goes on"


@pytest.mark.parametrize(
    ("activity", "ticket"),
    [
        (None, None),
        (AskingImage(record=1, act=AskImage(), since_s=0.0, ticket=7, until_s=9.0), 7),
        (
            Driving(
                record=1,
                act=DriveLeg(Pose2(1.0, 0.0, 0.0), heading=False),
                since_s=0.0,
                asked_s=0.0,
                ticket=7,
            ),
            None,
        ),
        (Observing(record=1, act=Observe(3), since_s=0.0, asked_s=0.0, until_s=9.0), None),
    ],
)
def test_the_activity_tells_which_question_waits(
    activity: Activity | None, ticket: int | None
) -> None:
    assert asked_about_picture(MissionState(FACTS, activity=activity)) == ticket


def test_a_pixel_counts_in_the_picture_that_was_wanted_for_it() -> None:
    """Nobody wants pictures, so the camera rests, until a plan is asked for."""

    async def story() -> tuple[ImageAnswer, ImageAnswer]:
        world = World()
        world.blindfold()
        await world.film(1.0)
        door = EyeDoor(world.eyes)
        door.note("g1")
        await asyncio.sleep(0)
        await world.film(0.6)
        world.detector.failure = None
        ask = AskEyes("g1", 1, Language.EN, "", False, 500, 900)
        told = asyncio.create_task(door.ask(ask))
        await world.film(0.5)
        other = asyncio.create_task(door.ask(replace(ask, id="g2")))
        await world.film(0.5)
        return (await told).answer, (await other).answer

    noted, never = asyncio.run(asyncio.wait_for(story(), 20.0))
    assert noted.at is not None
    assert noted.at[0] == pytest.approx(2.0, abs=0.3)
    assert never.failure == "point_no_pose"
