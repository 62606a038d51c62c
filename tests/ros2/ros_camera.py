"""Be a camera of a true ROS 2 graph, run by a Python that has rclpy; knows nothing of Pons.

``ros_camera.py PATH HZ FORMAT [raw]`` says the bytes of a file as pictures, HZ a second, packed or,
with ``raw``, as they are; each picture's stamp is a line of JSON on stdout.
"""

from __future__ import annotations

import json
import sys
from array import array
from pathlib import Path

import rclpy
from rclpy.node import Node
from sensor_msgs.msg import CompressedImage, Image


class Camera(Node):
    """Say pictures: the bytes of a file, over and over."""

    def __init__(self, path: str, hz: float, form: str, *, raw: bool) -> None:
        super().__init__("camera")
        self.form, self.data, self.raw = form, array("B", Path(path).read_bytes()), raw
        kind, topic = (Image, "/camera") if raw else (CompressedImage, "/camera/compressed")
        self.pictures = self.create_publisher(kind, topic, 10)
        self.create_timer(1.0 / hz, self.turn)

    def turn(self) -> None:
        wide = len(self.data)
        picture = Image(height=1, width=wide, step=wide) if self.raw else CompressedImage()
        setattr(picture, "encoding" if self.raw else "format", self.form)
        now = self.get_clock().now()
        picture.header.stamp = now.to_msg()
        picture.data = self.data
        self.pictures.publish(picture)
        print(json.dumps(now.nanoseconds * 1e-9), flush=True)


if __name__ == "__main__":
    rclpy.init()
    path, hz, form = sys.argv[1:4]
    rclpy.spin(Camera(path, float(hz), form, raw="raw" in sys.argv[4:]))
