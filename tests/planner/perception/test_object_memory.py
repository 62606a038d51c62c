"""What is seen is remembered once, moves with what is seen, and fades when it is gone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import hypot, inf, isfinite, nan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.perception.data_association import PlacedDetection
from planner.perception.frame_update import Visible
from planner.perception.interfaces import MapPoint
from planner.perception.object_tracker import (
    MOST_THINGS,
    UNSURE_S,
    WALKED_AWAY_S,
    ObjectMemory,
    aged,
    forget,
    recall,
    remember,
)
from planner.perception.snapshot import Thing
from tests.planner.perception.scenes import box_of, placed, seen, two_room, view


def never(_: Thing) -> bool:
    return False


def always(_: Thing) -> bool:
    return True


def looked(
    *looks: list[PlacedDetection],
    expected: Callable[[Thing], bool] = always,
    step_s: float = 0.2,
    begin: ObjectMemory | None = None,
    from_s: float = 100.0,
) -> ObjectMemory:
    memory = begin or ObjectMemory()
    for number, look in enumerate(looks):
        memory, _ = remember(memory, look, expected, from_s + number * step_s)
    return memory


def told(memory: ObjectMemory) -> list[tuple[str, str | None]]:
    return [(thing.id, thing.color) for thing in memory.things]


CUP, BLUE = placed(), placed(index=1, x_m=1.4, color="blue")
WEAK = placed(score=0.45)
CUT = replace(CUP, whole=False)
BED, SOFA = placed("bed"), placed("sofa", x_m=1.5, score=0.7)


@pytest.mark.parametrize(
    ("looks", "ids"),
    [
        ([[CUP]], ["cup_1"]),  # a strong score counts by itself
        ([[WEAK]], []),
        ([[WEAK], [], [WEAK]], ["cup_1"]),  # two of three
        ([[WEAK], [], []], []),
        ([[WEAK], [], [], [WEAK]], []),
        ([[CUP], [CUP], [CUP]], ["cup_1"]),
        ([[CUT]], []),  # of what is cut off, many things look alike
        ([[CUT], [CUT]], ["cup_1"]),
        ([[CUT], [CUP]], ["cup_1"]),
        ([[CUP, BLUE]], ["cup_1", "cup_2"]),
        ([[CUP], [BLUE]], ["cup_1", "cup_2"]),
        ([[CUP], [placed(x_m=1.1)]], ["cup_1"]),
        ([[CUP], [placed(x_m=1.05, color="blue")]], ["cup_1", "cup_2"]),  # never one cup
        ([[CUP], [placed(x_m=1.05, color="orange")]], ["cup_1"]),  # light may do that
        ([[CUP], [placed("bottle", x_m=1.0)]], ["cup_1", "bottle_1"]),
        ([[CUP], [placed(x_m=2.0)]], ["cup_1", "cup_2"]),
        ([[placed("bed", sigma_m=0.2)], [placed("bed", x_m=1.9, sigma_m=0.2)]], ["bed_1"]),
        ([[placed("sofa"), placed("sofa", x_m=1.5, index=1)]], ["sofa_1", "sofa_2"]),
        ([[BED], [BED], [SOFA]], ["bed_1"]),  # no sofa stands in a bed
        ([[SOFA], [BED], [BED]], ["bed_1"]),
        ([[BED], [placed("sofa", x_m=1.9, sigma_m=0.2)]], ["bed_1", "sofa_1"]),
        ([[placed("table")], [placed("tv")]], ["table_1", "tv_1"]),  # a television on a table
        ([[placed("sofa")], [placed("person")]], ["sofa_1", "person_1"]),
        ([[placed("sofa")], [placed("sofa"), placed("sofa", x_m=1.5, index=1)]], ["sofa_1"]),
    ],
)
def test_what_is_told_of(looks: list[list[PlacedDetection]], ids: list[str]) -> None:
    assert [thing.id for thing in looked(*looks).things] == ids


def test_two_boxes_on_one_thing_are_one() -> None:
    box = (0.0, 0.0, 40.0, 40.0)
    twice = placed(index=1, score=0.7, x_m=1.02, box=(2.0, 0.0, 41.0, 40.0))
    behind = placed(index=2, x_m=2.5, box=(5.0, 5.0, 35.0, 35.0))
    other = placed("bottle", index=3, score=0.5, box=(1.0, 0.0, 40.0, 40.0))
    memory, here = remember(ObjectMemory(), [placed(box=box), twice, other], always, 1.0)
    assert told(memory) == [("cup_1", "red")]
    assert here == {0: "cup_1"}
    memory, _ = remember(ObjectMemory(), [placed(box=box), behind], always, 1.0)
    assert len(memory.things) == 2  # in one line, at two depths


def test_the_place_is_a_mean_that_grows_surer() -> None:
    memory = looked(*[[placed(x_m=1.0 + 0.04 * (-1) ** n)] for n in range(10)])
    (cup,) = memory.things
    assert cup.x_m == pytest.approx(1.0, abs=0.02)
    assert 0.03 <= cup.sigma_m < 0.05
    assert cup.sightings == 10
    assert cup.confidence > 0.9
    far = looked([placed(x_m=1.3, sigma_m=0.5)], begin=memory, from_s=102.0).things[0]
    assert far.x_m - cup.x_m < 0.02  # a poor measurement moves it little


def test_what_is_looked_at_and_not_seen_is_forgotten_and_what_is_out_of_sight_is_not() -> None:
    memory = looked([CUP], [CUP], [CUP])
    assert told(looked(*[[]] * 5, begin=memory, from_s=101.0)) == told(memory)
    doubted = looked(*[[]] * 5, begin=memory, from_s=101.0).things[0]
    assert doubted.confidence < memory.things[0].confidence
    assert looked(*[[]] * 50, begin=memory, from_s=101.0).things == ()
    away = looked(*[[]] * 50, begin=memory, from_s=101.0, expected=never)
    assert away.things == memory.things
    rare = looked(*[[]] * 2, begin=memory, from_s=1e6, step_s=1e5)  # time alone doubts nothing
    assert rare.things != ()


def test_a_person_walks_and_is_never_joined_over_a_gap() -> None:
    def at(x_m: float) -> list[PlacedDetection]:
        return [placed("person", x_m=x_m, color=None)]

    walking = looked(*[at(0.2 * n) for n in range(10)], expected=never)
    assert [thing.id for thing in walking.things] == ["person_1"]
    assert walking.things[0].x_m == pytest.approx(1.8, abs=0.15)
    later = looked(at(1.8), begin=walking, from_s=120.0, expected=never)
    assert [thing.id for thing in later.things] == ["person_1", "person_2"]
    assert [t.id for t in aged(later, 102.0 + WALKED_AWAY_S).things] == ["person_2"]
    cups = looked([CUP])
    assert aged(cups, 1e7) is cups  # a cup stays where it is


def test_what_was_never_sure_is_let_go() -> None:
    memory = looked([WEAK], expected=never)
    assert len(memory.kept) == 1
    assert aged(memory, 100.0 + 2 * UNSURE_S).kept == ()


def test_numbers_are_not_given_twice() -> None:
    memory = forget(looked([CUP, BLUE]), "cup_2")
    assert told(memory) == [("cup_1", "red")]
    assert told(looked([BLUE], begin=memory)) == [("cup_1", "red"), ("cup_3", "blue")]
    again = recall(looked([CUP, BLUE]).things, 200.0)
    assert told(looked([placed(x_m=5.0)], begin=again, from_s=200.0))[-1][0] == "cup_3"
    assert forget(again, None).things == ()


def test_no_more_is_kept_than_there_is_room_for() -> None:
    things = [
        replace(looked([CUP]).things[0], id=f"cup_{n}", confidence=0.2 + 0.7 * (n % 7) / 7)
        for n in range(MOST_THINGS + 100)
    ]
    kept = recall(things, 200.0).things
    assert len(kept) == MOST_THINGS
    assert min(thing.confidence for thing in kept) > 0.2


def test_rubbish_is_no_thing() -> None:
    spots = [
        MapPoint(nan, 0.0, 0.0, 0.1),
        MapPoint(0.0, inf, 0.0, 0.1),
        MapPoint(0.0, 0.0, 0.0, nan),
        MapPoint(0.0, 0.0, 0.0, 0.0),
    ]
    look = [replace(CUP, index=n, spot=spot) for n, spot in enumerate(spots)]
    assert looked([*look, replace(CUP, score=nan), replace(CUP, score=0.0)]).kept == ()


_number = st.floats(-3.0, 3.0) | st.sampled_from([nan, inf, -inf, 1e308])
_placed = st.builds(
    lambda label, x, y, sigma, score, color, left: replace(
        placed(label, score=score, color=color, box=(left, 0.0, left + 30.0, 30.0)),
        spot=MapPoint(x, y, 0.5, sigma),
    ),
    st.sampled_from(["cup", "person", "sofa", "thing"]), _number, _number,
    st.floats(0.01, 1.0) | st.just(nan), st.floats(0.0, 1.0) | st.just(nan),
    st.sampled_from([None, "red", "blue"]), st.floats(0.0, 200.0),
)  # fmt: skip
_looks = st.lists(st.lists(_placed, max_size=5), max_size=6)


@settings(max_examples=50)
@given(_looks, st.booleans(), st.randoms(use_true_random=False))
def test_laws_of_memory(looks: list[list[PlacedDetection]], look_at: bool, random: object) -> None:
    """No NaN, no id twice, confidence within bounds, ages never negative, and no order counts."""
    looks = [[replace(p, index=n) for n, p in enumerate(look)] for look in looks]
    mixed = [random.sample(look, len(look)) for look in looks]  # type: ignore[attr-defined]
    expected = always if look_at else never
    memory = looked(*looks, expected=expected)
    assert memory == looked(*mixed, expected=expected)
    assert len({kept.thing.id for kept in memory.kept}) == len(memory.kept)
    for thing in (kept.thing for kept in memory.kept):
        assert all(map(isfinite, (thing.x_m, thing.y_m, thing.z_m, thing.sigma_m)))
        assert 0.0 < thing.confidence < 1.0
        assert thing.first_s <= thing.seen_s
        assert hypot(thing.x_m, thing.y_m) < 5.0


def test_of_two_boxes_alike_the_surer_place_counts_in_any_order() -> None:
    sure, unsure = (
        replace(CUP, index=n, spot=MapPoint(0.0, 0.0, 0.5, s)) for n, s in ((0, 0.5), (1, 1.0))
    )
    assert looked([sure, unsure]).things == looked([unsure, sure]).things


def test_a_thing_is_missed_only_where_it_would_show() -> None:
    at, site = view(1.0, 1.5), two_room()
    box, depth_m = box_of(at, 2.2, 1.5, 0.3, 0.2)
    ball = replace(
        looked([placed("ball", 2.2, 1.5)]).things[0], z_m=0.3, label="ball", x_m=2.2, y_m=1.5
    )
    before = seen("person", (box[0] - 5, 0.0, box[2] + 5, 240.0), depth_m - 0.6)
    beside = seen("person", (0.0, 0.0, 40.0, 240.0), depth_m - 0.6)
    cases = {
        "there": (Visible(at, site.grid, ()), ball, True),
        "a person beside": (Visible(at, site.grid, (beside,)), ball, True),
        "a person before it": (Visible(at, site.grid, (before,)), ball, False),
        "behind the robot": (Visible(view(1.0, 1.5, 3.1), site.grid, ()), ball, False),
        "at the edge": (Visible(view(1.0, 1.5, 0.52), site.grid, ()), ball, False),
        "behind a wall": (Visible(at, site.grid, ()), replace(ball, x_m=4.6), False),
        "too small to tell": (
            Visible(at, site.grid, ()), replace(ball, label="fork", x_m=2.6), False
        ),
    }  # fmt: skip
    assert {name: judge(thing) for name, (judge, thing, _) in cases.items()} == {
        name: shows for name, (_, _, shows) in cases.items()
    }
