"""Kill the planner around the moment at which standing orders are due: each once, or told."""

from __future__ import annotations

import time

import pytest

from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import Json

pytestmark = [pytest.mark.e2e, pytest.mark.long, pytest.mark.nightly(keep=1)]

AHEAD_S = 1.5
OFFSETS_S = (-0.05, 0.06)
"""Around the due moment."""
SETTLED_S = 25.0
"""A planner that starts waits 10 s at most for the bridge's word."""


def history_of(robot: Robot, order: Json) -> list[Json]:
    reply = robot.system.http("GET", f"/v1/orders/{order['id']}")
    assert reply.status == 200, reply
    history: list[Json] = reply.body["history"]
    return history


def is_settled(robot: Robot, order: Json) -> bool:
    history = history_of(robot, order)
    return bool(history) and all(firing["state"] != "begun" for firing in history)


@pytest.mark.parametrize("offset_s", OFFSETS_S)
def test_an_order_that_is_due_as_the_planner_is_killed_is_given_once_or_told(
    robot: Robot, offset_s: float
) -> None:
    due_unix_s = time.time() + AHEAD_S
    given = [
        robot.system.http("POST", "/v1/orders", {**deed, "when": {"in_s": AHEAD_S}})
        for deed in ({"text": "say hello"}, {"reminder": "the cake"})
    ]
    assert [reply.status for reply in given] == [201, 201], given
    orders: list[Json] = [reply.body for reply in given]
    before = {goal["id"] for goal in robot.system.goals()}
    time.sleep(max(0.0, due_unix_s + offset_s - time.time()))
    robot.system.kill("planner")
    robot.system.until_served()
    until(
        lambda: all(is_settled(robot, order) for order in orders),
        SETTLED_S,
        "both orders given or told",
        lambda: [history_of(robot, order) for order in orders],
    )
    goals = [goal for goal in robot.system.goals() if goal["id"] not in before]
    for order in orders:
        (firing,) = history_of(robot, order)
        assert firing["count"] == 1
        its_own = [goal["id"] for goal in goals if goal["text"] == order["order"]]
        if firing["state"] == "missed":
            assert firing["reason"] in ("was_off", "interrupted", "held", "bridge_silent")
            assert its_own == []
        else:
            assert its_own == [firing["goal"]]
    robot.judge.assert_never_moves(0.5)
