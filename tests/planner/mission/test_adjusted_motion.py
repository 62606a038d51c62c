"""A turn or a drive goes on a little, back a little or to the other side, as a person says."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians
from typing import Any

import pytest

from planner.language.sentence import parse
from planner.mission.events import Submitted
from planner.mission.reception import receive
from planner.plan import Find, GoToObject, Language, MoveStraight, Turn
from tests.planner.mission.fakes import status
from tests.planner.mission.leaning import (
    NOW_S,
    changed_by,
    means,
    newest,
    order_done,
    order_under_way,
)
from wire import Pose2

LEFT = Turn(angle_rad=pi / 2.0)
OTHERS = (
    "no, the other left!",
    "your other left! I meant right",
    "the other way",
    "wrong way!",
    "no, right!",
    "I meant right",
    "no, turn to the right, not left",
    "right, I meant",
    "that's the wrong way, dear, turn right",
)
OTHERS_ZH = ("反了，右边！", "不对，是右边", "不对，往右", "另一边", "我说的是右边", "转反了")


@pytest.mark.parametrize("said", OTHERS)
def test_the_other_side_ends_where_the_right_turn_would_have(said: str) -> None:
    assert means(order_under_way("turn left", LEFT), said, "turn right by 90 degrees")
    assert means(order_done("turn left", LEFT), said, "turn right by 180 degrees")


@pytest.mark.parametrize("said", OTHERS_ZH)
def test_so_it_does_in_chinese(said: str) -> None:
    assert means(order_under_way("往左转", LEFT), said, "向右转90度")


def test_a_turn_under_way_is_undone_as_far_as_it_came() -> None:
    begun = order_under_way("turn left", LEFT)
    last = newest(begun).model_copy(update={"accepted_at": (0.0, 0.0, 0.0)})
    here = status(base_in_map=Pose2(x_m=0.0, y_m=0.0, yaw_rad=radians(40.0)))
    book = replace(begun, missions={last.id: last}, status=here)
    changed = changed_by(book, "no, right!")
    assert changed is not None
    [turn] = changed.steps
    assert isinstance(turn, Turn)
    assert turn.angle_rad == pytest.approx(radians(-130.0))


def test_the_turn_to_the_other_side_comes_in_place_of_the_first() -> None:
    said = "no, the other left!"
    under_way = order_under_way("turn left", LEFT)
    heard = receive(under_way, parse(said), Submitted("new", said, Language.EN), NOW_S)
    assert heard.takes_back == "g0"


@pytest.mark.parametrize(
    ("step", "said", "order"),
    [
        (LEFT, "a bit more", "turn left by 30 degrees"),
        (LEFT, "too far, back a bit", "turn right by 30 degrees"),
        (LEFT, "that was too far, now turn back a little", "turn right by 30 degrees"),
        (MoveStraight(distance_m=-0.5), "too far, come forward a little", "move forward 20 cm"),
        (MoveStraight(distance_m=0.5), "another half metre", "move forward half a metre"),
        (LEFT, "转多了，往回转一点", "向右转30度"),
        (LEFT, "再转一点", "向左转30度"),
        (LEFT, "多了多了，转回来一点", "向右转30度"),
        (MoveStraight(distance_m=0.2), "bit more", "move forward 20 cm"),
        (MoveStraight(distance_m=0.2), "just a little further please", "move forward 20 cm"),
        (MoveStraight(distance_m=0.2), "closer", "move forward 20 cm"),
        (MoveStraight(distance_m=0.2), "back a bit", "move back 20 cm"),
        (MoveStraight(distance_m=-0.2), "a bit more", "move back 20 cm"),
        (MoveStraight(distance_m=0.2), "再来一点", "前进20厘米"),
        (MoveStraight(distance_m=0.2), "再近一点", "前进20厘米"),
        (GoToObject(object="cup"), "a bit closer", "move forward 20 cm"),
    ],
)
def test_a_motion_goes_on_or_back_a_little(step: Any, said: str, order: str) -> None:
    assert means(order_done("an order", step), said, order)


@pytest.mark.parametrize(
    "said",
    [
        *("no more", "no", "right", "that's right", "no, left", "not closer", "more?"),
        *("closer to the table", "a bit more tea", "don't go any further", "the other room"),
        *("不对", "不对，左边", "别再近了", "够了", "不要再转了", "好了"),
    ],
)
@pytest.mark.parametrize("step", [LEFT, MoveStraight(distance_m=0.2)])
def test_another_sentence_moves_nothing(step: Any, said: str) -> None:
    changed = changed_by(order_under_way("an order", step), said)
    assert changed is None or not changed.steps


@pytest.mark.parametrize("said", ["a bit more", "the other left", "再来一点", "反了"])
def test_nothing_is_adjusted_where_nothing_was_turned_or_moved(said: str) -> None:
    for steps in ((Find(object="cup"),), (LEFT, LEFT)):
        assert changed_by(order_under_way("an order", *steps), said) is None


@pytest.mark.parametrize(
    ("step", "said", "order"),
    [
        (MoveStraight(distance_m=0.2), "another 20 cm", "move forward 20 cm"),
        (MoveStraight(distance_m=-1.0), "another metre", "move back a metre"),
        (MoveStraight(distance_m=0.2), "再往前走一米", "前进一米"),
        (LEFT, "another 30 degrees", "turn left by 30 degrees"),
        (LEFT, "再转30度", "向左转30度"),
        (LEFT, "a bit more to the left", "turn left by 30 degrees"),
        (LEFT, "再左一点", "向左转30度"),
        (LEFT, "another metre", None),
        (LEFT, "a bit more to the right", None),
        (LEFT, "再右一点", None),
        (MoveStraight(distance_m=0.2), "another 30 degrees", None),
        (MoveStraight(distance_m=0.2), "a bit more to the left", None),
    ],
)
def test_so_much_more_is_measured_as_the_motion_was(
    step: Any, said: str, order: str | None
) -> None:
    book = order_done("an order", step)
    assert means(book, said, order) if order else changed_by(book, said) is None
