"""Make films, and play one as a network camera does: JPEG after JPEG over HTTP."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

WIDTH, HEIGHT = 160, 120
TOP = (0, 0, 255)
"""Red, in OpenCV's order: the upper half of each picture."""
BOTTOM = (255, 0, 0)


def picture(number: int) -> NDArray[np.uint8]:
    made = np.empty((HEIGHT, WIDTH, 3), np.uint8)
    made[: HEIGHT // 2], made[HEIGHT // 2 :] = TOP, BOTTOM
    made[40:80, (7 * number) % 120 : (7 * number) % 120 + 40] = 255
    return made


def film(path: Path, pictures: int = 10, hz: float = 20.0) -> Path:
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), hz, (WIDTH, HEIGHT))
    assert writer.isOpened()
    for number in range(pictures):
        writer.write(picture(number))
    writer.release()
    return path


class _Stream(BaseHTTPRequestHandler):
    def do_GET(self) -> None:
        self.send_response(200)
        self.send_header("Content-Type", "multipart/x-mixed-replace; boundary=frame")
        self.end_headers()
        number = 0
        server: Any = self.server  # its ``show`` draws the picture of a number
        while not server.ending.is_set():
            data = bytes(cv2.imencode(".jpg", server.show(number))[1])
            head = f"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: {len(data)}\r\n\r\n"
            try:
                self.wfile.write(head.encode() + data + b"\r\n")
            except OSError:
                return
            number += 1
            time.sleep(0.04)

    def log_message(self, *_: Any) -> None:
        """Say nothing."""


@contextmanager
def network_camera(
    port: int = 0, show: Callable[[int], NDArray[np.uint8]] = picture
) -> Iterator[int]:
    """Serve pictures at a port until left."""
    server: Any = ThreadingHTTPServer(("127.0.0.1", port), _Stream)
    server.daemon_threads = True
    server.ending, server.show = threading.Event(), show
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.05})
    thread.start()
    try:
        yield int(server.server_address[1])
    finally:
        server.ending.set()
        server.shutdown()
        thread.join()
        server.server_close()
