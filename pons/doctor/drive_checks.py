"""Check the drive of robot.toml: how often it reports, and what its silence costs in distance."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pons.doctor.finding import HealthFinding, ok

if TYPE_CHECKING:
    from wire import RobotDescription


def drive(robot: RobotDescription) -> HealthFinding:
    """Say after which silence the robot is held, and what of that counts in stopping distances."""
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
    return ok("drive", english, chinese)
