"""Own what a person is told about what can't be used or armed, by the problem's code.

``detail`` beside it names what came and what was expected, for whoever wrote the client.
"""

from __future__ import annotations

from planner.plan import Bilingual

_LENGTH = Bilingual(
    en="The recording is too long: at most 15 seconds and 3 MB. Say one order at a time.",
    zh="录音太长：最多 15 秒、3 MB。请一次只说一条指令。",
)
_BROKEN = Bilingual(
    en="The recording is damaged: its header and its content do not fit. Please record it anew.",
    zh="录音文件已损坏：文件头与内容不符。请重新录制。",
)
_KIND = Bilingual(
    en="This is no recording that can be heard: send a WAV file with 16-bit PCM, 1 or 2 channels, "
    "8 to 48 kHz.",
    zh="无法识别该录音格式：请发送 WAV 文件（16 位 PCM，1 或 2 个声道，8 至 48 kHz）。",
)
_EARS = Bilingual(
    en="Spoken orders can't be heard on this computer; typing works. `pons doctor` says why.",
    zh="本机目前无法识别语音；文字输入不受影响。运行 `pons doctor` 可查看原因。",
)
_AGAIN = Bilingual(
    en="Too much is being heard at once, so this recording was left out. Say it again in a moment.",
    zh="语音识别繁忙，这段录音没有处理。请稍后再说一次。",
)
SAYINGS = {
    "audio_empty": Bilingual(en="The recording is empty.", zh="录音是空的。"),
    "audio_too_short": Bilingual(
        en="The recording is too short to hold an order.", zh="录音太短，听不出指令。"
    ),
    "audio_too_long": _LENGTH,
    "not_wav": _KIND,
    "wav_unsupported": _KIND,
    "wav_truncated": _BROKEN,
    "wav_malformed": _BROKEN,
    "recogniser_unavailable": _EARS,
    "voice_busy": _AGAIN,
    "no_camera": Bilingual(en="This robot has no camera.", zh="这台机器人没有摄像头。"),
    "no_detector": Bilingual(
        en="No detector is set, so things in the picture are not told apart.",
        zh="没有设置检测模型，无法识别画面中的物体。",
    ),
    "detector_down": Bilingual(
        en="The detector does not answer; it is being started anew.",
        zh="检测进程没有响应，正在重新启动。",
    ),
    "camera_silent": Bilingual(
        en="No picture comes from the camera.", zh="摄像头没有传来画面。"
    ),
    "camera_frozen": Bilingual(
        en="The camera sends one and the same picture again and again.",
        zh="摄像头一直发送同一张画面。",
    ),
    "camera_unusable": Bilingual(
        en="The camera's pictures can't be used: is its lens covered?",
        zh="摄像头的画面无法使用，镜头可能被遮住。",
    ),
    "unknown_object": Bilingual(
        en="No such thing is remembered.", zh="没有记住这个物体。"
    ),
    "disk_full": Bilingual(
        en="The disk is full, so nothing is recorded: make room, then arm.",
        zh="磁盘已满，无法记录行驶数据：请清理磁盘后再解锁。",
    ),
    "recorder_down": Bilingual(
        en="Nothing is being recorded, so the robot can't be armed. `pons arm` says why.",
        zh="目前没有记录行驶数据，因此不能解锁。运行 `pons arm` 可查看原因。",
    ),
    "voice_timed_out": _AGAIN,
    "foreign_host": Bilingual(
        en="This address of the robot is not one that the planner knows; PONS_ALLOWED_HOSTS "
        "adds one.",
        zh="规划器不认识您访问机器人所用的地址；可用 PONS_ALLOWED_HOSTS 添加。",
    ),
    "foreign_origin": Bilingual(
        en="Another site's page may not speak to the robot.",
        zh="其他网站的页面不能向机器人发送请求。",
    ),
    "proxy_without_token": Bilingual(
        en="A proxy stands in front of the robot and no token is set, so anybody could drive it. "
        "Set PONS_OPERATOR_TOKEN for the planner; stop works without.",
        zh="机器人前面有代理服务器而未设置令牌，任何人都可能驾驶它。请为规划器设置 "
        "PONS_OPERATOR_TOKEN；停止指令不受影响。",
    ),
    "goal_too_long": Bilingual(
        en="This is too long for an order: at most 4,000 characters. Say it shorter.",
        zh="指令太长：最多 4000 个字符。请说得简短些。",
    ),
    "too_many_goals": Bilingual(
        en="Too many orders came at once. Wait a moment; stop always works.",
        zh="指令过于频繁，请稍候再试；停止指令始终有效。",
    ),
    "too_many_sockets": Bilingual(
        en="Too many pages watch this robot. Close some of them; stop still works.",
        zh="观看这台机器人的页面太多，请关闭一些；停止指令不受影响。",
    ),
    "headers_too_large": Bilingual(
        en="The request's headers are too large; clearing this site's cookies may help.",
        zh="请求头过大；清除该网站的 Cookie 可能有帮助。",
    ),
    "request_timeout": Bilingual(
        en="The request did not arrive in time.", zh="请求未能及时送达。"
    ),
    "body_too_large": Bilingual(
        en="What was sent is too large.", zh="发送的内容过大。"
    ),
    "unsupported_media_type": Bilingual(
        en="What was sent has another type than this address takes.",
        zh="发送内容的类型与该接口不符。",
    ),
}  # fmt: skip


def saying_of(code: str) -> dict[str, dict[str, str]]:
    """Return the sentence for a person as ``message``, where the code has one."""
    return {"message": SAYINGS[code].model_dump()} if code in SAYINGS else {}
