"""Give the words of ``pons up``: cures of what it refused, in Chinese, and orders to try."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from devices import PORT_CURES
from pons.http import PlannerDown, PlannerProblem, call
from pons.terminal import command_path, pick, speaks_chinese
from pons_assets import ROOT

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from pons.settings import LaunchSettings

ASKED_S = 1.0
"""The planner is not waited for any longer: who asks watches the processes."""
_CODE: Final = re.compile(r"\b([a-z0-9]+(?:_[a-z0-9]+)+): ")
CHINESE: Final[Mapping[str, str]] = {
    "robot_toml_missing": "找不到或无法读取 robot.toml：请检查 --robot 的路径",
    "robot_toml_syntax": "robot.toml 不是完整的 TOML：请修正所示的行，或恢复旁边的 .bak-… 副本",
    "robot_toml_invalid": "robot.toml 中有未知的键或不允许的值：请按上面所示修改",
    "twin_needless": "机器人本来就是仿真的：请去掉 --twin",
    "lidar_of_another_world": "激光雷达是真实的，而底盘是仿真的：请加 --twin，或两者都用真实的",
    "camera_of_another_world": "摄像头是真实的，而底盘是仿真的：请加 --twin，或两者都用真实的",
    "home_unwritable": "无法写入状态目录：请把 PONS_HOME 设为可写的目录",
    "disk_full": "磁盘空间不足：请删除旧录制文件，或把 PONS_HOME 设到更大的磁盘",
    "port_in_use": "网页端口已被占用：请停止占用者，或用 --port 另选",
    "setup_needless": "此机器人不需要设置：请去掉 --set-up",
    "already_running": "同一状态目录中已有机器人在运行：请先停止它，或另设 PONS_HOME",
    "not_ready": "启动超时：请查看日志",
    "operator_key_missing": "真实底盘需要操作员密钥：请运行 `pons key new`",
    "operator_key_exposed": "操作员密钥可被他人读取：请执行 chmod 600",
    "fence_missing": "场地没有围栏：请在场地目录中放入 fence.json",
    "fence_invalid": "fence.json 中有未知的键或不允许的值：请修正，或恢复旧的副本",
    "fence_degenerate": "fence.json 中有一条边界没有面积：请修正它的角",
    "fence_crosses_itself": "fence.json 中有一条边界自相交：请修正它的角",
    "fence_empty": "fence.json 的禁入区盖住了所有允许的区域：请缩小禁入区",
    "fence_too_large": "fence.json 过大：请减少边界的角",
    "map_missing": "站点没有可读取的 map.yaml：请检查 --site 的路径",
    "map_image_missing": "map.yaml 没有写明图像，或该图像无法读取",
    "map_image_outside": "map.yaml 写明的图像不在站点目录内",
    "settings_malformed": "settings.toml 中有未知的键、不允许的值或语法错误：请按上面所示修改",
    "settings_unreadable": "无法读取 settings.toml：请检查它的权限",
    "model_incomplete": "[model] 不完整：请填写上面所缺的键",
    "model_url": "[model] 的 url 不可用：请填写普通的 http 或 https 地址",
    "model_offhost": "人们说的话会离开本机：若确实需要，请在 [model] 中设 allow_offhost = true",
    "model_key": "[model] 的密钥为空或缺失：请检查所写的文件或环境变量",
    "budget_contradictory": "[budget] 与其他设置矛盾：请按上面所示修改",
    "voice_url": "[voice] 的 url 不可用：请填写普通的 http 或 https 地址",
    "voice_offhost": "人们的声音会离开本机：若确实需要，请在 [voice] 中设 allow_offhost = true",
    "voice_key": "[voice] 的密钥为空或缺失：请检查所写的文件或环境变量",
    "voice_folder": "[voice] 的 folder 中没有完整的流式模型：请补齐上面所缺的文件",
    "voice_package": "缺少 sherpa-onnx：请运行 pip install 'pons-robot[sherpa]'",
    "voice_contradictory": "[voice] 中 url 与 folder 只能有一个：请去掉其中之一",
    "speech_url": "[speech] 的 url 不可用：请填写普通的 http 或 https 地址",
    "speech_offhost": "机器人说的话会离开本机：若确实需要，请在 [speech] 中设 allow_offhost = true",
    "speech_key": "[speech] 的密钥为空或缺失：请检查所写的文件或环境变量",
    "speech_incomplete": '[speech] engine = "server" 需要 url：请填写',
    "speech_program": "[speech] 需要的程序没有安装：请安装上面所示的程序",
    "ros2_former_keys": (
        "Pons 现在只通过 pons_ros2 软件包与 ROS 2 机器人通信（取代中继节点和 rosbridge）："
        "请在机器人上用 `pons robot node ~/ros2_ws/src/pons_ros2` 写出它，`colcon build`，"
        "`pip install 'eclipse-zenoh>=1.10,<1.11'`，再运行 `ros2 launch pons_ros2 pons.launch.py`；"
        "[ros2] 中改写 node，话题写入机器人上的 pons.yaml，如上所示（docs/ros2.md）"
    ),
    "ros2_not_configured": "请在 robot.toml 中添加 [ros2] 部分",
    **{code: chinese for code, (_, chinese) in PORT_CURES.items()},
}
"""By code: what a person does about it."""
SEARCHES = (
    (
        "      the robot is looking for where it is, and stands still. On that page press"
        " “The robot is here …”"
    ),
    "      机器人正在寻找自己的位置，期间停着不动。请在该网页上点击“机器人在这里……”",
)
SET_UP = "set-up: no bridge, nothing drives; try the robot on that page", "设置模式：请在网页上测试"
NO_LIDAR = "; no [lidar]: it will stand (docs/lidars.md)", "；没有 [lidar]：机器人不会行驶"
CHANGED_BACK = (
    "so what ran before runs again; its page is where it was",
    "因此恢复原来的运行；网页不变",
)
PAIR = (
    "to sign with a telephone instead of typing the key: pons people pair",
    "用手机签名而不必输入密钥：pons people pair",
)
UNREACHED = "not reached yet: dialled until it answers", "尚未连上机器人：会一直重试，网页可用"


def chinese_cure(refusal: str) -> str | None:
    """Return the cure of the first known code in a refusal; None where none is known."""
    known = (CHINESE.get(code) or _detector_flaw(code) for code in _CODE.findall(refusal))
    return next((words for words in known if words is not None), None)


def _detector_flaw(code: str) -> str | None:
    """Return why a detector's file was refused; None where the code is none of those."""
    from planner.language.catalogue import UnknownMessage, say  # late: `pons status` is here too

    try:
        return f"{say(f'vision_failure.{code}').zh}：请按上面所示修改 [vision]"
    except UnknownMessage:
        return None


def chinese_line(refusal: str) -> str:
    """Return the cure as a line below a refusal, where the person reads Chinese; else empty."""
    cure = chinese_cure(refusal) if speaks_chinese() else None
    return "" if cure is None else f"\n  {cure}"


def drives_to_try(settings: LaunchSettings) -> str:
    """Return an order for a room of the planner's: what reads a site itself would stay loaded."""
    try:
        places = call(settings, "GET", "/v1/capabilities", timeout_s=ASKED_S)["places"]
    except (PlannerDown, PlannerProblem):
        places = []  # it is ready, and tells more to who asks it
    say = f"{command_path()} say"
    names = [place["name"] for place in places if place["kind"] == "room"]
    if not names:
        return pick(f'{say} "go home"', f"{say} 回家")
    return pick(f'{say} "go to the {names[0]["en"]}"', f"{say} 去{names[0]['zh']}")


def what_to_try(settings: LaunchSettings, *, arms: bool = False) -> str:
    """Return a line for a person who has just started a robot.

    Args:
        settings: of the launch.
        arms: whether a person must arm it first, as one of metal.
    """
    pons = command_path()
    first = f"{pons} arm   then " if arms else ""
    if settings.mapping is not None:
        # No distance: nobody knows yet how much room there is ahead.
        explore = pick('"explore the house"', "探索一下房子")
        return f"try: {first}{pons} say {explore}, then: {pons} map {settings.mapping}"
    return f"try: {first}{drives_to_try(settings)}   {pons} stop"


def brain_example(home: Path, root: Path = ROOT) -> str:
    """Return a command to try on a robot that has no planner; a wheel brings no examples."""
    example = root / "examples" / "external_brain.py"
    if example.is_file():
        return f"python {example} --home {home}"
    return f"a brain of your own with --home {home}, as examples/external_brain.py of a checkout is"
