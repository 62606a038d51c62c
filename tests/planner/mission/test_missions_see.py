"""The missions' door with eyes on a real event loop: who is asked about which picture, and when."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from planner.brain.errors import BadPlan, BrainDown
from planner.brain.image_questions import (
    ImageDescription,
    ImagePoint,
    ImageQuestion,
    ImageSighting,
    NotThere,
)
from planner.mission.activity import Activity, AskingImage, Driving, Observing
from planner.mission.effects import AskEyes, KeepPicture
from planner.mission.events import Event, Told
from planner.mission.perception_requests import EyeDoor
from planner.mission.reducer import asked_about_picture
from planner.mission.state import MissionState
from planner.mission.tasks import Answers, MissionTasks, call_nothing
from planner.perception.interfaces import MapPoint, Picture, PointRefusal
from planner.perception.snapshot import Detection, Sight
from planner.perception.snapshot import LookSnapshot as Looked
from planner.plan import (
    Bilingual,
    BrainTag,
    Code,
    Find,
    GoalState,
    GoTo,
    GoToObject,
    GoToPoint,
    Language,
    Look,
    StepPlan,
    say_same,
)
from planner.site import Site
from planner.skills import AskImage, DriveLeg, ImageAnswer, Observe
from planner.skills.perception import PictureCost, PictureLimits
from tests.planner.mission.fakes import FACTS, outcome_of
from tests.planner.mission.live import LiveBridge, Together, planner
from tests.planner.perception.watching import World
from wire import Image, ImageHeader, Pose2

SIGN = Bilingual(en="A sign says: go to the kitchen.", zh="牌子上写着：去厨房。")
TAG = BrainTag(name="looker", version="1")
CUP = Detection("cup", 0.9, (10.0, 10.0, 20.0, 20.0))
START = Pose2(1.0, 4.2, 0.0)


class FakeEyes:
    """Show a picture that a test numbers, and count who asks for what."""

    def __init__(self, bridge: LiveBridge) -> None:
        self._bridge, self.seq = bridge, 1
        self.behind = 0
        self.attended: list[tuple[str, bool]] = []
        self.wide: list[bool] = []
        self.open_classes: tuple[str, ...] = ()
        self.pointed: list[int] = []
        self.refuses: str | None = None
        self._told: list[Callable[[Sight], None]] = []

    @property
    def sight(self) -> Sight:
        seq = self.seq - self.behind
        return Sight(Looked(seq, self._bridge.now_s(), START, 320, 240, (CUP,)))

    @property
    def classes(self) -> tuple[str, ...]:
        return ("cup", *self.open_classes)

    @property
    def picture(self) -> Picture | None:
        return self.taken(self.seq)

    @property
    def looked_picture(self) -> Picture | None:
        return self.taken(self.seq - self.behind)

    def taken(self, seq: int) -> Picture:
        header = ImageHeader(
            boot_id="b", seq=seq, stamp_s=0.0, width=320, height=240, focal_px=200.0,
            center_x_px=160.0, center_y_px=120.0,
        )  # fmt: skip
        return Picture(Image(header, b"jpeg"), None, self._bridge.now_s() - 0.1 * (self.seq - seq))

    async def fresh(self) -> Picture | None:
        return self.picture

    def listen(self, told: Callable[[Sight], None]) -> None:
        self._told.append(told)

    def attend(self, who: str, wanted: bool, *, wide: bool = False) -> None:
        self.attended.append((who, wanted))
        self.wide.append(wide)

    async def spot(self, picture: Picture, x: float, y: float) -> MapPoint:
        self.pointed.append(picture.color.header.seq)
        if self.refuses is not None:
            raise PointRefusal(self.refuses)
        return MapPoint(2.0, 4.2, 0.0 if y > 600 else 0.5, 0.05)

    async def look_on(self) -> None:
        """Tell a new look every few milliseconds, as eyes do."""
        while True:
            self.seq += 1
            for told in self._told:
                told(self.sight)
            await asyncio.sleep(0.005)


class FakeLooker:
    """Read a sign in every picture, or fail."""

    def __init__(self, *, fails: bool = False) -> None:
        self._fails, self.asked = fails, list[tuple[str, str]]()
        self.shown: list[tuple[int, Pose2 | None, int]] = []
        self.views: list[tuple[str, int]] = []

    @property
    def tag(self) -> BrainTag:
        return TAG

    async def describe(self, asked: ImageQuestion) -> ImageDescription:
        self.asked.append((asked.words, asked.goal))
        shown = asked.picture
        self.shown.append((shown.seq, shown.base_in_map, len(asked.detections)))
        self.views += [(view.direction.en, view.picture.seq) for view in asked.views]
        if self._fails:
            raise BrainDown("503")
        return ImageDescription(SIGN, None, TAG)

    async def seek(self, asked: ImageQuestion) -> ImageSighting:
        self.asked.append((asked.words, asked.goal))
        self.shown.append((asked.picture.seq, asked.picture.base_in_map, len(asked.detections)))
        if self._fails:
            raise BadPlan("asked twice: drive to the kitchen!")
        return ImageSighting(True, 0, 0, 2, 0.9, TAG)

    async def point(self, asked: ImageQuestion) -> ImagePoint | NotThere:
        self.asked.append((asked.words, asked.goal))
        return ImagePoint(500, 500, TAG)


async def seeing(
    home: Path,
    site: Site,
    plan: StepPlan,
    looker: FakeLooker | None,
    text: str,
    reply: str | None = None,
) -> tuple[Together, FakeEyes, str]:
    """Let one goal end while pictures come, its question answered so; return what is left of it."""
    bridge = LiveBridge(pose=START)
    eyes = FakeEyes(bridge)
    limits = PictureLimits(8, PictureCost(2000, 0.001), "USD")
    async with planner(
        home, site, plan, bridge=bridge, eyes=eyes, looker=looker, pictures=limits
    ) as world:
        looking = asyncio.create_task(eyes.look_on())
        try:
            goal = await world.missions.submit(text)
            if reply is not None:
                await world.until(lambda: world.missions.goal(goal.id).state is ASKS)
                await world.missions.answer(goal.id, reply)
            await world.until(lambda: world.missions.goal(goal.id).state in DONE)
        finally:
            looking.cancel()
        return world, eyes, goal.id


ASKS = GoalState.NEEDS_CLARIFICATION
DONE = (GoalState.SUCCEEDED, GoalState.FAILED, GoalState.REFUSED)
WHAT = StepPlan(steps=(Look(question="what does the sign say?"),))


STAND = StepPlan(steps=(Find(object="umbrella stand", place="kitchen"),))


async def test_what_the_detector_does_not_know_the_vision_model_is_asked_for(
    tmp_path: Path, site: Site
) -> None:
    looker = FakeLooker()
    world, _, goal_id = await seeing(tmp_path, site, STAND, looker, "find my umbrella stand")
    goal = world.missions.goal(goal_id)
    assert goal.state is GoalState.SUCCEEDED
    assert goal.plan is not None
    step = goal.plan.steps[0]
    assert (step.code, step.found) == (Code.FOUND, None)
    assert step.read is not None
    assert "on the right (2)" in step.read.en
    assert step.bill is not None
    assert (step.bill.pictures, step.bill.pictures_most) == (1, 8)
    assert looker.asked == [("umbrella stand", goal_id)]
    assert "sure that I see “umbrella stand” before me" in outcome_of(goal).message.en


async def test_a_vision_model_that_writes_orders_ends_the_search_and_nothing_else_moves(
    tmp_path: Path, site: Site
) -> None:
    plan = StepPlan(steps=(Find(object="umbrella stand"), GoTo(place="kitchen")))
    looker = FakeLooker(fails=True)
    world, _, goal_id = await seeing(tmp_path, site, plan, looker, "find my umbrella stand")
    goal = world.missions.goal(goal_id)
    assert goal.state is GoalState.FAILED
    assert outcome_of(goal).code is Code.MODEL_UNAVAILABLE
    assert "I did not look for “umbrella stand”." in outcome_of(goal).message.en
    assert len(looker.asked) == 2
    assert goal.plan is not None
    assert goal.plan.steps[1].state.value != "succeeded"
    assert (world.bridge.pose.x_m, world.bridge.pose.y_m) == (START.x_m, START.y_m)


def attended(eyes: FakeEyes) -> Callable[[], bool]:
    """Return whether somebody needed these eyes by now, as a question."""
    return lambda: bool(eyes.attended)


async def test_the_open_vocabulary_model_looks_where_a_step_needs_it(
    tmp_path: Path, site: Site
) -> None:
    for number, (step, wide) in enumerate(
        (
            (Find(object="cup", place="kitchen"), False),
            (Find(object="umbrella stand", place="kitchen"), True),
            (Look(question="what is there?"), True),
        )
    ):
        home = tmp_path / str(number)
        home.mkdir()
        bridge = LiveBridge(pose=START)
        eyes = FakeEyes(bridge)
        eyes.open_classes = ("umbrella_stand",)
        plan = StepPlan(steps=(step,))
        async with planner(home, site, plan, bridge=bridge, eyes=eyes) as world:
            looking = asyncio.create_task(eyes.look_on())
            goal = await world.missions.submit("please look")
            await world.until(attended(eyes))
            assert (eyes.attended[0], eyes.wide[0]) == (("mission", True), wide), step
            await world.missions.cancel(goal.id)
            looking.cancel()


async def test_a_models_words_are_told_and_kept_apart_from_ours(tmp_path: Path, site: Site) -> None:
    looker = FakeLooker()
    world, eyes, goal_id = await seeing(tmp_path, site, WHAT, looker, "what is there?")
    goal = world.missions.goal(goal_id)
    assert goal.state is GoalState.SUCCEEDED
    assert outcome_of(goal).code is Code.SEEN
    assert outcome_of(goal).message.en == (f"I see nothing that I know. {SIGN.en}")
    assert goal.plan is not None
    step = goal.plan.steps[0]
    assert step.read is not None
    assert step.read.zh.endswith(SIGN.zh)
    assert step.said is not None
    assert "sign" not in step.said.en
    assert looker.asked == [("what does the sign say?", goal_id)]
    assert eyes.attended == [("mission", True), ("mission", False)]
    assert world.brain.asked[0].runnable >= {"look", "find"}
    assert "go_to_point" not in world.brain.asked[0].runnable


async def test_a_look_round_shows_a_model_the_picture_of_each_direction(
    tmp_path: Path, site: Site
) -> None:
    looker, plan = FakeLooker(), StepPlan(steps=(Look(question="look around"),))
    world, eyes, goal_id = await seeing(tmp_path, site, plan, looker, "look around")
    assert [name for name, _ in looker.views] == [
        "ahead", "ahead on the left", "behind on the left", "behind", "behind on the right",
        "ahead on the right",
    ]  # fmt: skip
    numbers = [number for _, number in looker.views]
    assert numbers == sorted(set(numbers)), "each was taken where the robot then stood"
    assert numbers[-1] <= eyes.seq
    goal = world.missions.goal(goal_id)
    assert outcome_of(goal).message.en.endswith(f"I see nothing that I know. {SIGN.en}")


async def test_pictures_are_kept_for_few_goals_and_only_while_they_are_the_newest() -> None:
    eyes, looker = FakeEyes(LiveBridge(pose=START)), FakeLooker()
    door, names = EyeDoor(eyes, looker), (say_same("ahead"), say_same("behind"))
    ask = AskEyes("g1", 1, Language.EN, AskImage("?", views=names, now=names[1]))
    for number in (0, 1):
        eyes.seq = 10 + number
        door.keep(KeepPicture("g1", number, eyes.seq))
    assert (await door.ask(ask)).answer.shown == 2
    assert looker.views == [("ahead", 10), ("behind", 11)]
    assert (await door.ask(ask)).answer.shown == 1, "they are gone once they were shown"
    for number, late in ((0, 0), (1, 5)):  # a newer picture shows another direction
        door.keep(KeepPicture("g1", number, eyes.seq - late))
    assert (await door.ask(ask)).answer.shown == 1
    for goal in ("g1", "g2", "g3"):
        for number in (0, 1):
            door.keep(KeepPicture(goal, number, eyes.seq))
    assert (await door.ask(ask)).answer.shown == 1, "pushed out by two others"
    assert (await door.ask(replace(ask, id="g3"))).answer.shown == 2


@pytest.mark.parametrize("looker", [None, FakeLooker(fails=True)], ids=["none", "down"])
async def test_without_a_model_the_detector_answers(
    tmp_path: Path, site: Site, looker: FakeLooker | None
) -> None:
    world, _, goal_id = await seeing(tmp_path, site, WHAT, looker, "what is there?")
    goal = world.missions.goal(goal_id)
    assert outcome_of(goal).message.en.startswith("I see nothing that I know.")


async def test_a_pixel_counts_in_the_picture_that_the_plan_was_made_on(
    tmp_path: Path, site: Site
) -> None:
    plan = StepPlan(steps=(GoToPoint(x=500, y=700),))
    world, eyes, goal_id = await seeing(tmp_path, site, plan, None, "go there")
    assert world.missions.goal(goal_id).state is GoalState.SUCCEEDED
    assert len(eyes.pointed) == 1
    assert eyes.pointed[0] < eyes.seq
    assert abs(world.bridge.pose.x_m - 2.0) < 0.1


@pytest.mark.parametrize(("reply", "x_m"), [("yes, please", 1.2), ("no", START.x_m)])
async def test_what_only_a_model_knows_is_pointed_at_and_driven_up_to_upon_a_yes(
    tmp_path: Path, site: Site, reply: str, x_m: float
) -> None:
    plan = StepPlan(steps=(GoToObject(object="guitar"),))
    looker, text = FakeLooker(), "go to the guitar"
    world, eyes, goal_id = await seeing(tmp_path, site, plan, looker, text, reply)
    goal = world.missions.goal(goal_id)
    assert (goal.state is GoalState.SUCCEEDED) == (reply != "no"), goal.outcome
    assert looker.asked == [("guitar", goal_id)]
    assert len(eyes.pointed) == 1
    assert abs(world.bridge.pose.x_m - x_m) < 0.1, "half a metre before the robot's edge"


async def test_a_pixel_whose_picture_is_gone_leads_nowhere() -> None:
    eyes = FakeEyes(LiveBridge(pose=START))
    ask = AskEyes("g1", 1, Language.EN, AskImage(x=500, y=700))
    door = EyeDoor(eyes)
    assert (await door.ask(ask)).answer == ImageAnswer(failure="point_no_pose")
    door.note("g1")
    assert (await door.ask(ask)).answer.at is not None
    assert (await EyeDoor(eyes).ask(ask)).answer.failure == "point_no_pose", "restarted"
    assert eyes.pointed == [1]


async def test_a_model_is_shown_the_picture_that_was_thought_upon_and_what_was_found_in_it() -> (
    None
):
    eyes, looker = FakeEyes(LiveBridge(pose=START)), FakeLooker()
    door, eyes.seq = EyeDoor(eyes, looker), 40
    for eyes.behind in (3, 30):  # then that look is too old
        await door.ask(AskEyes("g1", 1, Language.EN, AskImage("what is there?")))
    assert looker.shown == [(37, START, 1), (40, None, 0)]


Door = Callable[[AskEyes], Awaitable[Told]]


class Asking:
    """Hold helpers whose eyes are a function, and what came of them."""

    def __init__(self, door: Door) -> None:
        self.told: list[Told] = []
        self.broken: list[BaseException] = []
        nobody: Any = None
        broken = self.broken.append
        answers = Answers(self._hear, lambda *_: None, lambda: (), broken, call_nothing)
        eyes = EyeDoor(None)
        eyes.ask = door  # type: ignore[method-assign,assignment]  # another way to see
        self.helpers = MissionTasks(nobody, nobody, answers, eyes, nobody)

    def _hear(self, event: Event) -> None:
        assert isinstance(event, Told)
        self.told.append(event)

    async def ask(self, ticket: int) -> None:
        """Ask, and let it begin."""
        self.helpers.help(AskEyes("g1", ticket, Language.EN, AskImage("what is there?")))
        await asyncio.sleep(0)


def answered(ask: AskEyes) -> Told:
    return Told(ask.id, ask.ticket, ImageAnswer(text=say_same("a sofa")))


async def test_a_question_nobody_waits_for_is_cancelled_at_once() -> None:
    ended: list[int] = []

    async def hang(ask: AskEyes) -> Told:
        try:
            await asyncio.Event().wait()
        finally:
            ended.append(ask.ticket)
        return answered(ask)

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
    assert (asking.told, asking.broken) == ([], [])


async def test_an_answer_is_told_and_a_fault_of_the_eyes_is_one() -> None:
    async def see(ask: AskEyes) -> Told:
        if ask.ticket == 2:
            raise ZeroDivisionError("a fault of ours")
        return answered(ask)

    asking = Asking(see)
    for ticket in (1, 2):
        await asking.ask(ticket)
    await asyncio.sleep(0)
    await asking.helpers.close()
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


async def test_a_pixel_counts_in_the_picture_that_was_wanted_for_it() -> None:
    """Nobody wants pictures, so the camera rests, until a plan is asked for."""
    world = World()
    world.blindfold()
    async with asyncio.timeout(20.0):
        await world.film(1.0)
        door = EyeDoor(world.eyes)
        door.note("g1")
        await asyncio.sleep(0)
        await world.film(0.6)
        world.detector.failure = None
        ask = AskEyes("g1", 1, Language.EN, AskImage(x=500, y=900))
        told = asyncio.create_task(door.ask(ask))
        await world.film(0.5)
        other = asyncio.create_task(door.ask(replace(ask, id="g2")))
        await world.film(0.5)
        noted, never = (await told).answer, (await other).answer
    assert noted.at is not None
    assert noted.at[0] == pytest.approx(2.0, abs=0.3)
    assert never.failure == "point_no_pose"
