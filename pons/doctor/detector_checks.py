"""Check the detector: open its file in a process of its own, as the robot does, and try it."""

from __future__ import annotations

import asyncio
import os
from typing import TYPE_CHECKING

from planner.perception import VisionFailure, VisionWorker
from planner.perception.failure import REFUSALS
from planner.settings import VisionSettings, load_settings
from planner.settings.vision import DECODERS
from pons.doctor.finding import BilingualWords, HealthFinding, fail, ok, warn
from wire import ConfigError

if TYPE_CHECKING:
    from pathlib import Path

    from planner.perception import DetectorInfo
    from wire import RobotDescription

NAME = "detector"
OPEN_S = 60.0
_LAYOUTS = ", ".join(DECODERS)
_FIX = BilingualWords(
    f"try it with `pons detect PICTURE --model FILE`; layouts that are read: {_LAYOUTS} "
    "(docs/vision.md says what each code asks for)",
    f"请用 `pons detect 图片 --model 文件` 试验；可读取的输出格式：{_LAYOUTS}"
    "（每个代码的处理办法见 docs/vision.md）",
)


def detector(home: Path, robot: RobotDescription) -> HealthFinding:
    """Say what looks, how its output is read, and what it knows; or why it can't look."""
    if robot.camera.kind == "none":
        return ok(NAME, "none: there is no camera", "无：没有摄像头")
    try:
        chosen = load_settings(home, os.environ).vision
    except ConfigError as wrong:
        cure = BilingualWords("mend settings.toml", "请修正 settings.toml")
        return fail(NAME, BilingualWords(str(wrong), str(wrong)), cure)
    try:
        about = asyncio.run(_open(chosen))
    except VisionFailure as failure:
        code, words = failure.code, failure.message
        found = BilingualWords(f"{code}: {words['en']}", f"{code}：{words['zh']}")
        refused = chosen.model is not None and code in REFUSALS
        return (fail if refused else warn)(NAME, found, _FIX)
    if about is None:
        found = BilingualWords("none is installed: nothing is seen", "未安装检测器：看不到任何东西")
        return warn(NAME, found, _FIX)
    told = _describe(about)
    if about.beside is None:
        return ok(NAME, told.en, told.zh)
    beside = _describe(about.beside)
    return ok(NAME, f"{told.en}; beside it {beside.en}", f"{told.zh}；另有 {beside.zh}")


def _describe(about: DetectorInfo) -> BilingualWords:
    many, size = sum(map(bool, about.classes)), f"{about.width} x {about.height}"
    return BilingualWords(
        f"{about.model}, read as {about.decoder}, {size}, {many} kinds",
        f"{about.model}，按 {about.decoder} 读取，{size}，{many} 类",
    )


async def _open(chosen: VisionSettings) -> DetectorInfo | None:
    worker = VisionWorker(chosen)
    try:
        await worker.start(OPEN_S)
        return worker.about
    finally:
        await worker.close()
