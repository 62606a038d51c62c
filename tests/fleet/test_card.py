"""Show that a robot which tells nonsense is refused, so that no other notices it."""

from __future__ import annotations

from typing import Any

import pytest

from fleet.card import Card, RobotTold, UsageTold, read_told
from fleet.link import RobotRefusal


@pytest.mark.parametrize(
    ("shape", "told"),
    [
        (Card, {"robot_id": "r", "places": "all"}),
        (Card, {"robot_id": "r", "places": [{"id": 3}]}),
        (Card, {"robot_id": "r", "languages": 7}),
        (Card, {"robot_id": "r", "places": [{"id": "k", "pose": {"x_m": float("nan"), "y_m": 0}}]}),
        (RobotTold, []),
        (RobotTold, {"status": {"drive": {"battery": "full"}}}),
        (RobotTold, {"status": {"base_in_map": {"x_m": "?", "y_m": 0}}}),
        (UsageTold, {"today": {"money": -100.0}}),
        (UsageTold, {"today": {"money": float("nan")}}),
    ],
)
def test_nonsense_is_refused(shape: Any, told: Any) -> None:
    with pytest.raises(RobotRefusal) as refused:
        read_told(shape, told)
    assert refused.value.code == "answer_unread"
    assert refused.value.message["zh"] != refused.value.message["en"]


def test_what_is_known_is_kept_with_what_is_not() -> None:
    told = read_told(Card, {"robot_id": "r", "release": "0.1", "places": [{"id": "k", "new": 1}]})
    assert (told["release"], told["places"][0]["new"], told["steps"]) == ("0.1", 1, [])
    assert read_told(UsageTold, {})["model"] == "?"  # in doubt it has one
