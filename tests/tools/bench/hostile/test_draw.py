"""A hostile run is drawn from its number alone, and all users and moods have their turns."""

from __future__ import annotations

import json

from tools.bench.confirmation import CLI, HTTP
from tools.bench.hostile.draw import MISSIONS, OF_THE_DRIVE, ORDER, WATCH_S, Mood, draw
from tools.bench.users import BRIDGE, IMU, LIDAR, ROS2, SIM, USERS

RUNS = [draw(number) for number in range(300)]


def test_a_number_draws_the_same_run_every_time() -> None:
    assert [draw(number) for number in range(300)] == RUNS
    assert len({json.dumps(run.record()) for run in RUNS}) == len(RUNS)


def test_every_user_but_those_who_own_the_wheels_has_its_turns_among_the_counted() -> None:
    no_process = {LIDAR, ROS2, IMU}  # the simulator is base, lidar and gyro of its robot
    assert {run.user for run in RUNS} == set(USERS) - {BRIDGE, SIM} - no_process
    assert all(sum(run.user == user for run in RUNS) >= 50 for user in ORDER)
    assert {draw(OF_THE_DRIVE + number).user for number in range(20)} == {SIM}


def test_every_mood_mission_and_way_is_drawn_in_three_hundred_runs() -> None:
    assert {mood for run in RUNS for mood in run.moods} == set(Mood)
    assert {run.mission for run in RUNS} == set(MISSIONS)
    assert {run.way for run in RUNS} == {HTTP, CLI}
    assert any(run.begins_s < 0.0 for run in RUNS)


def test_an_attack_begins_before_the_stop_and_a_run_is_short() -> None:
    for run in RUNS:
        assert run.begins_s < run.stop_s, run
        assert run.stop_s + WATCH_S <= 8.0, run
