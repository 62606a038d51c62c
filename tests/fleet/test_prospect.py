"""Show what is read of a robot's rehearsal: metres, whether it moves, and through which rooms."""

from __future__ import annotations

import asyncio
import json
import math
from dataclasses import dataclass, field, replace
from typing import Any

import pytest

from fleet.link import RobotAway, RobotRefusal
from fleet.prospect import Prospect, is_inside, look_ahead
from tests.fleet.robot_stub import OUTLINES
from tests.fleet.test_store import kept_mission

CARD = {"places": [{"id": name, "polygon": outline} for name, outline in OUTLINES.items()]}


@dataclass
class Rehearsing:
    """Answer as a robot's link, with one rehearsal; None refuses, an error is raised."""

    answer: Any
    told: dict[str, Any] = field(default_factory=dict)
    rehearses_again_s: float = -math.inf
    asked: int = 0

    @property
    def link(self) -> Rehearsing:
        return self

    async def post(self, _: str, __: Any) -> Any:
        self.asked += 1
        if isinstance(self.answer, Exception):
            raise self.answer
        if self.answer is None:
            raise RobotRefusal(409, "rehearsal_no_plan", "", None)
        return self.answer


def ahead(answer: Any, **more: Any) -> Prospect:
    mission = replace(kept_mission(), **more)
    return asyncio.run(look_ahead(mission, Rehearsing(answer), CARD))  # type: ignore[arg-type]


UNKNOWN_WAY = Prospect(math.inf, moves=True, rooms=None)


@pytest.mark.parametrize(
    ("answer", "prospect"),
    [
        ({"steps": [{"does": "drives", "points": [[5, 1], [3, 1]]}], "length_m": 2.0},
         Prospect(2.0, moves=True, rooms=frozenset({"kitchen", "hall"}))),
        ({"steps": [{"does": "drives", "place": "kitchen"}], "length_m": 2.0},
         Prospect(2.0, moves=True, rooms=frozenset({"kitchen"}))),
        ({"steps": [{"does": "stands"}], "length_m": 0},
         Prospect(0.0, moves=False, rooms=frozenset())),
        ({"steps": [{"does": "open"}], "length_m": 0}, Prospect(0.0, moves=True, rooms=None)),
        ({"steps": [{"does": "shut"}], "length_m": 3}, UNKNOWN_WAY),
        ({"steps": [{"does": "drives", "points": None}]}, replace(UNKNOWN_WAY, rooms=frozenset())),
        (None, UNKNOWN_WAY),
    ],
)  # fmt: skip
def test_a_rehearsal_is_read_and_in_doubt_it_moves_anywhere(
    answer: Any, prospect: Prospect
) -> None:
    assert ahead(answer) == prospect


def test_a_robot_that_answers_no_rehearsal_is_not_asked_for_the_next_order() -> None:
    silent = Rehearsing(RobotAway("no whole answer in 10 s"))
    for _ in range(2):
        mission = kept_mission()
        assert asyncio.run(look_ahead(mission, silent, CARD)) == UNKNOWN_WAY  # type: ignore[arg-type]
    assert silent.asked == 1


def test_steps_are_no_sentence_to_rehearse() -> None:
    say = json.dumps({"steps": [{"kind": "say", "text": "hello"}]})
    assert not ahead(None, text="", body=say).moves
    go = json.dumps({"steps": [{"kind": "go_to", "place": "hall"}]})
    assert ahead(None, text="", body=go) == UNKNOWN_WAY


def test_inside_an_outline() -> None:
    corner = [(0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)]
    inside = [(1, 1), (3, 1), (1, 3)]
    assert [is_inside(at, corner) for at in (*inside, (3, 3), (5, 1))] == [True] * 3 + [False] * 2
