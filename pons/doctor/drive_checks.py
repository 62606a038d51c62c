"""Check the drive of robot.toml: what its silence costs in distance, and if it stops by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.dead_man_file import load_dead_man
from pons.doctor.finding import BilingualWords, HealthFinding, ok, warn

if TYPE_CHECKING:
    from pathlib import Path

    from wire import RobotDescription


def drive(home: Path, robot: RobotDescription) -> HealthFinding:
    """Say after which silence the robot is held, and what is known of the base's own dead-man."""
    words = _windows(robot)
    config = robot.drive
    if config.reports_dead_man:
        return ok("drive", words.en, words.zh)
    seen_s = load_dead_man(home, robot)
    if seen_s is not None:
        return ok(
            "drive",
            f"{words.en}; it was seen to stop by itself after {seen_s:.2f} s",
            f"{words.zh}；已验证它会在 {seen_s:.2f} 秒后自行停车",
        )
    claimed = f"{config.dead_man_s:g}"
    return warn(
        "drive",
        BilingualWords(
            f"{words.en}; nobody has seen it stop by itself, its firmware claims {claimed} s: slow",
            f"{words.zh}；尚未验证它会自行停车（固件声称 {claimed} 秒）：限速行驶",
        ),
        BilingualWords(
            "put its wheels in the air, then: pons robot try", "请架空车轮，然后执行 pons robot try"
        ),
    )


def _windows(robot: RobotDescription) -> BilingualWords:
    config = robot.drive
    state_ms, answer_ms = 1000 * config.encoder_window_s, 1000 * config.answer_window_s
    more_ms = 1000 * config.unseen_s
    english = (
        f"held after {state_ms:.0f} ms without a state, or {answer_ms:.0f} ms without an answer"
    )
    chinese = f"{state_ms:.0f} 毫秒没有状态或 {answer_ms:.0f} 毫秒没有应答即保持停止"
    if more_ms > 0.0:
        english += f"; it reports seldom: {more_ms:.0f} ms more lag in every stopping distance"
        chinese += f"；该底盘反馈较慢：每段制动距离多计 {more_ms:.0f} 毫秒延迟"
    return BilingualWords(english, chinese)
