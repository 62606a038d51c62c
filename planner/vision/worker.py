"""Find things in pictures, in another process. Knows settings and questions; no pixels or pipes.

Detection takes a core for tens of milliseconds and holds native memory, so it never runs in the
planner. What a picture holds is never an exception: a skipped one comes back with its reason.
"""

from __future__ import annotations

import json
import logging
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner.vision.failure import VisionFailure
from planner.vision.frames import read_about, read_look
from planner.vision.keeper import KeptProcess, known
from planner.vision.result import About, LookResult

if TYPE_CHECKING:
    from planner.settings import VisionSettings
    from wire import Image

log = logging.getLogger(__name__)

DEFAULT_MODEL = Path(__file__).with_name("models") / "pons_home.onnx"
CHILD = "planner.vision.child"
READY_S = 120.0
"""To start Python and onnxruntime on a busy board; TensorRT builds its engine meanwhile."""
LOOK_S = 5.0


class VisionWorker:
    """Look at pictures with the owner's detector, or with the one that comes with Pons."""

    def __init__(self, settings: VisionSettings, child: str = CHILD) -> None:
        """Take the owner's settings; nothing is started."""
        self._kept = KeptProcess(child, (settings_text(settings),), self._greet)
        self.has_model = settings.model is not None or DEFAULT_MODEL.is_file()
        """The owner names one, or one comes with Pons; if it can be used is found out later."""
        self.about: About | None = None
        """What runs, once the process is ready; None without a model."""
        self.skipped: Counter[str] = Counter()
        """How often pictures were skipped, by code."""

    @property
    def classes(self) -> tuple[str, ...]:
        """Return the ids of what it can find; none until it is ready, and none without a model."""
        return () if self.about is None else tuple(filter(None, self.about.classes))

    @property
    def pid(self) -> int | None:
        """Return the process's id while one runs."""
        return self._kept.pid

    @property
    def ready(self) -> bool:
        """Tell whether a process waits for pictures."""
        return self._kept.ready

    async def start(self, timeout_s: float = READY_S) -> None:
        """Start the process and wait until it can answer. Ends by itself, with :meth:`close`.

        Without a model of the owner's, and without one that comes with Pons, it starts all the
        same: :meth:`look` then fails with ``no_detector``, and :meth:`crop` works.

        Raises:
            VisionFailure: the model is refused (``model_*``, ``provider_unavailable``), and
                nothing is left running; or the process is not up yet (``detector_down``), and
                goes on being started.
        """
        await self._kept.start(timeout_s)

    async def look(
        self, color: Image, depth: Image | None, timeout_s: float = LOOK_S
    ) -> LookResult:
        """Think upon one picture. What it holds is never an exception: it may be ``skipped``.

        Raises:
            VisionFailure: ``no_detector``, ``detector_down``, ``detector_timed_out``, or what the
                model was refused for.
        """
        header = color.header
        if depth is not None and not _same_instant(color, depth):
            skipped = LookResult((), header.width, header.height, 0.0, "depth_of_another")
            return self._counted(skipped)
        head = {
            "color": len(color.data),
            "deep": depth is not None,
            "size": [header.width, header.height],
            "focal": header.focal_px,
        }
        bodies = (color.data,) if depth is None else (color.data, depth.data)
        answer, _ = await self._kept.ask(head, bodies, timeout_s)
        return self._counted(read_look(answer))

    async def crop(self, picture: bytes, long_side: int, timeout_s: float = LOOK_S) -> bytes:
        """Return a picture as JPEG whose longer side is at most so long [px], without metadata.

        Raises:
            VisionFailure: ``picture_*``, ``detector_down`` or ``detector_timed_out``.
        """
        head = {"long_side": max(1, long_side)}
        _, data = await self._kept.ask(head, (picture,), timeout_s)
        return data

    async def depth_at(
        self, depth: Image, u_px: float, v_px: float, timeout_s: float = LOOK_S
    ) -> float | None:
        """Return what was measured around a pixel [m]; None where nothing was.

        Raises:
            VisionFailure: ``detector_down`` or ``detector_timed_out``.
        """
        size = [depth.header.width, depth.header.height]
        answer, _ = await self._kept.ask(
            {"at": [u_px, v_px], "size": size}, (depth.data,), timeout_s
        )
        measured = answer["depth_m"]
        return None if measured is None else float(measured)

    async def close(self) -> None:
        """End the process and wait until it is gone. Safe to call twice."""
        await self._kept.close()

    def _greet(self, head: dict[str, Any]) -> None:
        if "refused" in head:
            raise VisionFailure(known(head["refused"]), str(head["detail"]))
        self.about = read_about(head["ready"])
        log.info("%s", "no detector is installed" if self.about is None else self.about.line)

    def _counted(self, result: LookResult) -> LookResult:
        for code in (result.skipped, result.depth_lost):
            if code is not None:
                self.skipped[code] += 1
        return result


def settings_text(settings: VisionSettings) -> str:
    """Return what the process is told of the settings."""
    path = settings.model
    if path is None and DEFAULT_MODEL.is_file():
        path = DEFAULT_MODEL
    files = {"path": path, "labels": settings.labels}
    names = ("decoder", "provider", "threads", "input_px", "min_score")
    told = {name: None if file is None else str(file.absolute()) for name, file in files.items()}
    return json.dumps(told | {name: getattr(settings, name) for name in names})


def _same_instant(color: Image, depth: Image) -> bool:
    one, other = color.header, depth.header
    return (one.boot_id, one.seq) == (other.boot_id, other.seq)
