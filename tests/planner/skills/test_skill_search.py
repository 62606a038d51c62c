"""How far a search goes, which rooms come first, and what a neighbour in the words makes of it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from planner.bridge_client.ownership import GRANT_METRES, GRANT_SECONDS
from planner.language.catalogue import CATALOGUE
from planner.language.object_classes import KINDS
from planner.language.questions import Relation
from planner.perception.snapshot import Sight, Thing
from planner.plan import Bilingual, Code, Language, StepRole
from planner.site.site_view import SiteView, Target
from planner.skills import (
    DriveLeg,
    Eyesight,
    Fail,
    Finish,
    Observe,
    Question,
    Way,
    act_of,
)
from planner.skills.count import count
from planner.skills.find import find
from planner.skills.object_matching import picks_out, read_object
from planner.skills.perception import PictureLimits, WantedObject
from planner.skills.search_bounds import (
    GRANT_M,
    GRANT_S,
    LEAST_M,
    LEAST_PICTURES,
    LEAST_S,
    MOST_KEPT_M,
    MOST_M,
    MOST_S,
    bound_pictures,
    bound_search,
    way_after_m,
)
from planner.skills.skill_state import (
    CountState,
    FindState,
    GoToObjectState,
    RoomTourState,
    SkillStateBase,
)
from planner.skills.spatial_relations import stands
from planner.skills.viewpoints import THINGS, in_order, likely_rooms
from tests.planner.skills.looking import EYES, NOW_S, at, looking, sight, thing
from tests.planner.skills.scenes import said_of, scene
from wire import CameraConfig, Pose2

HALL = "r0"


def home(rooms: int, side_m: float = 4.0) -> SiteView:
    """Return a home of square rooms in rows of three."""
    targets = {}
    for n in range(rooms):
        x_m, y_m = side_m * (n % 3), side_m * (n // 3)
        box = ((x_m, y_m), (x_m + side_m, y_m), (x_m + side_m, y_m + side_m), (x_m, y_m + side_m))
        name = Bilingual(en=f"room {n}", zh=f"房间{n}")
        middle = Pose2(x_m + side_m / 2, y_m + side_m / 2, 0.0)
        targets[f"r{n}"] = Target(f"r{n}", True, name, middle, box)
    return SiteView(targets, home="r0")


def test_the_bounds_grow_with_the_home_and_stay_between_a_small_homes_and_a_grant() -> None:
    assert (GRANT_M, GRANT_S) == (GRANT_METRES, GRANT_SECONDS)
    for sides in ((3.0,) * 40, (4.0,) * 40, (12.0,) * 12):
        before = bound_search(home(0, sides[0]))
        for rooms, side_m in enumerate(sides):
            now = bound_search(home(rooms, side_m))
            assert before.begin_m <= now.begin_m
            assert before.seconds <= now.seconds
            assert LEAST_M <= now.begin_m <= now.end_m == MOST_M < GRANT_M
            assert LEAST_S <= now.seconds <= MOST_S == GRANT_S
            before = now
        assert before.begin_m == MOST_M, "a large home has all that a grant allows"
        assert before.seconds == MOST_S


@pytest.mark.parametrize("left_m", [60.0, 40.0, 12.0, 0.5, -3.0])
def test_no_search_drives_more_than_its_goal_may_yet(left_m: float) -> None:
    bounds = bound_search(home(9), left_m)
    assert 0.0 <= bounds.begin_m <= bounds.end_m <= max(0.0, left_m)


def test_the_way_that_comes_afterwards_is_kept() -> None:
    assert way_after_m((0.0, 0.0), ()) == 0.0
    assert way_after_m((0.0, 0.0), (((4.0, 0.0),), ((2.0, 0.0),))) == pytest.approx(6.0)
    assert way_after_m((0.0, 0.0), (((90.0, 0.0),),)) == MOST_KEPT_M


@pytest.mark.parametrize("kind", ["find", "count"])
def test_a_way_is_not_begun_from_which_the_plans_rest_is_out_of_reach(kind: str) -> None:
    """In room 0 all was looked at; room 1 is 4 m on, and then it is far to where the plan goes."""
    state = (FindState if kind == "find" else CountState)(
        here=(2.0, 2.0), order=("r0", "r1"), spots=("here",), rooms=("r0",)
    )
    skill = find if kind == "find" else count
    for afterwards, drives in (((), True), ((((2.0, 2.0),),), True), ((((-14.0, 2.0),),), False)):
        scene_ = scene(
            kind, step={"object": "red cup"}, facts=home(2, 4.0), pose=Pose2(2.0, 2.0, 0.0),
            eyes=EYES, state=state, spent_m=30.0, left_m=50.0, afterwards=afterwards, now_s=1.0,
        )  # fmt: skip
        act = skill(scene_)
        assert isinstance(act, DriveLeg) is drives, afterwards
        if isinstance(act, DriveLeg):
            assert act.limit_m is not None
            assert act.limit_m <= 50.0 - 30.0, "the leg ends before the grant does"


def test_pictures_are_bounded_by_the_rooms_unless_the_owner_says() -> None:
    def most(rooms: int, limits: PictureLimits) -> int:
        eyes = Eyesight(CameraConfig(), ("cup",), model=True, pictures=limits)
        return bound_pictures(scene("find", facts=home(rooms), eyes=eyes))

    by_site = PictureLimits(96, by_site=True)
    counts = [most(rooms, by_site) for rooms in range(30)]
    assert counts == sorted(counts)
    assert counts[0] == LEAST_PICTURES
    assert counts[7] >= 7 * EYES.views
    assert counts[-1] == 96
    assert most(9, PictureLimits(5)) == 5
    assert most(9, PictureLimits(10, by_site=True)) == 10, "the goal's calls hold"


def ended(kind: str, **more: Any) -> Any:
    state = (FindState if kind == "find" else CountState)(
        here=(2.0, 2.0), order=("r0", "r1", "r2"), spots=("here",), rooms=("r0",)
    )
    fields: dict[str, Any] = {"state": state, "facts": home(3), "spent_m": 60.0, **more}
    return looking(kind, **fields)


@pytest.mark.parametrize("kind", ["find", "count"])
def test_rooms_that_were_not_looked_in_are_named_and_offered(kind: str) -> None:
    told = ended(kind)
    assert isinstance(told, Fail | Finish)
    assert "I saw no red cup." in said_of(told).en
    assert "I did not look in the room 1 and room 2." in said_of(told).en
    assert "房间1" in said_of(told).zh
    assert "房间2" in said_of(told).zh
    assert "0" not in said_of(told).en.replace("room 0", ""), "none in half a home is no number"
    asked = ended(kind, offers=True)
    assert isinstance(asked, Question)
    assert said_of(told).en in asked.text.en
    assert asked.text.en.endswith("Shall I look in the room 1 and room 2, too? Say yes or no.")
    assert asked.text.zh.endswith("要我接着看房间1和房间2吗？请回答是或否。")
    assert asked.state is not None
    again = ended(kind, offers=True, state=asked.state)
    assert again == told, "nobody is asked twice"


def test_a_count_of_nothing_in_half_a_home_has_no_value() -> None:
    half = ended("count")
    assert isinstance(half, Finish)
    assert (half.code, half.figures["count"]) == (Code.COUNTED, None)
    done = ("here", "r1/0", "r2/0", "r0/near", "r1/near", "r2/near")
    state = CountState(here=(2.0, 2.0), order=("r0",), spots=done, rooms=("r0",))
    whole = ended("count", state=state, spent_m=0.0)
    assert isinstance(whole, Finish)
    assert whole.figures["count"] == 0, "none in all that was to be looked at"


def test_a_find_that_ran_out_takes_the_persons_else_and_says_so() -> None:
    when = {"object": "red cup", "role": StepRole.WHEN}
    ran_out = ended("find", step=when, has_else=True, offers=False)
    assert isinstance(ran_out, Finish)
    assert ran_out.figures["holds"] is False
    assert said_of(ran_out).en.endswith("So I do what you said for that case.")
    assert "I did not look in the room 1 and room 2." in said_of(ran_out).en
    assert "没找到" in said_of(ran_out).zh
    bare = ended("find", step=when)
    assert isinstance(bare, Finish)
    assert "So I do" not in said_of(bare).en
    until = ended("find", step={"object": "red cup", "role": StepRole.UNTIL}, has_else=False)
    assert isinstance(until, Finish)
    assert until.figures["holds"] is None, "of a round that saw half a home nothing is known"
    nowhere = FindState(here=(2.0, 2.0), order=("r0", "r1"), shut=("r0", "r1"))
    unknown = ended("find", step=when, has_else=True, state=nowhere)
    assert isinstance(unknown, Fail)
    assert unknown.code is Code.UNSURE, "nobody has searched yet"


def test_the_rooms_come_first_where_the_metres_would_not_last_for_every_corner() -> None:
    """A large room has several spots; with few metres left the other rooms come before them."""
    large = home(3, 8.0)
    state = FindState(here=(4.0, 4.0), order=("r0", "r1", "r2"), spots=("here",), rooms=("r0",))

    def next_room(left_m: float) -> bool:
        act = find(
            scene("find", step={"object": "red cup"}, facts=large, pose=Pose2(4.0, 4.0, 0.0),
                  eyes=EYES, state=state, left_m=left_m, now_s=1.0)
        )  # fmt: skip
        assert isinstance(act, DriveLeg)
        return act.goal.x_m > 8.0

    assert not next_room(60.0)
    assert next_room(40.0)


def test_a_site_without_outlines_is_bounded_too() -> None:
    bare = {k: replace(t, polygon=None) for k, t in home(12).targets.items()}
    assert bound_search(SiteView(bare, home=HALL)).begin_m >= LEAST_M


def test_a_search_ends_with_its_budget() -> None:
    for act in (looking("find", spent_m=56.0), looking("find", spent_s=541.0)):
        assert isinstance(act, Fail)
        assert act.reason == "not_found"
        assert "used up" in said_of(act).en


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
    assert "used up" in said_of(told).en


def room(id_: str, x_m: float = 0.0, en: str = "x", zh: str = "某处", *aliases: str) -> Target:
    around = tuple((x_m + x, y) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    pose = Pose2(x_m, 0.0, 0.0)
    return Target(id_, True, Bilingual(en=en, zh=zh), pose, around, aliases)


BED, CORRIDOR, STUDY = room("bedroom", 0.0), room("corridor", 3.0), room("r3", 6.0, zh="书房")
LIVING, KITCHEN = room("r4", 9.0, en="Living Room"), room("r5", 12.0, "x", "某处", "伙房")
HOME = SiteView({t.id: t for t in (BED, CORRIDOR, STUDY, LIVING, KITCHEN)}, home="bedroom")
BY_DISTANCE = ("bedroom", "corridor", "r3", "r4", "r5")


@pytest.mark.parametrize(
    ("names", "labels"),
    [
        (("kitchen",), {"cup", "bottle", "fridge"}),
        (("r1", "Kitchen 2", "x"), {"cup", "bottle", "fridge"}),
        (("r1", "Open-plan kitchen and living room", "x"), {"cup", "bottle", "fridge", "sofa"}),
        (("dining_room",), {"cup", "bottle", "fridge"}),
        (("r1", "x", "餐厅"), {"cup", "bottle", "fridge"}),
        (("master_bedroom",), {"bed"}),
        (("r1", "x", "次卧2"), {"bed"}),
        (("r1", "x", "客厅/餐厅"), {"sofa", "tv", "book", "chair", "cup", "bottle", "fridge"}),
        (("office",), {"book", "chair"}),
        (("r1", "x", "x", "书房"), {"book", "chair"}),
        (("r1", "kitchen balcony", "厨房阳台"), set()),
        (("r1", "bedroom hallway", "主卧卫生间"), set()),
        (("garden",), set()),
        (("hall", "大厅", "大厅"), set()),
    ],
)
def test_a_rooms_name_says_what_is_likely_there(names: tuple[str, ...], labels: set[str]) -> None:
    id_, en, zh, *aliases = (*names, "x", "某处")[: max(3, len(names))]
    rooms = (room(id_, 0.0, en, zh, *aliases),)
    asked = ("cup", "bottle", "fridge", "bed", "sofa", "tv", "book", "chair", "plant", "ball",
             "box", "door", "person", "unicorn")  # fmt: skip
    likely = {label for label in asked if likely_rooms(WantedObject(label), rooms)}
    assert likely >= labels
    assert bool(likely) is bool(labels)
    assert not likely & {"plant", "ball", "box", "door", "person", "unicorn"}


def test_the_table_names_kinds_that_there_are() -> None:
    assert {label for things in THINGS.values() for label in things.split()} <= set(KINDS)
    assert set(THINGS) <= set(CATALOGUE.keys("room"))


@pytest.mark.parametrize(
    ("wanted", "order"),
    [
        (None, BY_DISTANCE),
        (WantedObject("ball"), BY_DISTANCE),
        (WantedObject("bed"), BY_DISTANCE),
        (WantedObject("cup", "red"), ("bedroom", "r5", "r4", "r3", "corridor")),
        (WantedObject("chair"), ("bedroom", "r3", "r4", "r5", "corridor")),
        (WantedObject("ball", None, Relation.NEAR, WantedObject("tv")),
         ("bedroom", "r4", "r3", "corridor", "r5")),
        (WantedObject("cup", None, Relation.ON, WantedObject("table")),
         ("bedroom", "r5", "r4", "r3", "corridor")),
    ],
)  # fmt: skip
def test_likely_rooms_come_after_this_one_and_each_group_goes_on_to_the_nearest(
    wanted: WantedObject | None, order: tuple[str, ...]
) -> None:
    assert in_order(HOME, BED.pose, (), wanted) == order


def test_where_such_a_thing_was_seen_last_comes_before_where_it_is_likely() -> None:
    seen = Thing("cup_1", "cup", None, 3.0, 0.0, 0.8, 0.1, 0.9, 5.0, 0.0, 4, "corridor")
    older = replace(seen, id="cup_2", room="r3", seen_s=1.0)
    order = in_order(HOME, BED.pose, (older, seen), WantedObject("cup"))
    assert order == ("bedroom", "corridor", "r3", "r5", "r4")


@pytest.mark.parametrize("kind", ["find", "go_to_object", "count"])
def test_the_order_is_made_once_and_only_by_who_ends_with_the_first_that_is_found(
    kind: str,
) -> None:
    eyes = Eyesight(CameraConfig(), ("cup",))
    act = act_of(scene(kind, step={"object": "cup"}, facts=HOME, eyes=eyes, pose=BED.pose))
    assert isinstance(act, (DriveLeg, Observe))
    assert isinstance(act.then, RoomTourState)
    assert act.then.order == (
        BY_DISTANCE if kind == "count" else ("bedroom", "r5", "r4", "r3", "corridor")
    )
    elsewhere = Pose2(9.0, 0.0, 0.0)
    later = act_of(
        scene(kind, step={"object": "cup"}, facts=HOME, eyes=eyes, pose=elsewhere, state=act.state,
              sight=Sight(None, (Thing("cup_1", "cup", None, 6.0, 0, 0, 0.1, 0.2, 0, 0, 1, "r3"),)))
    )  # fmt: skip
    assert isinstance(later, (DriveLeg, Observe))
    assert isinstance(later.then, RoomTourState)
    assert later.then.order == act.then.order


CLASSES = ("cup", "bottle", "table", "chair", "person", "box")
ON, UNDER, NEAR = Relation


TABLE = at("table", 1.6, 0.4)
A_TABLE, A_BLUE_CHAIR = WantedObject("table"), WantedObject("chair", "blue")


@pytest.mark.parametrize(
    "words",
    [
        "bottle on the shelf", "cup on the small table", "the other cup on the table",
        "chair beside the window", "cup on the left", "窗户旁边的椅子", "小桌子上的杯子",
        "椅子旁边的桌子上的杯子", "small cup", "大箱子",
    ],
)  # fmt: skip
def test_what_these_eyes_cannot_judge_still_picks_one_out(words: str) -> None:
    assert picks_out(words, "go_to_object", Language.EN, CLASSES)
    wanted = read_object(words, Language.EN, CLASSES)
    assert wanted is None or wanted.by is None


@pytest.mark.parametrize(
    ("thing", "on", "under", "near"),
    [
        (at("bottle", 1.6, 0.8), True, False, True),
        (at("bottle", 2.2, 0.8), True, False, True),
        (at("bottle", 2.4, 0.8), False, False, True),
        (at("bottle", 2.4, 0.8, sigma_m=0.2), True, False, True),
        (at("box", 1.8, 0.1), False, True, True),
        (at("box", 2.8, 0.1), False, False, True),
        (at("box", 3.0, 0.1), False, False, False),
        (TABLE, False, False, False),
    ],
)
def test_positions_say_how_things_stand(thing: Thing, on: bool, under: bool, near: bool) -> None:
    assert tuple(stands(thing, how, TABLE) for how in Relation) == (on, under, near)


def looking_for(kind: str, words: str, *things: Thing, **more: Any) -> Any:
    fields = {"eyes": Eyesight(CameraConfig(), CLASSES), "sight": sight(*things), "now_s": NOW_S}
    return act_of(scene(kind, step={"object": words}, **{**fields, **more}))


THERE, OTHER = at("bottle", 1.7, 0.8), at("bottle", 0.9, 0.1)
GAZED: dict[str, Any] = {"gazed_s": NOW_S - 1.0, "spent_s": 5.0}


def test_nobody_is_followed_by_a_neighbour_and_what_is_said_of_it_does_not_offer_one() -> None:
    act = looking_for("follow", "person near the chair")
    assert isinstance(act, Fail)
    assert "nearest one in sight" in said_of(act).en
    assert "最近的一个" in said_of(act).zh


@pytest.mark.parametrize("words", ["bottle on the table", "桌子上的瓶子"])
def test_only_what_stands_there_is_found_and_gone_to(words: str) -> None:
    found = looking_for("find", words, OTHER, THERE, TABLE, **GAZED)
    assert isinstance(found, Finish)
    assert found.figures["found"].x_m == 1.7
    assert "a bottle on the table" in said_of(found).en
    assert "桌子上的一个瓶子" in said_of(found).zh
    goes = looking_for("go_to_object", words, OTHER, THERE, TABLE, **GAZED)
    assert isinstance(goes, (DriveLeg, Observe))
    assert isinstance(goes.then, GoToObjectState)
    assert goes.then.at is not None
    assert goes.then.at[0] == 1.7
    unsure = at("table", 1.6, 0.4, confidence=0.4)
    for seen in ((OTHER, TABLE), (THERE,), (THERE, unsure)):
        assert isinstance(looking_for("find", words, *seen, **GAZED), (DriveLeg, Observe)), (
            "it looks on"
        )


def test_what_does_not_stand_there_is_not_told_of_nor_counted() -> None:
    words, spent = "bottle on the table", {"spent_m": 56.0}
    ended = looking_for("find", words, OTHER, TABLE, **GAZED, **spent)
    assert isinstance(ended, Fail)
    assert said_of(ended).en.startswith("I saw no bottle on the table.")
    number = looking_for("count", words, OTHER, THERE, TABLE, state=CountState(), **GAZED, **spent)
    assert isinstance(number, Finish)
    assert (number.code, number.figures["count"]) == (Code.COUNTED, 1)
    assert "a bottle on the table" in said_of(number).en


def counted(words: str, *things: Thing, shut: bool = False) -> Finish:
    """Count to the end, in a hall and a kitchen, with these things in sight."""
    state: SkillStateBase = CountState()
    pose = Pose2(0.0, 0.0, 0.0)
    for _ in range(60):
        act = looking_for("count", words, *things, state=state, pose=pose, spent_s=5.0)
        if isinstance(act, Finish):
            return act
        assert isinstance(act, (DriveLeg, Observe))
        state = act.then or state
        if isinstance(act, DriveLeg) and shut and act.goal.x_m > 2.0:
            state = act.otherwise or state
        elif isinstance(act, DriveLeg):
            pose = act.goal
    raise AssertionError(state)


ON_IT = at("bottle", 4.1, 0.8, room="kitchen"), at("bottle", 3.8, 0.8, room="kitchen")
IN_KITCHEN = (at("table", 4.0, 0.4, room="kitchen"), *ON_IT)
IN_HALL = (at("table", 0.5, 0.4), at("bottle", 0.5, 0.8))


@pytest.mark.parametrize(
    ("words", "things", "number", "said", "rooms"),
    [
        (
            "bottles on the table",
            (*IN_HALL, *IN_KITCHEN),
            1,
            "a bottle on the table in the hall.",
            1,
        ),
        ("桌子上的瓶子", (*IN_HALL, *IN_KITCHEN), 1, "a bottle on the table in the hall.", 1),
        ("bottles on the table", IN_KITCHEN, 2, "two bottles on the table in the kitchen.", 2),
        (
            "bottles on the tables",
            (*IN_HALL, *IN_KITCHEN),
            3,
            "three bottles on the table. I looked",
            2,
        ),
        ("每张桌子上的瓶子", (*IN_HALL, *IN_KITCHEN), 3, "three bottles on the table. I looked", 2),
        ("bottles on the table", ON_IT, 0, "no tables. I looked in the hall and kitchen.", 2),
    ],
)
def test_the_table_is_the_first_one_that_is_come_by(
    words: str, things: tuple[Thing, ...], number: int, said: str, rooms: int
) -> None:
    done = counted(words, *things)
    assert said_of(done).en.startswith(f"I saw {said}")
    assert done.figures == {"count": number, "rooms": ("hall", "kitchen")[:rooms]}


def test_a_number_is_said_with_its_measure_word() -> None:
    said = [counted("bottles on the table", *things).said for things in (IN_KITCHEN, ON_IT)]
    told = [s.zh.partition("。")[0] for s in said if s]
    assert told == ["在kitchen看到桌子上的两个瓶子", "没有看到桌子"]


def test_a_table_to_which_there_is_no_way_is_told_of_as_such() -> None:
    done = counted("bottles on the table", *IN_KITCHEN, shut=True)
    assert said_of(done).en.endswith("I looked in the hall. I found no way to the kitchen.")
