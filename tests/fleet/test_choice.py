"""Show who can take an order, which home it may mean, and how several orders are shared out."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import permutations
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fleet.choice import BARRED, Abilities, assign
from fleet.house import HouseRules
from fleet.records import MissionRow
from tests.fleet.test_store import kept_mission


def card(**more: Any) -> dict[str, Any]:
    """Return the card of a robot that knows the kitchen, with more or other fields."""
    kitchen = {"id": "kitchen", "name": {"en": "kitchen", "zh": "厨房"}}
    return {"places": [kitchen], "map_id": "a" * 16, "site": "home", **more}


def said(text: str, way: str = "any", **body: Any) -> MissionRow:
    """Return a mission of a sentence."""
    return replace(kept_mission(), text=text, way=way, body=json.dumps({"language": "en", **body}))


@pytest.mark.parametrize(
    ("mission", "able"),
    [
        (said("go to the kitchen"), ["bare", "eyes"]),
        (said("look whether the kitchen is empty"), ["eyes"]),
        (said("去看看厨房", language="zh"), ["eyes"]),
        (said("去厨房", language="zh"), ["eyes"]),
        (said("do the evening round"), ["eyes"]),
        (said("go to the moon"), ["bare", "eyes"]),  # nobody knows it: a robot tells
        (said("", steps=[{"kind": "look"}]), ["eyes"]),
        (said("", steps=[{"kind": "repeat", "steps": [{"kind": "look"}]}]), ["eyes"]),
        (said("", steps=[{"kind": "go_to", "place": "kitchen"}]), ["bare", "eyes"]),
        (said("", steps=[{"kind": "go_to", "place": "attic"}]), []),
    ],
)
def test_an_order_is_for_those_that_can(mission: MissionRow, able: list[str]) -> None:
    skill = {"name": "evening_round", "en": ["do the evening round"], "zh": []}
    cards = {
        "bare": card(camera=None, languages=["en"], steps=["go_to", "repeat"]),
        "eyes": card(camera="v4l2", languages=["en", "zh"], steps=["go_to", "look", "repeat"],
                     skills=[skill]),
    }  # fmt: skip
    assert Abilities(cards).able(mission, ["bare", "eyes"]) == able


def test_where_no_robot_has_eyes_it_is_left_to_a_robot_to_tell() -> None:
    cards = {"one": card(), "two": card()}
    assert Abilities(cards).able(said("look around"), ["one", "two"]) == ["one", "two"]


@pytest.mark.parametrize(
    ("text", "rules", "homes"),
    [
        ("go to the kitchen", HouseRules(), {"home (r1)": ["r1"], "home (r2)": ["r2"]}),
        ("go to the kitchen", HouseRules(homes={"b" * 16: "cottage"}),
         {"home": ["r1"], "cottage": ["r2"]}),
        ("go to the kitchen in the cottage", HouseRules(homes={"b" * 16: "cottage"}),
         {"cottage": ["r2"]}),
        ("go to the kitchen", HouseRules(homes={"a" * 16: "home", "b" * 16: "home"}),
         {"home": ["r1", "r2"]}),
        ("dance", HouseRules(), {}),
    ],
)  # fmt: skip
def test_which_homes_an_order_may_mean(
    text: str, rules: HouseRules, homes: dict[str, list[str]]
) -> None:
    cards = {"r1": card(), "r2": card(map_id="b" * 16)}  # of the same name, and other content
    assert Abilities(cards).homes(said(text), ["r1", "r2"], rules) == homes


@settings(max_examples=50, deadline=None)
@given(st.integers(1, 4).flatmap(lambda width: st.lists(
    st.lists(st.sampled_from([0.5, 1.0, 2.5, 7.0, BARRED]), min_size=width, max_size=width),
    min_size=1, max_size=4)))  # fmt: skip
def test_orders_are_shared_out_so_that_the_sum_of_ways_is_least(costs: list[list[float]]) -> None:
    pairs = assign(costs)
    assert len({row for row, _ in pairs}) == len({at for _, at in pairs}) == len(pairs)
    assert all(costs[row][at] < BARRED for row, at in pairs)
    rows, columns = range(len(costs)), range(len(costs[0]))
    few, many = sorted((rows, columns), key=len)
    is_flat = len(rows) <= len(columns)

    def price(order: tuple[int, ...]) -> float:
        return sum(costs[a][b] if is_flat else costs[b][a] for a, b in zip(few, order, strict=True))

    best = min(price(order) for order in permutations(many, len(few)))
    whole = sum(costs[row][at] for row, at in pairs) + BARRED * (len(few) - len(pairs))
    assert whole == pytest.approx(best)
