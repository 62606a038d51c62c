"""Say what ``pons robot try`` asks of a person and what it found, in English and Chinese."""

from __future__ import annotations

from typing import Final

from bridge.drive.base_trouble import BASE_TROUBLES
from devices import PORT_CURES

PROMPTS: Final[dict[str, tuple[str, str]]] = {
    "wheels_up": (
        "The wheels will turn. Lift them off the ground, hands and cables away",
        "轮子将会转动。请把轮子架空，手和线缆远离轮子",
    ),
    "hand_left": (
        "Turn the LEFT wheel FORWARD by hand, three whole turns",
        "请用手把左轮向前转三整圈",
    ),
    "hand_right": (
        "Turn the RIGHT wheel FORWARD by hand, three whole turns",
        "请用手把右轮向前转三整圈",
    ),
    "gyro_left": (
        "Turn the whole robot a QUARTER to the LEFT, level, on its stand or lifted",
        "请把整个机器人水平地向左转四分之一圈（可连支架或抬起）",
    ),
    "lidar_clear": (
        "Step away from the robot, so that nothing moves around it",
        "请离开机器人，保证周围没有东西移动",
    ),
    "lidar_front": (
        "Hold a box half a metre in FRONT of the robot, at the lidar's height",
        "请把一个盒子举在机器人正前方半米、与激光雷达同高处",
    ),
    "lidar_left": (
        "Hold the box half a metre to the LEFT of the robot",
        "请把盒子举在机器人左侧半米处",
    ),
    "camera_clear": (
        "Step out of the camera's view, in the light that the robot will have",
        "请离开摄像头画面，并保持机器人工作时的光照",
    ),
    "camera_left": (
        "Look the way the camera looks, and hold your hand half a metre before it, to its LEFT",
        "请与摄像头同向，把手举在它前方半米、偏左处",
    ),
    "camera_cover": (
        "Take your hand away, then cover the camera's lens with it",
        "请把手移开，然后用手盖住摄像头镜头",
    ),
}
"""By what is asked."""

STEPS: Final[dict[str, tuple[str, str]]] = {
    "wheels_up": ("wheels off the ground", "轮子架空"),
    "listen": ("the base speaks, and stands without a command", "底盘有应答，无指令时静止"),
    "hand_left": ("left wheel by hand", "手转左轮"),
    "hand_right": ("right wheel by hand", "手转右轮"),
    "power_left": ("left motor forward", "左电机前转"),
    "power_right": ("right motor forward", "右电机前转"),
    "power_back": ("both motors back, one by one", "两个电机依次后转"),
    "silence": (
        "three silences: how long until the wheels stand (of it braking)",
        "三次不发指令：多久后停下（其中制动）",
    ),
    "gyro_left": ("gyro: the whole robot a quarter to the left", "陀螺仪：整机向左转四分之一圈"),
    "lidar_clear": ("lidar: nothing near", "激光雷达：周围无物"),
    "lidar_front": ("lidar: a box in front", "激光雷达：前方盒子"),
    "lidar_left": ("lidar: a box at the left; where it saw both", "激光雷达：左侧盒子；两者方位"),
    "camera_clear": ("camera: nobody in view", "摄像头：画面中无人"),
    "camera_left": ("camera: a hand at the left", "摄像头：左侧的手"),
    "camera_cover": (
        "camera: its lens covered; size, where the hand was, light let through",
        "摄像头：盖住镜头；尺寸、手的位置、透光",
    ),
    "write": ("written into robot.toml", "写入 robot.toml"),
}
"""By step, in order; the engine tells them, a person reads them."""

REFUSALS: Final[dict[str, tuple[str, str]]] = {
    "not_lifted": (
        "nothing was turned: UP was not typed",
        "没有输入 UP，未转动任何轮子",
    ),
    "trial_shipped": (
        "this robot.toml came with Pons and is not written to: copy it, name the copy by --robot",
        "此 robot.toml 随 Pons 安装，不会被改写；请复制后用 --robot 指定",
    ),
    "trial_virtual": (
        "a simulated drive needs no trial; name your robot's file by --robot (examples: robots/)",
        "仿真驱动不需要测试；请用 --robot 指定机器人自己的文件（robots/ 下有示例）",
    ),
    "trial_base": (
        "measure the wheels, state them in [base]; left out, they are the simulated robot's",
        "请测量轮子并写入 [base]；省略时会使用仿真机器人的尺寸",
    ),
    "trial_ros2": (
        "a ROS 2 base is not tried here: its relay proves the dead-man, its driver knows wheels",
        "ROS 2 底盘不在此测试：中继节点验证看门狗，轮子方向由其驱动负责",
    ),
    "trial_silent": (
        "the base says nothing: is it powered, is this its port? pons robot find tells",
        "底盘没有数据：请检查供电和端口，可用 pons robot find 查看",
    ),
    "trial_other": (
        "another device speaks at this port: set drive.kind and port as pons robot find prints",
        "该端口上是另一种设备：请按 pons robot find 的输出设置 drive.kind 和 port",
    ),
    "trial_stopped": (
        "somebody stopped the trial; the wheels were told to stand",
        "测试被人停止；已命令轮子静止",
    ),
    "trial_unwatched": (
        "the page that watched is gone or hidden: keep it in front while wheels may turn",
        "监视测试的网页已断开或被隐藏：轮子可能转动时请保持网页在前台",
    ),
    "trial_untold": (
        "the operator's key did not fit, so nothing was turned: type it anew",
        "操作员密钥不符，未转动任何轮子：请重新输入",
    ),
    "trial_missing": (
        "this robot was not tried in its present wiring: try it first",
        "当前接线尚未通过测试：请先测试",
    ),
    "trial_config": (
        "robot.toml or its port can't be used: mend what it says, then begin again",
        "robot.toml 或端口无法使用：请按提示修正后重试",
    ),
    "trial_port": (
        "the base's port is not there or is held: plug it in, or end the program that has it",
        "底盘端口不存在或被占用：请插好，或结束占用它的程序",
    ),
    "trial_stop_pressed": (
        "the stop input is pressed, or its contact open: release or wire it (docs/firmware.md)",
        "停止输入被按下或断线：请松开或接好（见 docs/firmware.md）",
    ),
    "trial_rebooted": (
        "the controller began anew in the middle: its supply dips, or its cable is loose",
        "控制器中途重启：供电不足或接线松动",
    ),
    "trial_rolls": (
        "a wheel turns without torque: hold the robot still; is a motor fed past the controller?",
        "没有扭矩时轮子自己在转：请固定机器人，并检查电机是否被供电",
    ),
    "trial_battery": (
        "the battery is at its end: charge it, then try again",
        "电池即将耗尽：请充电后重试",
    ),
    "trial_no_time_out": (
        "without a command the base has not timed out: no dead-man, or another program drives it",
        "没有指令时底盘仍说未超时：它没有看门狗，或有其他程序在驱动它",
    ),
    "hand_none": (
        "no encoder moved: check its supply and both of its lines",
        "编码器没有变化：请检查供电和两根信号线",
    ),
    "hand_swapped": (
        "the other side's encoder moved: swap the encoders' plugs",
        "另一侧的编码器在动：请交换两个编码器的插头",
    ),
    "hand_backwards": (
        "its encoder counts backwards: swap A and B, or ..._ENCODER_SENSE (docs/firmware.md)",
        "编码器方向相反：请交换 A、B 线，或修改 ..._ENCODER_SENSE（见 docs/firmware.md）",
    ),
    "hand_ticks": (
        "the turns don't fit ticks_per_turn: lines of the encoder × 4 × gear",
        "圈数与 ticks_per_turn 不符：应为编码器线数 × 4 × 减速比",
    ),
    "power_none": (
        "the motor does not turn: check its supply, its wires and the driver's standby pin",
        "电机不转：请检查供电、接线和驱动板的待机引脚",
    ),
    "power_swapped": (
        "the other wheel turned: swap the motors' wires",
        "另一侧的轮子在转：请交换两个电机的接线",
    ),
    "power_backwards": (
        "the wheel turned backwards: swap its motor's two wires, or set ..._MOTOR_SENSE",
        "轮子向后转：请交换该电机的两根线，或修改 ..._MOTOR_SENSE",
    ),
    "power_both": (
        "both wheels turned: a bridge between their wires, or the other motor's two are swapped",
        "只命令一个轮子却两个都转：接线短接，或另一个电机的两根线接反",
    ),
    "power_runaway": (
        "a wheel ran far faster than told: its encoder does not count while the motor turns",
        "轮速远高于指令：电机转动时编码器没有计数",
    ),
    "power_speed": (
        "a wheel does not keep its speed: look at FREE_RADPS and the regulation of its firmware",
        "轮速与指令不符：请检查固件的 FREE_RADPS 与调速参数",
    ),
    "dead_man_none": (
        "the base drives on without commands: it is not to be driven",
        "没有指令时底盘仍继续行驶：不能使用",
    ),
    "dead_man_late": (
        "the base stops later than it claims without commands",
        "没有指令时底盘停得比声称的晚",
    ),
    "dead_man_untold": (
        "the base stopped without commands and does not say so",
        "没有指令时底盘停下了，却没有报告",
    ),
    "coasts": (
        "the wheels roll on without torque: short the motors, or fit a brake",
        "失去扭矩后轮子继续滑行：请短接电机或安装制动",
    ),
    "gyro_silent": (
        "the gyro says nothing: inputs.imu = false, where the robot has none (at most 0.3 m/s)",
        "陀螺仪没有数据：若没有陀螺仪，请设置 inputs.imu = false（最高 0.3 m/s）",
    ),
    "gyro_shakes": (
        "the gyro turns while the robot stands: let it stand still; is it fixed to the robot?",
        "机器人静止时陀螺仪仍在转动：请保持静止，并检查其固定",
    ),
    "gyro_none": (
        "the gyro saw no quarter turn: turn the whole robot, not a wheel; does its chip live?",
        "陀螺仪没有检测到四分之一圈：请转动整个机器人，并检查传感器",
    ),
    "gyro_backwards": (
        "the gyro turns the other way: set imu.up to the axis that is named",
        "陀螺仪方向相反：请把 imu.up 设为所示的轴",
    ),
    "gyro_axis": (
        "another axis of the gyro turned: hold the robot level, or set imu.up and imu.forward",
        "转动的是陀螺仪的另一轴：请保持水平，或设置 imu.up 与 imu.forward",
    ),
    "lidar_silent": (
        "the lidar gives no whole scan: pons doctor says more",
        "激光雷达没有完整扫描：请运行 pons doctor",
    ),
    "lidar_nothing": (
        "the lidar did not see what was held up: hold it at the lidar's height, within a metre",
        "激光雷达没有看到举起的物体：请举到与雷达同高、一米以内",
    ),
    "lidar_mirrored": (
        "what stands left is seen right: turn lidar.upside_down round",
        "左侧的物体出现在右侧：请改变 lidar.upside_down",
    ),
    "lidar_turned": (
        "what stands in front is not seen in front: set lidar.yaw_rad",
        "正前方的物体不在正前方：请设置 lidar.yaw_rad",
    ),
    "camera_unread": (
        "the camera gives no pictures: pons doctor says more",
        "摄像头没有画面：请运行 pons doctor",
    ),
    "camera_dark": (
        "the picture is black: take the lid off, or make light",
        "画面是黑的：请取下镜头盖，或开灯",
    ),
    "camera_nothing": (
        "the camera did not see the hand alone: keep robot and light still, hold it at the left",
        "摄像头没有单独看到手：请保持机器人和光照不变，把手举在左侧",
    ),
    "camera_turned": (
        "the hand at the left is seen right: turn camera.upside_down round, or unmirror its driver",
        "左侧的手出现在右侧：请改变 camera.upside_down，或关闭驱动的镜像",
    ),
    "camera_uncovered": (
        "the covered lens changed nothing: this is another camera; pons robot find lists them",
        "盖住镜头后画面没有变化：这是另一个摄像头，可用 pons robot find 查看",
    ),
    **PORT_CURES,
    **BASE_TROUBLES,
}
"""By code; each is preceded by what came."""
