"""What the API answers becomes lines that a person can read."""

from __future__ import annotations

from pons.goals import language_of
from pons.texts import figures, goal_line, message, robot_lines, step_line

OUTCOME = {
    "code": "arrived",
    "message": {"en": "Arrived: kitchen.", "zh": "已到达：厨房。"},
    "asked": {"place": "kitchen", "room": "kitchen", "x_m": 1.5, "y_m": 1.9, "yaw_rad": 0.1},
    "reached": {"place": "kitchen", "room": "kitchen", "x_m": 1.508, "y_m": 1.911, "yaw_rad": 0.2},
    "metres": 2.42,
    "seconds": 10.477,
    "limited_by": ["robot", "obstacle"],
}


def test_figures_are_for_people() -> None:
    assert figures(OUTCOME) == (
        "asked kitchen (1.50, 1.90); reached kitchen (1.51, 1.91); metres 2.42 m; "
        "seconds 10.48 s; limited by robot, obstacle"
    )


def test_what_is_not_known_is_left_out() -> None:
    bare: dict[str, object] = {
        "code": "stopped",
        "asked": None,
        "reached": None,
        "metres": None,
        "limited_by": [],
    }
    assert figures(bare) == ""
    assert figures(None) == ""
    assert figures({"reached": {"place": None, "room": "kitchen"}}) == "reached kitchen"


def test_a_whole_number_of_metres_is_a_figure_too() -> None:
    assert figures({"metres": 0, "seconds": 3}) == "metres 0.00 m; seconds 3.00 s"


def test_messages_speak_the_persons_language() -> None:
    assert message(OUTCOME, "zh") == "已到达：厨房。"
    assert message(OUTCOME, "fr") == "Arrived: kitchen."
    assert message(None, "en") == ""


def test_the_language_is_that_of_the_words() -> None:
    assert language_of("go to the kitchen") == "en"
    assert language_of("去 kitchen") == "zh"


def test_steps_and_goals_say_why() -> None:
    step = {"kind": "go_to", "place": "kitchen", "state": "failed", "reason": "no_route"}
    assert step_line(2, step) == "  2. go_to kitchen: failed (no_route)"
    goal = {"id": "g1", "state": "paused", "reason": "stop", "text": "去厨房"}
    assert goal_line(goal) == "g1  paused (stop)  '去厨房'"


def test_a_silent_bridge_is_said() -> None:
    assert robot_lines({"status": None}) == ["bridge: no status heard"]


def test_a_turn_asks_for_no_place() -> None:
    turned = {"asked": {"place": None, "room": None, "x_m": None, "y_m": None}, "seconds": 2.0}
    assert figures(turned) == "seconds 2.00 s"
