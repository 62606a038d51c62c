"""Measure packed pictures of a true ROS 2 camera: how many of those said come, and how old.

The camera is a rclpy node that says one JPEG, 10 a second (tests/ros2/ros_camera.py); what reads
it is the camera process's own source. Needs a Python with rclpy, named by PONS_ROS2_PYTHON.
"""

from __future__ import annotations

import time
from contextlib import ExitStack, closing
from functools import partial
from typing import TYPE_CHECKING, Any

import cv2
import numpy as np

from ros2.picture_stream import PictureStream
from sensors.camera.packed_picture import unpack
from tools.bench.context import until
from tools.bench.report import ReportRow, row_of
from tools.bench.ros2_graph import CAMERA, START_S, WAYS, TrueGraph, check_for_rclpy
from wire import load_robot
from wire.ros2_config import Ros2Config

if TYPE_CHECKING:
    from pathlib import Path

    from tools.bench.context import BenchLab

NAME = "ros2_pictures"
TITLE = "ROS 2 true camera: pictures that come, and their age unpacked, by transport"
LONG_ONLY = True
PICTURES, HZ = 300, 10
SIZES = ((640, 480), (1280, 720))
TOPIC, FORMAT = "/camera/compressed", "rgb8; jpeg compressed bgr8"


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take 300 pictures of each size by each way."""
    check_for_rclpy()
    return [row for way in WAYS for size in SIZES for row in _measure_size(lab, way, size)]


def _measure_size(lab: BenchLab, way: str, size: tuple[int, int]) -> list[ReportRow]:
    name = f"{size[0]}x{size[1]}"
    take = partial(_take, lab, way, size)
    (run,) = lab.slices(f"{way}.{name}", 1, lambda _: take())
    came = f"{run['came']} of {run['said']}, {run['bytes']} bytes each"
    return [
        ReportRow(f"{way}, {name}: pictures at {HZ} Hz", "", ">= 99 %", value=came),
        row_of(f"{way}, {name}: stamp to unpacked", "ms", "", run["age_ms"]),
    ]


def _take(lab: BenchLab, way: str, size: tuple[int, int]) -> dict[str, Any]:
    """Read for as long as 300 pictures are said, after the first that came."""
    with lab.folder() as home, ExitStack() as stack:
        path = _write_picture(home, size)
        packed_bytes = path.stat().st_size
        graph = TrueGraph(way, home, stack)
        graph.start()
        words = (str(CAMERA), str(path), str(HZ), FORMAT)
        graph.start_node("camera", *words)
        until(lambda: graph.lines["camera"], START_S, "the camera's node")
        ros2 = load_robot(graph.describe(imu=False)).ros2 or Ros2Config()
        stream = stack.enter_context(closing(PictureStream(ros2, TOPIC, round(500 / HZ))))
        ages_ms: dict[float, float] = {}
        while len(ages_ms) < 2 or max(ages_ms) < min(ages_ms) + (PICTURES - 0.5) / HZ:
            packed = stream.take(START_S).packed
            unpack(packed.data, packed.format, TOPIC)
            ages_ms[packed.stamp_s or 0.0] = 1000 * (time.time() - (packed.stamp_s or 0.0))
        stamps = [float(line) for _, line in tuple(graph.lines["camera"])]
    first, last = min(ages_ms) - 1e-4, max(ages_ms) + 1e-4
    return {
        "came": len(ages_ms),
        "said": sum(first <= stamp <= last for stamp in stamps),
        "age_ms": list(ages_ms.values()),
        "bytes": packed_bytes,
    }


def _write_picture(home: Path, size: tuple[int, int]) -> Path:
    """Write a JPEG of coarse noise, which packs about as well as a furnished room."""
    width, height = size
    noise = np.random.default_rng(1).integers(0, 255, (height // 8, width // 8, 3), np.uint8)
    path = home / "picture.jpg"
    cv2.imwrite(str(path), cv2.resize(noise, size), [cv2.IMWRITE_JPEG_QUALITY, 85])
    return path
