"""Give each row its words for a person while it is up, in English and Chinese."""

from __future__ import annotations

WORDS: dict[str, tuple[str, str]] = {
    "BRAIN_LATE": (
        "The planner answers late; driving at half speed.",
        "规划器响应变慢，半速行驶。",
    ),
    "BRAIN_LOST": ("The planner is silent; the robot holds.", "规划器没有响应，机器人停住。"),
    "BRAIN_GONE": (
        "The planner has been silent for 5 seconds; the drive is off. Arm to go on.",
        "规划器已失联五秒，驱动已断开。请重新解锁后继续。",
    ),
    "BRAIN_STALE": (
        "The planner is alive but thinks on old data; the robot holds.",
        "规划器仍在运行，但使用的是旧数据，机器人停住。",
    ),
    "CMD_STALE": (
        "The newest command is too old; the robot holds.",
        "最新指令已过期，机器人停住。",
    ),
    "CMD_BAD": (
        "Too many commands made no sense; the robot holds.",
        "收到过多无效指令，机器人停住。",
    ),
    "CMD_FLOOD": ("Too many commands arrive; the robot holds.", "指令过于频繁，机器人停住。"),
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
        "A sector of the lidar sees nothing; the robot holds. Uncover it, or turn once by hand.",
        "激光雷达有一个扇区没有回波，机器人停住。请移开遮挡，或手动原地转一圈。",
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
        "The position jumped; the route must be made anew (after three jumps: arm).",
        "定位发生跳变，需要重新规划路线（连续三次后需重新解锁）。",
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
        "Nobody has seen this base stop when the computer falls silent, or it is slow to.",
        "尚未验证该底盘在计算机失联时会自行停车，限速行驶。请执行 pons robot try。",
    ),
    "LOOP_LATE": (
        "This computer wakes the bridge late; driving slower or holding.",
        "本机唤醒安全桥不及时，减速或停住。",
    ),
    "NOT_RT": (
        "No real-time rights on a real drive; at most 0.2 m/s.",
        "真实驱动上没有实时权限，最高 0.2 米每秒。",
    ),
    "ESTOP": (
        "Protective stop. Release the button, then reset.",
        "保护性停车。请松开按钮后复位。",
    ),
}
"""Row id to (English, Chinese). A test holds that every row of the table is here."""
