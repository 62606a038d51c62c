"""Check the drive of robot.toml: how often it reports, what its silence costs, who has tried it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pons.doctor.finding import BilingualWords, HealthFinding, fail, ok
from wire.ros2_config import ROS2

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


def trial(robot: RobotDescription) -> HealthFinding:
    """Say whether somebody has tried this robot with its wheels off the ground."""
    made, valid = robot.trial, robot.valid_trial
    if robot.drive.kind == ROS2:
        return ok(
            "trial",
            "a ROS 2 base needs none: its relay proves the dead-man in each self test",
            "ROS 2 底盘不需要测试：每次自检都由中继节点验证看门狗",
        )
    if robot.drive.virtual:
        return ok("trial", "a simulated drive needs none", "仿真驱动不需要测试")
    if valid is not None:
        return ok(
            "trial",
            f"tried on {valid.date}: without a command it stands after {valid.dead_man_s:g} s",
            f"{valid.date} 测试通过：没有指令时 {valid.dead_man_s:g} 秒内停下",
        )
    found = BilingualWords("nobody has tried this robot", "尚未测试过此机器人")
    if made is not None:
        found = BilingualWords(
            f"the trial of {made.date} was of other values of [drive] or [lidar]",
            f"{made.date} 的测试针对的是不同的 [drive] 或 [lidar] 设置",
        )
    cure = BilingualWords(
        "lift its wheels off the ground and run: pons robot try", "把轮子架空后运行：pons robot try"
    )
    return fail("trial", found, cure)
