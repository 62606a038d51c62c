"""In which rooms a kind of thing is likely, by the rooms' names, and what the order makes of it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.language.catalogue import CATALOGUE
from planner.language.object_classes import KINDS
from planner.language.questions import Relation
from planner.mission.skills import DriveLeg, Eyesight, Observe, WantedObject, act_of
from planner.mission.skills.skill_state import RoomTourState
from planner.mission.skills.viewpoints import THINGS, in_order, likely_rooms
from planner.perception.snapshot import Sight, Thing
from planner.plan import Bilingual
from planner.site.site_view import SiteView, Target
from tests.planner.mission.skills.scenes import scene
from wire import CameraConfig, Pose2


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
