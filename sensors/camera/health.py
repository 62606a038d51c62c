"""Judge what a camera gives: whether pictures come, how often, and whether they change.

Told counts and times. What it says is for people: no wheel waits for a picture.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sensors.camera.grabber import CameraGrabber
    from wire import CameraConfig

WINDOW_S = 3.0
START_S = 6.0
"""A network camera waits for its next whole picture, up to some seconds."""
SILENT_S = 2.0
SLOW_SHARE = 0.5
FROZEN_S = 5.0
"""A real sensor's noise differs in each picture; a driver that hangs repeats one."""
STILL = ("stream", "ros2")
"""A film may show a still, and a simulated robot's camera has no noise."""
STARTING = "camera_starting"

CODES: dict[str, tuple[str, str]] = {
    STARTING: ("it was just opened: wait", "刚刚打开：请稍候"),
    "camera_missing": (
        "plug it in; `pons robot find` lists what is there, [camera] names it",
        "请插好；`pons robot find` 列出现有摄像头，[camera] 应写其中之一",
    ),
    "camera_forbidden": (
        "add your user to the group video, and log in anew",
        "请将用户加入 video 组，然后重新登录",
    ),
    "camera_not_video": (
        "name a camera: `pons robot find` lists those that give pictures",
        "请写一个摄像头：`pons robot find` 列出可用的",
    ),
    "camera_busy": (
        "end the program that holds it, or try a smaller picture or another fourcc",
        "请结束占用它的程序，或改用更小的画面或其他 fourcc",
    ),
    "camera_gone": ("look at its plug, its supply, its network", "请检查插头、供电和网络"),
    "camera_unreachable": (
        "is it on, is the address right, name and password too? Try it in a video player",
        "请检查电源、地址、用户名和密码；可用播放器试一下",
    ),
    "camera_library_missing": (
        "install pyrealsense2, or name another kind of camera",
        "请安装 pyrealsense2，或改用其他类型的摄像头",
    ),
    "camera_silent": ("unplug it and plug it in again", "请拔下后重新插入"),
    "camera_slow": (
        "more light (long exposures), a smaller picture, or a lower camera.rate_hz",
        "请增加光照、缩小画面，或降低 camera.rate_hz",
    ),
    "camera_frozen": ("unplug it and plug it in again", "请拔下后重新插入"),
    "camera_too_large": (
        "a smaller width_px and height_px; of a ros2 camera, in its own driver",
        "请减小 width_px 和 height_px；ros2 摄像头请在其驱动中设置",
    ),
    "camera_picture_unreadable": (
        "the topic must carry whole JPEG or PNG pictures of 8 bits: try rqt_image_view",
        "该话题必须是完整的 8 位 JPEG 或 PNG 图像：请用 rqt_image_view 查看",
    ),
}
"""What cures each, in English and Chinese."""


@dataclass(frozen=True, slots=True)
class CameraVerdict:
    """Name what is wrong with a camera."""

    code: str
    detail: str


class CameraHealth:
    """Follow one camera."""

    def __init__(self, config: CameraConfig) -> None:
        self._config = config
        self._trail: deque[tuple[float, int]] = deque()
        self._opened = self._pictures = 0
        self._opened_s: float | None = None
        self._newest_s: float | None = None
        self.too_large_bytes = 0
        """Of the newest picture, where the wire has no room for it; else 0."""

    def judge(self, camera: CameraGrabber, now_s: float) -> CameraVerdict | None:
        """Return what is wrong now; None where nothing is."""
        self._note(camera, now_s)
        trouble = camera.trouble
        if trouble is not None:
            return CameraVerdict(trouble.code, trouble.detail)
        opened_s = self._opened_s if self._opened_s is not None else camera.began_s
        if self._newest_s is None or self._newest_s < opened_s:
            waited_s = now_s - opened_s
            if waited_s <= START_S:
                return CameraVerdict(STARTING, f"{waited_s:.0f} s ago")
            return CameraVerdict("camera_silent", f"no picture in {waited_s:.0f} s")
        if now_s - self._newest_s > SILENT_S:
            return CameraVerdict("camera_silent", f"no picture for {now_s - self._newest_s:.0f} s")
        still_s = now_s - camera.changed_s
        if self._config.kind not in STILL and still_s > FROZEN_S:
            return CameraVerdict("camera_frozen", f"the same picture for {still_s:.0f} s")
        if self.too_large_bytes:
            return CameraVerdict("camera_too_large", f"{self.too_large_bytes} bytes")
        wanted_hz = self._config.rate_hz
        if now_s - opened_s > START_S and self.rate_hz < SLOW_SHARE * wanted_hz:
            text = f"{self.rate_hz:.1f} pictures a second, {wanted_hz:g} were asked for"
            return CameraVerdict("camera_slow", text)
        return None

    @property
    def rate_hz(self) -> float:
        """Return how many pictures a second came lately."""
        if len(self._trail) < 2:
            return 0.0
        (first_s, first), (last_s, last) = self._trail[0], self._trail[-1]
        return (last - first) / (last_s - first_s) if last_s > first_s else 0.0

    def _note(self, camera: CameraGrabber, now_s: float) -> None:
        if camera.opened != self._opened:
            self._opened, self._opened_s = camera.opened, now_s
            self._trail.clear()
        if camera.pictures != self._pictures:
            self._pictures, self._newest_s = camera.pictures, now_s
        self._trail.append((now_s, camera.pictures))
        while now_s - self._trail[0][0] > WINDOW_S:
            self._trail.popleft()
