"""Name what is wrong between Pons and a ROS 2 base, with the cure in English and Chinese."""

from __future__ import annotations

from dataclasses import dataclass

STARTING = "ros2_starting"
_START = "ros2 launch pons_ros2 pons.launch.py"
_INSTALL = f"install pons_ros2 on the robot (docs/ros2.md) and start `{_START}` there"
_INSTALL_ZH = f"请在机器人上安装 pons_ros2（docs/ros2.md）并运行 `{_START}`"
CODES: dict[str, tuple[str, str]] = {
    STARTING: ("it was just reached: wait", "刚刚连上：请稍候"),
    "ros2_not_configured": (
        "add the part ros2; robots/ros2_diff_drive.toml shows one",
        "请添加 ros2 部分；可参考 robots/ros2_diff_drive.toml",
    ),
    "ros2_no_node": (f"{_INSTALL}; look at ros2.node", f"{_INSTALL_ZH}；并检查 ros2.node"),
    "ros2_node_gone": (
        "the robot stands by its node's dead-man; it is dialled again",
        "机器人已由其节点的超时保护停下；正在重新连接",
    ),
    "ros2_relay_silent": (
        f"it was there; look at its terminal, and start `{_START}` again",
        f"节点曾经在线；请查看它的终端并重新运行 `{_START}`",
    ),
    "ros2_relay_key": (
        "put its key file at $PONS_HOME/relay.key (mode 0600), or start the node without",
        "请将节点的密钥文件放到 $PONS_HOME/relay.key（权限 0600），或不带密钥启动节点",
    ),
    "ros2_two_robots": (
        "one robot a domain: end the other (a killed one counts for 20 s) or change ROS_DOMAIN_ID",
        "每个域只能有一个机器人：请关闭另一个（被强制结束的仍计入 20 秒）或修改 ROS_DOMAIN_ID",
    ),
    "ros2_no_base": (
        "start the base's own driver, or name its topic in the node's parameter cmd_vel",
        "请启动底盘自己的驱动，或在节点参数 cmd_vel 中写它的话题",
    ),
    "ros2_cmd_vel_type": (
        "name a topic of Twist or TwistStamped",
        "请填写 Twist 或 TwistStamped 类型的话题",
    ),
    "ros2_cmd_vel_shared": (
        "the node must be alone there: end the other (Nav2, a joystick), or name another topic",
        "该话题上只能有此节点发布：请关闭其他发布者（Nav2、手柄），或改用其他话题",
    ),
    "ros2_topic_missing": (
        "start what publishes it, or name the topic that there is",
        "请启动发布它的节点，或填写实际存在的话题",
    ),
    "ros2_topic_type": (
        "name the topic of the expected type",
        "请填写类型正确的话题",
    ),
    "ros2_no_mounting": (
        "start robot_state_publisher or a static_transform_publisher that says where it sits",
        "请启动 robot_state_publisher 或 static_transform_publisher 以说明其安装位置",
    ),
    "ros2_unreadable": (
        "look at it with `ros2 topic echo`; what is not a number moves nothing",
        "请用 `ros2 topic echo` 查看；非数字不会驱动机器人",
    ),
    "ros2_clock": (
        "base, sensors and node must share one clock (chrony; use_sim_time for all or none)",
        "底盘、传感器与节点必须使用同一时钟（chrony；use_sim_time 要么都用要么都不用）",
    ),
    "ros2_odom_slow": (
        "raise the base's publishing rate to 25 Hz or more; at less the bridge holds (ENC_STALE)",
        "请将底盘的发布频率提高到 25 Hz 以上；过慢时桥会保持停止（ENC_STALE）",
    ),
    "ros2_topic_silent": (
        "its publisher is there and says nothing: look at its log",
        "发布者在线但没有消息：请查看其日志",
    ),
}
"""What cures each, in English and Chinese."""


@dataclass(frozen=True, slots=True)
class Ros2Trouble:
    """Hold what is wrong: a code, and what came where something else was expected."""

    code: str
    found: str

    @property
    def detail(self) -> str:
        """Return it with its cure, in English, as long as the wire carries."""
        return f"{self.found}; {CODES[self.code][0]}"[:400]


def known_code(code: str) -> str:
    """Return a code that a robot said, or what stands for one that a newer package has."""
    return code if code in CODES else "ros2_relay_silent"


class TopicFailure(Exception):
    """Raised where a topic gave nothing that can be used; carries what people are told."""

    def __init__(self, trouble: Ros2Trouble) -> None:
        super().__init__(trouble.detail)
        self.trouble = trouble
