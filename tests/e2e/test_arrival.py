"""A sentence moves the robot: in both languages, by shell and by HTTP, and the record tells it."""

from __future__ import annotations

import time

import pytest

from tests.e2e.robot import SETTLE_S, Robot
from tests.e2e.system import ENDED

pytestmark = [pytest.mark.e2e, pytest.mark.long]


def test_an_english_sentence_in_a_shell(robot: Robot) -> None:
    place, began_s = robot.elsewhere(), time.monotonic()
    done = robot.system.pons("say", f"go to the {place.name.en}")
    assert done.returncode == 0, (done.stdout, done.stderr)
    assert f"Arrived: {place.name.en}." in done.stdout
    robot.assert_there(place)
    robot.assert_figures(robot.system.goals()[0], place, began_s)


def test_a_chinese_sentence_over_http(robot: Robot) -> None:
    place, began_s = robot.elsewhere(), time.monotonic()
    goal = robot.system.give(f"去{place.name.zh}")
    assert goal["language"] == "zh"
    ended = robot.arrive(place, goal)
    robot.assert_figures(ended, place, began_s)
    assert place.name.zh in ended["outcome"]["message"]["zh"]


def test_several_places_in_order_and_back(robot: Robot) -> None:
    began, began_s = robot.judge.truth.base_in_map, time.monotonic()
    near = robot.elsewhere()
    goal = robot.system.give(f"go to the kitchen, then the {near.name.en}, then come back")
    ended = robot.system.until_goal(goal["id"], *ENDED, limit_s=55.0)
    assert ended["state"] == "succeeded", (ended, robot.judge.describe())
    first, second, back = ended["plan"]["steps"]
    assert [first["place"], second["place"], back["kind"]] == ["kitchen", near.id, "come_back"]
    assert first["reached"]["room"] == "kitchen"
    assert second["reached"]["place"] == near.id
    assert all(step["state"] == "succeeded" for step in (first, second, back))
    pose = robot.judge.truth.base_in_map
    assert abs(pose.x_m - began.x_m) < 0.25
    assert abs(pose.y_m - began.y_m) < 0.25
    robot.judge.until_standing(SETTLE_S)
    robot.judge.assert_no_contact()
    driven_m = robot.judge.path_m(began_s)
    assert abs(ended["outcome"]["metres"] - driven_m) < 0.1 + 0.1 * driven_m
