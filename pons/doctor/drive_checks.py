"""Check the drive of robot.toml: its port, how often it reports, who has tried it.

Opens no port: opening one resets most Arduinos, and a bridge may drive by it.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from devices import PORT_CURES, list_adapters
from devices.port_listing import describe_port
from pons.doctor.finding import BilingualWords, HealthFinding, fail, ok
from pons.doctor.running_process import hear_state
from pons.robot.command import describe_code
from wire import keys
from wire.doors import BRIDGE_DOOR
from wire.ros2_config import ROS2
from wire.sockets import Endpoints, is_listening

if TYPE_CHECKING:
    from wire import RobotDescription, Status

BRIDGE = "bridge"
SILENT_ROW, SILENT_WANT = "ENC_STALE", "drive"


def drive(home: Path, robot: RobotDescription) -> HealthFinding:
    """Say what is wrong with the base's port; or, where nothing is, what its silence costs."""
    port = robot.drive.port
    if port is not None:
        if not is_listening(Endpoints(home).socket(BRIDGE_DOOR)):
            return _judge_port(Path(port)) or _describe_windows(robot)
        status = hear_state(home, robot, keys.STATUS)  # a twin's line is not at that port
        if status is not None and _hears_nothing(status):
            return _judge_port(Path(port), is_ours=True) or _say_silent(port)
    return _describe_windows(robot)


def _hears_nothing(status: Status) -> bool:
    """Tell whether a bridge lacks states: it lost them, or its self test never had one."""
    return SILENT_WANT in status.waiting_for or any(row.row == SILENT_ROW for row in status.rows)


def _judge_port(path: Path, *, is_ours: bool = False) -> HealthFinding | None:
    """Return what would keep a bridge from opening a port, as far as can be seen from outside.

    Args:
        path: of the port.
        is_ours: our own bridge runs, and may hold it.
    """
    entry = describe_port(path)
    if not path.exists():
        others = ", ".join(list_adapters())
        return _wrong(
            "port_missing",
            f"{path} is not there; there is {others or 'no adapter'}",
            f"{path} 不存在；现有：{others or '无'}",
        )
    if not path.is_char_device():
        return _wrong("port_not_serial", f"{path} is no device", f"{path} 不是设备")
    if not entry.is_permitted:
        english, chinese = describe_code("port_forbidden", entry.group)
        return _wrong("port_forbidden", str(path), str(path), (english, chinese))
    strangers = [one for one in entry.holders if not (is_ours and BRIDGE in one.command.split())]
    if strangers:
        first = strangers[0]
        held = f"{first.command} (pid {first.pid})"
        return _wrong("port_busy", f"{path} is held by {held}", f"{path} 被 {held} 占用")
    return None


def _wrong(
    code: str, english: str, chinese: str, cure: tuple[str, str] | None = None
) -> HealthFinding:
    found = BilingualWords(f"{code}: drive.port {english}", f"{code}：drive.port {chinese}")
    return fail("drive", found, BilingualWords(*(cure or PORT_CURES[code])))


def _say_silent(port: str) -> HealthFinding:
    return fail(
        "drive",
        BilingualWords(
            f"base_silent: the bridge gets no state from the base at {port}",
            f"base_silent：桥没有从 {port} 处的底盘收到状态",
        ),
        BilingualWords(
            "its power, TX and RX, drive.kind; logs/bridge.log may say more, and `pons robot find` "
            "once the bridge is down",
            "请检查供电、TX/RX 接线和 drive.kind；参见 logs/bridge.log，停桥后可用 pons robot find",
        ),
    )


def _describe_windows(robot: RobotDescription) -> HealthFinding:
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
