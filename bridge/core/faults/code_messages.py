"""Give each code that is no row its words for a person, in English and Chinese.

The page's copy (web/src/i18n/codes.json) is printed from here by ``scripts/page_words.py``.
"""

from __future__ import annotations


def _pair(en: str, zh: str) -> tuple[str, str]:
    return en, zh


ORDERS: dict[str, tuple[str, str]] = {
    "stop": ("Somebody said stop.", "有人下达了停止指令。"),
    "disarm": ("Somebody disarmed the robot.", "有人将机器人上锁。"),
}
"""Cause of a stop: an order. A protective stop is a row, ESTOP."""

GATES: dict[str, tuple[str, str]] = {
    "obstacle": _pair(
        "Something stands in the way. Take it away, or send the robot elsewhere.",
        "前方有障碍物。请移开障碍物，或让机器人去别处。",
    ),
    "fence": _pair(
        "The way leads too near the fence. Send the robot elsewhere or steer it away by hand; "
        "where the fence is drawn wrong, change it (docs/fence.md).",
        "路线离围栏太近。请让机器人去别处，或手动将它开离；"
        "如果围栏画得不对，请修改围栏（docs/fence.md）。",
    ),
    "contact": _pair(
        "A bumper is pressed, or the cliff sensor sees no floor ahead. Look what is there and take "
        "it away, or steer the robot slowly away from it by hand.",
        "防撞条被压住，或悬崖传感器探测不到前方地面。请查看并排除，或手动缓慢将机器人开离。",
    ),
}
"""Cause of a stop: the gate that shut the way."""

FAULTS: dict[str, tuple[str, str]] = {
    "fence_missing": _pair(
        "There is no fence, so the robot may not drive. Put a fence.json into the site's folder "
        "and start the bridge anew.",
        "没有围栏，机器人不能行驶。请在场地文件夹中放入 fence.json，然后重新启动安全桥。",
    ),
    "fence_of_another_map": _pair(
        "The fence was drawn on another map. Put this map's fence.json into the site's folder and "
        "start the bridge anew.",
        "围栏属于另一张地图。请在场地文件夹中放入本地图的 fence.json，然后重新启动安全桥。",
    ),
    "encoders_moving": _pair(
        "The wheels turned while the drive should have had no power: the robot rolls or is pushed, "
        "or the drive does not let go. Make it stand still, then reset.",
        "驱动应已断电，车轮却在转动：机器人在滑动、被推动，或驱动没有断开。请让它静止后再复位。",
    ),
    "drive_no_timeout": _pair(
        "The drive was sent nothing and did not time out: if the bridge died, nothing would stop "
        "the wheels. Set the drive's own time-out to robot.toml's drive.timeout_s, then reset.",
        "没有收到指令时，驱动没有超时停止：一旦安全桥中断，车轮将无法停下。"
        "请把驱动自身的超时设为 robot.toml 中的 drive.timeout_s，然后复位。",
    ),
    "drive_moves_on": _pair(
        "The drive was sent nothing and its wheels turned on. Take its power off, mend its own "
        "time-out, then reset.",
        "没有收到指令时，车轮仍在转动。请断开驱动电源，修好驱动自身的超时功能，然后复位。",
    ),
    "stop_too_slow": _pair(
        "The robot braked more slowly than planned, so its torque was cut. See whether something "
        "pushes it, the floor slopes or is slippery, or the brakes are worn; then reset.",
        "制动慢于计划，已切断动力。请检查是否有东西推动它、地面倾斜或湿滑、制动磨损，然后复位。",
    ),
    "stop_too_long": _pair(
        "The stop took longer than planned, so the torque was cut. See whether something pushes "
        "the robot, the floor slopes or is slippery, or the brakes are worn; then reset.",
        "停车用时超过计划，已切断动力。"
        "请检查是否有东西推动它、地面倾斜或湿滑、制动磨损，然后复位。",
    ),
}
"""Why a self test or a stop ended in FAULT."""

WANTS: dict[str, tuple[str, str]] = {
    "drive": ("the drive", "驱动"),
    "drive_echo": ("the drive's answer", "驱动应答"),
    "drive_timeout": ("the drive's own dead-man test", "驱动超时测试"),
    "stop_input": ("the drive to tell its stop input", "驱动报告停止输入"),
    "contact_inputs": ("the drive to tell bumpers and cliff sensor", "驱动报告碰撞和悬崖传感器"),
    "encoders_still": ("still wheels", "车轮静止"),
    "lidar": ("the lidar", "激光雷达"),
    "lidar_baseline": ("enough lidar scans", "足够的激光雷达数据"),
    "lidar_blind": ("the lidar to see something", "激光雷达看到物体"),
    "lidar_stale": ("a lidar scan", "激光雷达数据"),
    "estop_link": ("the stop button's link", "停止按钮连接"),
    "fence_changing": ("the new fence", "新围栏生效"),
    "fence_excludes_robot": ("the robot to be inside its fence", "机器人回到围栏内"),
    "not_standing": ("the robot to stand still", "机器人静止"),
    "stick_not_neutral": ("the joystick to be let go", "松开手柄"),
    "recorder_down": ("the recorder", "记录器"),
    "disk_full": ("room on the disk", "磁盘空间"),
    "estop_pressed": ("the stop button to be released", "松开停止按钮"),
    "estop_just_released": ("the stop button to stay released", "停止按钮保持松开"),
}
"""What is waited for before the robot can be armed or reset, to stand in a list. Rows that keep it
from that come by their own name, in lower case."""

_ANEW = _pair(
    "The bridge and the planner were started with {0} that differ, so the planner may not drive. "
    "End both (`pons up`) and start them again with the same one.",
    "安全桥与规划器启动时使用的{0}不一致，规划器不能驾驶。"
    "请把两者都结束（`pons up`），再用同一份重新启动。",
)


def _anew(en: str, zh: str) -> tuple[str, str]:
    return _pair(_ANEW[0].format(en), _ANEW[1].format(zh))


REFUSALS: dict[str, tuple[str, str]] = {
    "protocol_mismatch": _pair(
        "The bridge and the planner are of different versions of Pons, so the planner may not "
        "drive. Install one version, then start both anew.",
        "安全桥与规划器的 Pons 版本不同，规划器不能驾驶。请安装同一版本，然后重新启动两者。",
    ),
    "robot_mismatch": _anew("robot.toml files", " robot.toml "),
    "fence_mismatch": _anew("fence.json files", " fence.json "),
    "map_mismatch": _anew("maps", "地图"),
    "owner_alive": _pair(
        "Another planner drives this robot. End one of the two.",
        "另一个规划器正在驾驶这台机器人。请结束其中一个。",
    ),
    "not_disarmed": _pair(
        "The robot is armed already, or stays stopped until it is reset.",
        "机器人已经解锁，或需要先复位。",
    ),
    "not_latched": ("There is nothing to reset.", "没有需要复位的状态。"),
    "stopped": ("A stop came at the same moment. Ask again.", "同时收到了停止指令。请重试。"),
    "bad_proof": _pair(
        "The order was not signed with this robot's operator key.",
        "指令没有用这台机器人的操作员密钥签名。",
    ),
    "old_nonce": ("The order was signed too long ago. Ask again.", "指令的签名已过期。请重试。"),
    "repeated": ("This signed order was used already. Ask again.", "该签名指令已使用过。请重试。"),
}
"""Why a planner's hello or a person's order was not taken."""


SENTENCES: dict[str, tuple[str, str]] = {**ORDERS, **GATES, **FAULTS, **REFUSALS}
"""Code to sentence: of a stop's cause, a fault, a refusal. Rows have theirs in ``row_words``."""
