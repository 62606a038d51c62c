"""Name why a calibration ends without a result: a stable code, English and Chinese, the remedy."""

from __future__ import annotations

WORDS: dict[str, tuple[str, str]] = {
    "not_armed": (
        "The robot is not armed; `pons arm`, then again.",
        "机器人未使能；请先执行 pons arm 再重试。",
    ),
    "not_ready": (
        "The bridge is still testing itself; wait for it.",
        "桥接进程仍在自检；请等待。",
    ),
    "busy": (
        "Somebody else moves the robot; pause or cancel the goal, or let go of the stick.",
        "机器人正由他人驱动；请暂停或取消任务，或松开手柄。",
    ),
    "estopped": (
        "A protective stop is pressed or latched; release it, then pons reset and pons arm.",
        "保护性停止已按下或锁存；请释放后执行 pons reset 和 pons arm。",
    ),
    "fault": (
        "The bridge is in FAULT; `pons why` says what to mend.",
        "桥接进程处于故障状态；pons why 会说明如何处理。",
    ),
    "no_bridge": (
        "No bridge speaks; is `pons up` running?",
        "没有收到桥接进程的消息；pons up 在运行吗？",
    ),
    "other_robot_toml": (
        "The bridge runs with another robot.toml than this one; restart it or set PONS_ROBOT.",
        "桥接进程使用的 robot.toml 与此文件不同；请重启或设置 PONS_ROBOT。",
    ),
    "shipped_robot_toml": (
        "This robot.toml came with Pons and is not written to; copy it and set PONS_ROBOT.",
        "此 robot.toml 随 Pons 安装，不会被改写；请复制后用 PONS_ROBOT 指定。",
    ),
    "no_drive": (
        "The drive's own reports do not arrive here.",
        "收不到驱动器的状态报告。",
    ),
    "no_lidar": (
        "No lidar scan arrives, or too few beams come back to judge the room.",
        "没有激光雷达数据，或回波太少，无法判断空间。",
    ),
    "no_gyro": (
        "There is no gyro to compare with; [imu] and inputs.imu of robot.toml name one.",
        "没有可供比较的陀螺仪；请在 robot.toml 的 [imu] 和 inputs.imu 中配置。",
    ),
    "gyro_stands": (
        "The wheels turned and the gyro did not: do they slip, or is its chip dead?",
        "轮子转了而陀螺仪没有变化：是打滑，还是传感器损坏？",
    ),
    "gyro_backwards": (
        "Wheels and gyro turn opposite ways; `pons robot try` tells which of them is wrong.",
        "轮子与陀螺仪方向相反；pons robot try 会指出哪一个有误。",
    ),
    "no_room": (
        "There is too little room; carry the robot to a clear floor.",
        "空间不足；请把机器人移到空旷的地面。",
    ),
    "no_wall": (
        "The lidar sees no flat wall ahead to measure against; use --measured-m, or face a wall.",
        "激光雷达前方没有可供测量的平整墙面；请使用 --measured-m 或正对墙面。",
    ),
    "no_truth": (
        "No simulator tells the truth here; use --reference lidar or --measured-m.",
        "这里没有模拟器真值；请使用 --reference lidar 或 --measured-m。",
    ),
    "no_measure": (
        "A measured distance is missing or no number of metres.",
        "缺少测量距离，或不是以米为单位的数字。",
    ),
    "encoder_fault": (
        "Encoders or drive failed during a run; mend them first (`pons why`).",
        "测量过程中编码器或驱动器出现故障；请先修复（pons why）。",
    ),
    "blocked": (
        "Something came into the way during a run.",
        "测量过程中有障碍物挡路。",
    ),
    "run_lost": (
        "A run was cut short, and again when it was repeated.",
        "测量被中断，重复后仍然中断。",
    ),
    "spread_too_wide": (
        "The runs disagree too much; look for slipping wheels, a loose encoder, an uneven floor.",
        "各次测量结果差异过大，不可信；请检查打滑、编码器松动或地面不平。",
    ),
    "out_of_bounds": (
        "A result lies outside what robot.toml may hold.",
        "测量结果超出 robot.toml 允许的范围。",
    ),
    "robot_toml_shape": (
        "robot.toml is written in a way that can't be edited safely; change it by hand.",
        "robot.toml 的写法无法安全地自动修改；请手动修改。",
    ),
    "not_confirmed": (
        "Nothing was written.",
        "未写入任何内容。",
    ),
}  # fmt: skip


class CalibrationRefusal(Exception):
    """End a calibration; the robot stands and nothing was written."""

    def __init__(self, code: str, detail: str = "") -> None:
        super().__init__(f"{code}: {detail}")
        self.code = code
        self.detail = detail

    def lines(self) -> list[str]:
        """Return the text for a person."""
        english, chinese = WORDS[self.code]
        head = f"{self.code}: {self.detail}" if self.detail else self.code
        return [head, f"  {english}", f"  {chinese}"]


class RunLost(Exception):
    """One run is worth nothing; another may be."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(f"{code}: {detail}")
        self.code = code
        self.detail = detail
