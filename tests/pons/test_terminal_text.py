"""What the API answers becomes lines that a person can read."""

from __future__ import annotations

import pytest

from planner.brain.model_error_codes import REASONS
from pons.goals import language_of
from pons.terminal_text import figures, goal_line, message, robot_lines, stand_in, step_line
from tests.wire.examples import STATUS

OUTCOME = {
    "code": "arrived",
    "message": {"en": "Arrived: kitchen.", "zh": "我到了：厨房。"},
    "asked": {"place": "kitchen", "room": "kitchen", "x_m": 1.5, "y_m": 1.9, "yaw_rad": 0.1},
    "reached": {"place": "kitchen", "room": "kitchen", "x_m": 1.508, "y_m": 1.911, "yaw_rad": 0.2},
    "metres": 2.42,
    "seconds": 10.477,
    "limited_by": ["robot", "obstacle"],
}


@pytest.mark.parametrize(
    ("outcome", "told"),
    [
        (
            OUTCOME,
            (
                "asked kitchen (1.50, 1.90); reached kitchen (1.51, 1.91); metres 2.42 m; "
                "seconds 10.48 s; limited by robot, obstacle"
            ),
        ),
        ({"code": "stopped", "asked": None, "reached": None, "metres": None}, ""),
        ({"limited_by": []}, ""),
        (None, ""),
        ({"reached": {"place": None, "room": "kitchen"}}, "reached kitchen"),
        ({"metres": 0, "seconds": 3}, "metres 0.00 m; seconds 3.00 s"),
        ({"asked": {"place": None, "room": None, "x_m": None}, "seconds": 2.0}, "seconds 2.00 s"),
    ],
)
def test_figures_are_for_people_and_what_is_not_known_is_left_out(
    outcome: dict[str, object] | None, told: str
) -> None:
    assert figures(outcome) == told


def test_messages_speak_the_persons_language() -> None:
    assert message(OUTCOME, "zh") == "我到了：厨房。"
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


def shown(**change: object) -> str:
    said = STATUS.model_dump(mode="json") | change
    return "\n".join(robot_lines({"status": said, "room": None}))


def test_what_is_waited_for_is_named_in_both_languages(monkeypatch: pytest.MonkeyPatch) -> None:
    said = shown(mode="SELFTEST", waiting_for=["drive_echo", "enc_stale", "brand_new"])
    assert "waiting for: drive_echo, enc_stale, brand_new" in said
    assert "the drive's answer" in said
    assert "The drive reports nothing; the robot stops." in said
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    said = shown(mode="SELFTEST", waiting_for=["drive_echo", "enc_stale", "brand_new"])
    assert "驱动应答" in said
    assert "驱动没有反馈，机器人停车。" in said


def test_a_fault_is_told_in_both_languages_with_what_to_do() -> None:
    held = {"reason": "fault", "id": "drive_no_timeout"}
    said = shown(mode="FAULT", held=held, waiting_for=["drive_no_timeout"])
    assert "fault: drive_no_timeout" in said
    assert "waiting for" not in said
    assert said.count("did not time out") == 1


def test_what_holds_a_robot_is_told_where_no_row_says_it() -> None:
    held = {"reason": "fault", "id": "fence"}
    said = shown(mode="HOLD", held=held, waiting_for=[])
    assert "held (fault: fence)" in said
    assert "too near the fence" in said
    stopped = shown(mode="HOLD", held={"reason": "stop", "id": "s1"}, waiting_for=[])
    assert "held (stop)" in stopped


@pytest.mark.parametrize("code", ["robot_mismatch", "fence_mismatch", "map_mismatch"])
def test_a_refused_planner_is_told_in_both_languages_with_what_to_do(code: str) -> None:
    answer = {"id": "p2", "kind": "hello", "accepted": False, "code": code, "detail": "came a"}
    said = shown(owner=None, waiting_for=[], answers=[answer])
    assert f"refused hello of p2: {code}: came a" in said
    assert "`pons up`" in said
    assert "start" not in shown(answers=[answer | {"accepted": True}])


@pytest.mark.parametrize("state", ["lost", "searching"])
def test_a_robot_without_a_pose_says_so_first_in_both_languages(state: str) -> None:
    said = STATUS.model_dump(mode="json")
    lines = robot_lines({"status": said, "room": None, "localizer": state})
    assert lines[0].startswith("The robot")
    well = robot_lines({"status": said, "room": None, "localizer": "tracking"})
    assert well == robot_lines({"status": said, "room": None})


def test_a_robot_that_knows_why_it_has_no_pose_says_that_first() -> None:
    said, message = STATUS.model_dump(mode="json"), {"en": "Put me back.", "zh": "请放回原处。"}
    trouble = {"code": "carried_while_mapping", "message": message}
    robot = {"status": said, "room": None, "localizer": "lost", "localizer_trouble": trouble}
    assert robot_lines(robot)[0] == "Put me back."
    assert "请放回原处。" not in robot_lines(robot)


def test_a_map_that_was_changed_under_way_is_named_first_in_both_languages(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    said = STATUS.model_dump(mode="json")
    robot = {"status": said, "room": None, "localizer": "tracking", "map_id": "a" * 16}
    lines = robot_lines({**robot, "localized_map": "b" * 16})
    well = robot_lines(robot)
    assert well == lines[1:]
    with monkeypatch.context() as patched:
        patched.setenv("LC_ALL", "zh_CN.UTF-8")
        chinese = robot_lines({**robot, "localized_map": "b" * 16})[0]
    for line in (lines[0], chinese):
        assert "a" * 16 in line
        assert "b" * 16 in line
        assert "pons up" in line
    assert chinese.startswith("机器人停着不动")
    assert well == robot_lines({**robot, "localized_map": "a" * 16})


def planned_by(**brain: object) -> dict[str, object]:
    return {"brain": {"name": "offline", "fallback_from": None, **brain}}


@pytest.mark.parametrize("given", [{}, {"brain": None}, planned_by()])
def test_nothing_is_said_of_the_brain_that_was_asked(given: dict[str, object]) -> None:
    assert stand_in(given, "en") == ""


def test_a_stand_in_is_named_with_the_reason_in_both_languages() -> None:
    words = REASONS["timeout"].model_dump()
    given = planned_by(fallback_from="qwen3", fallback_reason="timeout", fallback_message=words)
    said = "offline planned in place of qwen3: The model did not answer in time."
    assert stand_in(given, "en") == said
    assert stand_in(given, "zh") == "offline 代替 qwen3 规划：模型没有及时应答。"
    assert stand_in(planned_by(fallback_from="m", fallback_reason="resting"), "en").endswith(
        "resting"
    )
