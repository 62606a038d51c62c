"""What a sentence leans on: looks, motions, whereabouts, pronouns, and the way back."""

from __future__ import annotations

from dataclasses import replace
from math import hypot, pi, radians
from typing import Any

import pytest

from planner.mission.events import Cancel
from planner.mission.follow_up import AWAY_M, LEANS_S, departure_of
from planner.mission.state import ORDER_SOURCE, MissionState
from planner.plan import (
    ChangedOrder,
    ComeBack,
    Count,
    Find,
    GoalState,
    GoTo,
    GoToObject,
    Look,
    MoveStraight,
    Patrol,
    Recall,
    Say,
    StepPlan,
    Turn,
)
from tests.planner.mission.fakes import FACTS as TWO_ROOMS
from tests.planner.mission.fakes import outcome_of, status
from tests.planner.mission.leaning import (
    FACTS,
    changed_by,
    each,
    heard,
    means,
    newest,
    order_asked_about,
    order_done,
    order_under_way,
    steps_after,
)
from tests.planner.mission.lockstep import QUEUED, RUNNING, SUCCEEDED, Together, go
from wire import Pose2


def order_in_vain(text: str) -> MissionState:
    """Return the book once a search is over that found nothing."""
    book = order_done(text)
    failed = newest(book).model_copy(update={"state": GoalState.FAILED})
    return replace(book, missions={"g0": failed})


COUNT = "count the cups in the kitchen"
COUNTED = order_done(COUNT, GoTo(place="kitchen"), Count(object="cups", place="kitchen"))
COUNT_ZH = "去厨房数一下瓶子"
COUNTED_ZH = order_done(COUNT_ZH, GoTo(place="kitchen"), Count(object="瓶子", place="kitchen"))
BOTH = order_done(
    "count the cups in the kitchen and the study",
    *(Count(object="cups", place=place) for place in ("kitchen", "study")),
)
SEEKING = order_under_way(
    "go to the kitchen and look for a bottle",
    GoTo(place="kitchen"),
    Find(object="bottle", place="kitchen"),
)
CHAIR = order_done("find a chair", Find(object="chair"))
CHAIR_ZH = order_done("帮我找椅子", Find(object="椅子"))
TOLD = order_done("tell Nan good night", Say(text="Nan, good night"))
LOOKED = order_done("look around the kitchen", Look(question="look", place="kitchen"))
DRIVE = order_done("go to the kitchen", GoTo(place="kitchen"))
CUP, CUP_ZH = order_under_way("look for a cup"), order_under_way("帮我找个杯子")
NO_CUP = order_in_vain("look for a cup in the bedroom")
NO_CUP_ZH = order_in_vain("去卧室找杯子")
STUDY_CUP = order_under_way("an order", Find(object="cup", place="study"))
FOUND = order_done("look for a cup in the bedroom")
MUM = order_asked_about("tell Mum that tea is ready")
MUM_ZH = order_asked_about("跟妈妈说饭好了")
DAD = order_under_way(
    "is Dad in the study?",
    GoTo(place="study"),
    Look(question="is Dad in the study", place="study"),
)
ASKED_ZH = order_done("去书房问小明要不要喝茶")
HOME = order_asked_about("tell Mum I'm home")
HER = order_asked_about("tell her dinner is ready")
TEA, TEA_ZH = "tell Mum in the study that tea is ready", "跟书房的妈妈说饭好了"
STUDY, EVERYWHERE = "look for the cup in the study", "look for the cup in every room"


@pytest.mark.parametrize(
    ("book", "said", "order"),
    [
        # A look is taken once more.
        *each(COUNTED, COUNT, "are you sure? Count again", "count again please"),
        *each(COUNTED, COUNT, "can you recount them, please", "count them once more"),
        *each(COUNTED, COUNT, "look again, there must be more", "have another look"),
        (COUNTED, "have another look, I think you missed a bottle", COUNT),
        *each(COUNTED, COUNT, "go back and check again", "really? count them again"),
        *each(COUNTED, COUNT, "double-check that", "have another look, I think you missed one"),
        (COUNTED, "count again, there should be five of them", COUNT),
        *each(COUNTED_ZH, COUNT_ZH, "你确定吗？再数一遍", "再数一次"),
        *each(COUNTED_ZH, COUNT_ZH, "刚才那边再看一遍，应该不止吧", "重新数一下", "再看看"),
        *each(COUNTED_ZH, COUNT_ZH, "再数一遍呗，都过十分钟了", "我觉得不对，再数一遍"),
        # Another thing is looked for at the same place, of two places at neither.
        *each(COUNTED, "count the bottles in the kitchen", "and bottles?", "bottles too"),
        *each(COUNTED, "count the chairs in the kitchen", "And the chairs", "what about chairs?"),
        (SEEKING, "also look for a cup", "look for the cup in the kitchen"),
        (SEEKING, "look for a cup too while you're there", "look for the cup in the kitchen"),
        (SEEKING, "and a cup", "look for the cup in the kitchen"),
        *each(COUNTED_ZH, "去厨房数一下杯子", "杯子呢", "还有杯子"),
        (COUNTED_ZH, "顺便看看有没有杯子", "去厨房看看有没有杯子"),
        (BOTH, "and bottles?", None),
        # What was found or said is spoken of.
        (CHAIR, "go to the one in the kitchen", "go to the chair in the kitchen"),
        (CHAIR, "what colour is it?", "what colour is the chair"),
        (CHAIR, "what does it look like?", "what does the chair look like"),
        (CHAIR_ZH, "去厨房那把", "去厨房的椅子那里"),
        (CHAIR_ZH, "什么颜色的", "看看椅子是什么颜色的"),
        (TOLD, "say it again, louder, she's a bit deaf", 'say "Nan, good night"'),
        (TOLD, "and again, louder", 'say "Nan, good night"'),
        (TOLD, "she didn't hear you, say it again", 'say "Nan, good night"'),
        (TOLD, "say it twice more", 'say "Nan, good night" and then say "Nan, good night"'),
        (TOLD, "她没听见，再讲两遍", "说“Nan, good night”，再说“Nan, good night”"),
        (TOLD, "再说一遍，大声点", "说“Nan, good night”"),
        # A drive looks at nothing.
        *each(DRIVE, None, "count again", "and bottles?", "what colour is it?"),
        (DRIVE, "say it again, louder", None),
        (LOOKED, "count again", None),
        # A guess narrows the search.
        *each(CUP_ZH, "去厨房找杯子", "厨房咯", "厨房", "应该在厨房吧", "可能在厨房", "我猜在厨房"),
        *each(CUP_ZH, "去厨房找杯子", "那试试厨房", "再去厨房看看，应该在那", "它在厨房"),
        *each(CUP, STUDY, "I think I left it in the study", "we had it in the study"),
        *each(FOUND, None, "I think I left it in the study", "we had it in the study"),
        # A search goes on elsewhere.
        (NO_CUP, "okay, try the hallway then", "look for the cup in the hallway"),
        *each(NO_CUP, STUDY, "have another look in the study", "it's not there, try the study"),
        *each(NO_CUP, STUDY, "nothing there? Try the study then.", "no luck, try the study"),
        (NO_CUP, "ok, then the study", STUDY),
        (CUP, "the living room, I guess, near the TV", "look for the cup near the tv"),
        *each(NO_CUP, EVERYWHERE, "I dunno, try all of them", "no idea, just look everywhere"),
        (NO_CUP, "try another room", EVERYWHERE),
        *each(NO_CUP_ZH, "到处找杯子", "再去别的房间找找看", "不知道，都找找看吧"),
        (NO_CUP_ZH, "那试试书房", "去书房找杯子"),
        (CUP, "then the study", None),
        (FOUND, "check the kitchen", None),
        # Where somebody is completes the order, whatever they do there.
        *each(MUM, TEA, "she's in the study, as usual", "She's in the study."),
        *each(MUM, TEA, "the study, I think", "try the study"),
        (MUM, "she'll be in the study, watching TV", TEA),
        *each(MUM, TEA, "she's probably working in the study", "in her study"),
        (HOME, "she's in the study", "tell Mum in the study I'm home"),
        *each(MUM_ZH, TEA_ZH, "她在书房", "在书房吧", "那你去书房看看，她应该在那", "书房咯"),
        # Only who was asked for is there, and whom the word fits.
        *each(MUM, None, "he's in the study", "Dad's in the study", "she's out"),
        (MUM, "she's not in the study", None),
        *each(HER, None, "Dad, he's in the study", "the cat, she's in the study", "Mum"),
        # Another sentence narrows nothing.
        *each(CUP, None, "the kitchen is dirty", "the kitchen or the study", "probably"),
        *each(CUP, None, "is it in the kitchen?", "it isn't in the kitchen", "I don't know"),
        *each(CUP, None, "I was in the kitchen", "go to the kitchen", "she's in the kitchen"),
        *each(CUP, None, "all of them are broken", "try the kitchen if the door is open"),
        *each(CUP, None, "everywhere is a mess", "all over", "I guess so", "it's in my hand"),
        *each(CUP_ZH, None, "厨房很脏", "厨房还是书房", "去厨房", "在厨房吗"),
        *each(CUP_ZH, None, "都行", "都好了", "都在吧"),
        # Neither a word of another sense nor one of two persons means what the last order named.
        *each(STUDY_CUP, None, "find it and bring it to me", "is it raining", "go there", "say it"),
        *each(STUDY_CUP, None, "look for the key and find it", "what time is it there"),
        *each(STUDY_CUP, None, "去那里", "找到球了", "它在哪"),
        *each(DAD, None, "tell her tea is ready", "tell him and tell her tea is ready"),
        *each(DAD, None, "if he is hungry, come back", "Anna said to tell him tea is ready"),
        # Who is asked again hears the same question.
        *each(ASKED_ZH, "去书房问小明要不要喝茶", "再问他一遍", "再跟他说一遍吧", "你再去问他一次"),
    ],
)
def test_a_sentence_comes_to_the_order_that_it_leans_on_or_changes_nothing(
    book: MissionState, said: str, order: str | None
) -> None:
    assert means(book, said, order)


@pytest.mark.parametrize(
    "said",
    [
        *("the kitchen, probably", "probably the kitchen", "the kitchen"),
        *("in the kitchen I think", "I think it's in the kitchen", "it should be in the kitchen"),
        *("maybe try the kitchen", "I'd say the kitchen", "ok, try the kitchen again"),
        *("most likely in the kitchen, as always", "the kitchen, that's where I saw it last"),
        *("the kitchen, it's always in there", "you could look in the kitchen first"),
        "have another look in the kitchen, it was there this morning",
    ],
)
def test_a_guess_narrows_the_search(said: str) -> None:
    assert means(CUP, said, "look for the cup in the kitchen")
    assert (heard(CUP, said).takes_back, heard(CUP, said).given.first) == ("g0", True)


def test_a_thing_besides_waits_for_what_runs() -> None:
    said = "oh and see if there's a cup as well"
    assert (heard(SEEKING, said).takes_back, heard(SEEKING, said).given.first) == (None, True)
    asks = Look(question="see if there is a cup", place="kitchen")
    assert changed_by(SEEKING, said) == ChangedOrder(steps=(GoTo(place="kitchen"), asks))


@pytest.mark.parametrize(
    "said",
    [
        *("and thanks", "and you?", "and the weather?", "and the time?", "cups are nice"),
        *("count again if the light is on", "count again, but go to the study"),
        *("再数一遍，如果灯开着", "再数一遍，先去书房"),
        *("are you sure?", "don't count again", "look for a cup", "and then?", "and why?"),
        *("and the dinner is ready", "go to the one", "what colour do you like?", "louder"),
        *("天气呢", "你呢", "确定吗", "别再数了", "什么颜色好看"),
    ],
)
def test_another_sentence_repeats_nothing(said: str) -> None:
    assert changed_by(COUNTED, said) is None
    assert changed_by(COUNTED_ZH, said) is None


def test_a_drive_is_no_search_and_long_ago_is_forgotten() -> None:
    drive = order_under_way("go to the bedroom", GoTo(place="bedroom"))
    assert changed_by(drive, "the kitchen, probably") is None
    assert changed_by(CUP, "the kitchen, probably", LEANS_S + 1.0) is None


LEFT, AHEAD = Turn(angle_rad=pi / 2.0), MoveStraight(distance_m=0.2)


@pytest.mark.parametrize(
    "said",
    [
        *("no, the other left!", "your other left! I meant right", "the other way", "wrong way!"),
        *("no, right!", "I meant right", "no, turn to the right, not left", "right, I meant"),
        "that's the wrong way, dear, turn right",
    ],
)
def test_the_other_side_ends_where_the_right_turn_would_have(said: str) -> None:
    assert means(order_under_way("turn left", LEFT), said, "turn right by 90 degrees")
    assert means(order_done("turn left", LEFT), said, "turn right by 180 degrees")


@pytest.mark.parametrize(
    "said", ["反了，右边！", "不对，是右边", "不对，往右", "另一边", "我说的是右边", "转反了"]
)
def test_so_it_ends_in_chinese(said: str) -> None:
    assert means(order_under_way("往左转", LEFT), said, "向右转90度")


def test_a_turn_under_way_is_undone_as_far_as_it_came() -> None:
    begun = order_under_way("turn left", LEFT)
    assert heard(begun, "no, the other left!").takes_back == "g0", "it comes in its place"
    last = newest(begun).model_copy(update={"accepted_at": (0.0, 0.0, 0.0)})
    here = status(base_in_map=Pose2(x_m=0.0, y_m=0.0, yaw_rad=radians(40.0)))
    [turn] = steps_after(replace(begun, missions={last.id: last}, status=here), "no, right!")
    assert isinstance(turn, Turn)
    assert turn.angle_rad == pytest.approx(radians(-130.0))


@pytest.mark.parametrize(
    ("step", "said", "order"),
    [
        (LEFT, "a bit more", "turn left by 30 degrees"),
        (LEFT, "too far, back a bit", "turn right by 30 degrees"),
        (LEFT, "that was too far, now turn back a little", "turn right by 30 degrees"),
        (MoveStraight(distance_m=-0.5), "too far, come forward a little", "move forward 20 cm"),
        (MoveStraight(distance_m=0.5), "another half metre", "move forward half a metre"),
        *each(LEFT, "向右转30度", "转多了，往回转一点", "多了多了，转回来一点"),
        (LEFT, "再转一点", "向左转30度"),
        *each(AHEAD, "move forward 20 cm", "bit more", "just a little further please", "closer"),
        (AHEAD, "back a bit", "move back 20 cm"),
        (MoveStraight(distance_m=-0.2), "a bit more", "move back 20 cm"),
        *each(AHEAD, "前进20厘米", "再来一点", "再近一点"),
        (GoToObject(object="cup"), "a bit closer", "move forward 20 cm"),
        # So much more is measured as the motion was.
        (AHEAD, "another 20 cm", "move forward 20 cm"),
        (MoveStraight(distance_m=-1.0), "another metre", "move back a metre"),
        (AHEAD, "再往前走一米", "前进一米"),
        *each(LEFT, "turn left by 30 degrees", "another 30 degrees", "a bit more to the left"),
        *each(LEFT, "向左转30度", "再转30度", "再左一点"),
        *each(LEFT, None, "another metre", "a bit more to the right", "再右一点"),
        *each(AHEAD, None, "another 30 degrees", "a bit more to the left"),
    ],
)
def test_a_motion_goes_on_or_back_a_little(step: Any, said: str, order: str | None) -> None:
    assert means(order_done("an order", step), said, order)


@pytest.mark.parametrize(
    "said",
    [
        *("no more", "no", "right", "that's right", "no, left", "not closer", "more?"),
        *("closer to the table", "a bit more tea", "don't go any further", "the other room"),
        *("不对", "不对，左边", "别再近了", "够了", "不要再转了", "好了"),
    ],
)
@pytest.mark.parametrize("step", [LEFT, AHEAD])
def test_another_sentence_moves_nothing(step: Any, said: str) -> None:
    assert steps_after(order_under_way("an order", step), said) == ()


@pytest.mark.parametrize("said", ["a bit more", "the other left", "再来一点", "反了"])
def test_nothing_is_adjusted_where_nothing_was_turned_or_moved(said: str) -> None:
    for steps in ((Find(object="cup"),), (LEFT, LEFT)):
        assert changed_by(order_under_way("an order", *steps), said) is None


HERE = Pose2(0.4, -0.3, 0.5)
BACK, HELLO = StepPlan(steps=(ComeBack(),)), StepPlan(steps=(Say(text="hello"),))


def world_at(pose: Pose2 = HERE) -> Together:
    world = Together()
    world.bridge.pose = pose
    world.run(0.2)
    return world


def after_errand(place: str = "kitchen") -> Together:
    world = world_at()
    world.run_until(world.give(go(place)), SUCCEEDED)
    return world


def is_near(world: Together, pose: Pose2) -> bool:
    return hypot(world.bridge.pose.x_m - pose.x_m, world.bridge.pose.y_m - pose.y_m) < 0.1


def departed(world: Together, **changes: Any) -> tuple[float, float, float] | None:
    return departure_of(replace(world.book, **changes), world.now_s)


def test_the_robot_comes_back_to_where_the_errand_was_given() -> None:
    world = after_errand()
    assert not is_near(world, HERE)
    assert departed(world) == (HERE.x_m, HERE.y_m, HERE.yaw_rad)
    goal = world.give(BACK)
    world.run_until(goal, SUCCEEDED)
    assert is_near(world, HERE)
    outcome = outcome_of(world.goal(goal))
    assert outcome.message.en == "Arrived: where you gave the order."


@pytest.mark.parametrize("between", [(BACK, go("kitchen")), (HELLO,)], ids=["back", "talk"])
def test_neither_a_way_back_nor_words_between_change_where_it_comes_back_to(
    between: tuple[StepPlan, ...],
) -> None:
    world = after_errand()
    for plan in (*between, BACK):
        world.run_until(world.give(plan), SUCCEEDED)
    assert is_near(world, HERE)


def test_said_while_the_errand_goes_on_it_is_the_same_spot() -> None:
    world = world_at()
    errand = world.give(go("kitchen"))
    world.run(0.5)
    goal = world.give(BACK, first=True)
    assert (world.goal(errand).state, world.goal(goal).state) == (RUNNING, QUEUED)
    world.run_until(goal, SUCCEEDED)
    assert is_near(world, HERE)


def test_an_errand_broken_off_near_by_is_the_one_that_is_meant() -> None:
    world = after_errand()
    begun = world.bridge.pose
    errand = world.give(go("hall"))
    while world.goal(errand).metres < AWAY_M / 2:
        world.run(0.05)
    world.event(Cancel(errand))
    assert departed(world) == (begun.x_m, begun.y_m, begun.yaw_rad)


def test_coming_back_behind_a_drive_of_the_same_order_is_back_to_where_that_was_given() -> None:
    world = after_errand()
    begun = world.bridge.pose
    goal = world.give(StepPlan(steps=(GoTo(place="hall"), ComeBack())))
    world.run_until(goal, SUCCEEDED)
    assert is_near(world, begun)


@pytest.mark.parametrize(
    "changes",
    [
        {"status": None},
        {"status": status(base_in_map=None)},
        {"status_s": 0.0},
        {"facts": replace(TWO_ROOMS, map_id="another")},
        {"wall_offset_s": LEANS_S + 100.0},
        {"wall_offset_s": float("nan")},
        {"missions": {}},
    ],
    ids=["silent", "not_localized", "stale", "other_map", "long_ago", "clock_broken", "first"],
)
def test_where_it_is_in_doubt_nothing_is_meant(changes: dict[str, Any]) -> None:
    world = after_errand()
    assert departed(world) is not None
    assert departed(world, **changes) is None


def test_an_order_whose_own_pose_was_unknown_is_passed_over_for_none_before_it() -> None:
    world = after_errand()
    newest = world.goal("g1").model_copy(update={"id": "g2", "order": 9, "accepted_at": None})
    assert departed(world, missions={**world.book.missions, "g2": newest}) is None


def test_a_standing_order_is_nobodys_last_order() -> None:
    world = after_errand()
    world.bridge.pose = Pose2(3.0, 0.0, 0.0)
    world.run(0.1)
    world.run_until(world.give(go("dock"), source=f"{ORDER_SOURCE}o1"), SUCCEEDED)
    assert departed(world) is not None
    orders = {k: v for k, v in world.book.missions.items() if v.source.startswith(ORDER_SOURCE)}
    assert departed(world, missions=orders) is None


EN = (("was it in the study?", "did you see the {t} in the study"),)
ZH = (("再去玄关找找", "去玄关找{t}"), ("是在书房看到的吗", "你在书房看到过{t}吗"))


@pytest.mark.parametrize(("said", "order"), EN)
@pytest.mark.parametrize("thing", ["cup", "the book", "my red ball"])
@pytest.mark.parametrize("place", ["kitchen", "study"])
def test_a_pronoun_means_the_one_thing_or_place_of_the_last_order(
    said: str, order: str, thing: str, place: str
) -> None:
    book = order_under_way("an order", GoTo(place=place), Find(object=thing, place=place))
    bare = thing.removeprefix("the ").removeprefix("my ")
    assert means(book, said, order.format(t=bare))


@pytest.mark.parametrize(("said", "order"), ZH)
@pytest.mark.parametrize("thing", ["杯子", "书"])
@pytest.mark.parametrize("place", ["kitchen", "study"])
def test_so_it_does_in_chinese(said: str, order: str, thing: str, place: str) -> None:
    book = order_under_way("an order", Find(object=thing, place=place))
    assert means(book, said, order.format(t=thing))


@pytest.mark.parametrize("said", [said for said, _ in EN + ZH])
def test_what_is_in_doubt_stays_as_it_was_said(said: str) -> None:
    two = order_under_way("an order",
        Find(object="cup", place="study"), Find(object="ball", place="kitchen"),
        Find(object="球", place="kitchen"),
    )  # fmt: skip
    for book in (MissionState(FACTS), two, order_under_way("an order", Recall(deeds=True))):
        assert changed_by(book, said) is None
    assert changed_by(STUDY_CUP, said, LEANS_S + 1.0) is None


@pytest.mark.parametrize(
    ("said", "order"),
    [
        ("see anyone?", "did you see anyone"),
        ("so, seen anything odd?", "did you see anything odd"),
        ("spot any cups?", "did you see any cups"),
        ("看到人了吗", "你看到过人吗"),
        ("刚才看见猫没有", "你看到过猫吗"),
        ("有没有看到什么", "你看到过什么吗"),
    ],
)
def test_what_was_seen_is_asked_once_a_look_is_over_and_never_before(said: str, order: str) -> None:
    runs = order_under_way("an order", Patrol(places=("kitchen", "study"), look=True))
    over = runs.missions["g0"].model_copy(update={"state": GoalState.SUCCEEDED})
    done = replace(runs, missions={"g0": over}, running=None)
    assert means(done, said, order)
    assert changed_by(runs, said) is None
    assert changed_by(order_under_way("an order", GoTo(place="kitchen")), said) is None


TOLD_MUM = order_done("tell Mum tea is ready")


@pytest.mark.parametrize(
    "said", ["tell her again", "ok, ask her once more", "go back and tell her again, please"]
)
def test_who_is_told_again_hears_the_same(said: str) -> None:
    assert means(TOLD_MUM, said, "tell Mum tea is ready")
    assert changed_by(TOLD_MUM, said.replace("her", "him")) is None
