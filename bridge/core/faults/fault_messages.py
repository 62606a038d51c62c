"""Give each row its words for a person while it is up, in English and Chinese."""

from __future__ import annotations

WORDS: dict[str, tuple[str, str]] = {
    "BRAIN_LATE": (
        "Pons thinks slowly; driving at half speed.",
        "Pons 响应变慢，半速行驶。",
    ),
    "BRAIN_LOST": ("Pons does not answer; the robot holds.", "Pons 没有响应，机器人停住。"),
    "BRAIN_GONE": (
        "Pons has not answered for 5 seconds; the drive is off. Arm to go on.",
        "Pons 已五秒没有响应，驱动已断开。请重新解锁后继续。",
    ),
    "BRAIN_STALE": (
        "Pons does not see anything new; the robot holds.",
        "Pons 收不到新的数据，机器人停住。",
    ),
    "CMD_STALE": (
        "The newest order to the wheels came too late; the robot holds.",
        "最新指令已过期，机器人停住。",
    ),
    "CMD_BAD": (
        "Too many orders to the wheels made no sense; the robot holds.",
        "收到过多无效指令，机器人停住。",
    ),
    "CMD_FLOOD": (
        "Too many orders to the wheels arrive; the robot holds.",
        "指令过于频繁，机器人停住。",
    ),
    "BUDGET": (
        "The distance or time allowed is used up; a new goal or a resume is needed.",
        "允许的距离或时间已用完，需要新的目标或由人恢复。",
    ),
    "HAND_BUDGET": (
        "Nothing is left for driving by hand, or a stop took it; let go of the stick, then resume.",
        "手动驾驶的额度已用完，或已被停止命令收回；请松开手柄，再由人恢复。",
    ),
    "LIDAR_STALE": (
        "The lidar sends nothing new; the robot holds.",
        "激光雷达没有新数据，机器人停住。",
    ),
    "LIDAR_BLIND": (
        "The lidar sees almost nothing; the robot holds.",
        "激光雷达几乎看不到，机器人停住。",
    ),
    "LIDAR_SECTOR": (
        "The lidar sees nothing to one side; the robot holds. Uncover it, or turn once by hand.",
        "激光雷达有一侧看不到东西，机器人停住。请移开遮挡，或手动原地转一圈。",
    ),
    "NO_RANGE": (
        "Nothing watches for obstacles; the robot holds.",
        "没有障碍物传感器，机器人停住。",
    ),
    "SPEED_ZONE": ("A slow zone limits the speed.", "处于限速区。"),
    "POSE_LOST": (
        "The robot does not know where it is; it holds.",
        "机器人不知道自己的位置，停住。",
    ),
    "POSE_JUMP": (
        "The robot was wrong about where it is; it looks for a new way (after three times: arm).",
        "机器人弄错了自己的位置，正在重新找路（连续三次后需重新解锁）。",
    ),
    "STUCK": ("The wheels should turn but the robot does not move.", "机器人被卡住，无法移动。"),
    "RUNAWAY": (
        "The robot moves faster than it was told; the drive is cut.",
        "机器人速度超出指令，已切断驱动。",
    ),
    "YAW_DISAGREE": ("Wheels and gyro disagree; driving slowly.", "轮速与陀螺仪不一致，低速行驶。"),
    "ENC_STALE": ("The drive reports nothing; the robot stops.", "驱动没有反馈，机器人停车。"),
    "DRIVER_NACK": (
        "The drive does not take commands; the robot stops.",
        "驱动没有执行指令，机器人停车。",
    ),
    "DRIVE_FOREIGN": (
        "The drive follows another's commands; stopped. Restart the drive, then reset.",
        "驱动在执行他人的指令，已停车。请重启驱动，然后复位。",
    ),
    "DRIVE_REBOOT": ("The drive has restarted; arm to go on.", "驱动已重启，请重新解锁后继续。"),
    "OVERCURRENT": (
        "The motors draw too much current; the drive is off.",
        "电机电流过大，驱动已断开。",
    ),
    "BATTERY": ("The battery is low.", "电池电量低。"),
    "DEAD_MAN": (
        (
            "Speed limited: this base has not been seen to stop by itself when the computer falls "
            "silent, or it stops late. Run pons robot try."
        ),
        "尚未验证该底盘在计算机失联时会自行停车，或停得太慢，限速行驶。请执行 pons robot try。",
    ),
    "LOOP_LATE": (
        "This computer is too busy; driving slower or holding.",
        "本机过于繁忙，减速或停住。",
    ),
    "NOT_RT": (
        "This computer gives the robot no right of way over other programs; driving slowly.",
        "本机没有让机器人优先运行，低速行驶。",
    ),
    "ESTOP": (
        "Protective stop. Release the button, then reset.",
        "保护性停车。请松开按钮后复位。",
    ),
}
"""Row id to (English, Chinese). A test holds that every row of the table is here."""
