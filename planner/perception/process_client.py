"""Find things in pictures, in another process. Knows settings and questions; no pixels or pipes.

Detection takes a core for tens of milliseconds and holds native memory, so it never runs in the
planner. What a picture holds is never an exception: a skipped one comes back with its reason.
"""

from __future__ import annotations

import json
import logging
from collections import Counter
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner.language.object_names import canonical, name_kinds
from planner.perception.failure import VisionFailure
from planner.perception.snapshot import DetectorInfo, LookResult, read_about, read_look
from planner.settings.vision import OPEN
from processes.worker import SupervisedWorker
from processes.worker_protocol import FailureCodes, Frame

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.settings import VisionSettings
    from wire import Image

log = logging.getLogger(__name__)

DEFAULT_MODEL = Path(__file__).with_name("models") / "pons_home.onnx"
CHILD = "planner.perception.process_main"
READY_S = 120.0
"""To start Python and onnxruntime on a busy board."""
FIRST_WORD_S = 3600.0
"""TensorRT builds its engine at the first start, for minutes; what takes an hour hangs."""
LOOK_S = 5.0
LONGEST_PAUSE_S = 10.0
RESTS_AFTER_S = 30.0
"""Of no picture. It takes 70 MB, and starts again within a second of a processor."""
CODES = FailureCodes(
    VisionFailure, down="detector_down", died="detector_down", timed_out="detector_timed_out"
)


class VisionWorker(SupervisedWorker):
    """Look at pictures with the owner's detector, or with the one that comes with Pons."""

    def __init__(self, settings: VisionSettings, child: str = CHILD) -> None:
        """Take the owner's settings; nothing is started."""
        super().__init__(
            *(child, (settings_text(settings),), CODES),
            one_at_a_time=True,
            first_word_s=FIRST_WORD_S,
            longest_pause_s=LONGEST_PAUSE_S,
            # An owner's model may take minutes to load, or hold a processor of its own.
            rests_after_s=RESTS_AFTER_S if settings.model is None else inf,
        )
        self.has_model = settings.model is not None or DEFAULT_MODEL.is_file()
        """The owner names one, or one comes with Pons; if it can be used is found out later."""
        self.about: DetectorInfo | None = None
        """What runs, once the process is ready; None without a model."""
        self.classes: tuple[str, ...] = ()
        """Ids of the known classes; none until it is ready, and none without a model."""
        self.open_classes: tuple[str, ...] = ()
        """Those of these that a wide look alone finds."""
        self.skipped: Counter[str] = Counter()
        """How often pictures were skipped, by code."""

    async def start(self, timeout_s: float = READY_S) -> None:
        """Start the process and wait until it can answer. Ends by itself, with :meth:`close`.

        Without a model of the owner's, and without one that comes with Pons, it starts all the
        same: :meth:`look` then fails with ``no_detector``, and :meth:`crop` works.

        Raises:
            VisionFailure: the model is refused (``model_*``, ``provider_unavailable``), and
                nothing is left running; or the process is not up yet (``detector_down``), and
                goes on being started.
        """
        await super().start(timeout_s)

    async def look(
        self, color: Image, depth: Image | None, timeout_s: float = LOOK_S, *, wide: bool = False
    ) -> LookResult:
        """Think upon one picture. What it holds is never an exception: it may be ``skipped``.

        A ``wide`` look has the open-vocabulary model look, too, where the owner has one.

        Raises:
            VisionFailure: ``no_detector``, ``detector_down``, ``detector_timed_out``, or what the
                model was refused for.
        """
        header = color.header
        if depth is not None and not _same_instant(color, depth):
            skipped = LookResult((), header.width, header.height, 0.0, "depth_of_another")
            return self._count_skips(skipped)
        head = {
            "color": len(color.data),
            "deep": depth is not None,
            "size": [header.width, header.height],
            "focal": header.focal_px,
            "wide": wide,
        }
        bodies = (color.data,) if depth is None else (color.data, depth.data)
        return self._count_skips(await self.ask(head, bodies, timeout_s, read_look))

    async def crop(self, picture: bytes, long_side: int, timeout_s: float = LOOK_S) -> bytes:
        """Return a picture as JPEG whose longer side is at most so long [px], without metadata.

        Raises:
            VisionFailure: ``picture_*``, ``detector_down`` or ``detector_timed_out``.
        """
        head = {"long_side": max(1, long_side)}
        return await self.ask(head, (picture,), timeout_s, _picture)

    async def sheet(
        self, pictures: Sequence[tuple[bytes, str]], long_side: int, timeout_s: float = LOOK_S
    ) -> bytes:
        """Return several pictures as one JPEG, each below its label (ASCII), in their order.

        Its longer side is at most so long [px]; it has no metadata.

        Raises:
            VisionFailure: ``picture_*``, ``detector_down`` or ``detector_timed_out``.
        """
        head = {
            "sheet": [label for _, label in pictures],
            "lengths": [len(data) for data, _ in pictures],
            "long_side": max(1, long_side),
        }
        bodies = tuple(data for data, _ in pictures)
        return await self.ask(head, bodies, timeout_s, _picture)

    async def depth_at(
        self, depth: Image, u_px: float, v_px: float, timeout_s: float = LOOK_S
    ) -> float | None:
        """Return the depth measured around a pixel [m]; None where nothing was.

        Raises:
            VisionFailure: ``detector_down`` or ``detector_timed_out``.
        """
        head = {"at": [u_px, v_px], "size": [depth.header.width, depth.header.height]}
        return await self.ask(head, (depth.data,), timeout_s, _depth_m)

    def _check_greeting(self, said: dict[str, Any] | None) -> None:
        self.about = read_about(said)
        own = _classes(self.about)
        known = set(map(canonical, own))
        beside = _classes(self.about.beside) if self.about is not None else ()
        self.open_classes = tuple(name for name in beside if canonical(name) not in known)
        self.classes = (*own, *self.open_classes)
        name_kinds(_words(self.about))
        log.info("%s", "no detector is installed" if self.about is None else self.about.line)

    def _count_skips(self, result: LookResult) -> LookResult:
        for code in (result.skipped, result.depth_lost):
            if code is not None:
                self.skipped[code] += 1
        return result


def settings_text(settings: VisionSettings) -> str:
    """Return the process's part of the settings."""
    path = settings.model
    if path is None and DEFAULT_MODEL.is_file():
        path = DEFAULT_MODEL
    own = DEFAULT_MODEL if settings.detector == OPEN and DEFAULT_MODEL.is_file() else None
    files = {"path": path, "labels": settings.labels, "own": own}
    names = ("decoder", "provider", "threads", "input_px", "min_score")
    told = {name: None if file is None else str(file.absolute()) for name, file in files.items()}
    return json.dumps(told | {name: getattr(settings, name) for name in names})


def _classes(about: DetectorInfo | None) -> tuple[str, ...]:
    return () if about is None else tuple(filter(None, about.classes))


def _words(about: DetectorInfo | None) -> dict[str, tuple[str, ...]]:
    """Return the names that the owner gives classes, by id."""
    if about is None:
        return {}
    named = zip(about.classes, about.words, strict=False)
    return _words(about.beside) | {canonical(label): words for label, words in named if label}


def _same_instant(color: Image, depth: Image) -> bool:
    one, other = color.header, depth.header
    return (one.boot_id, one.seq) == (other.boot_id, other.seq)


def _picture(frame: Frame) -> bytes:
    return frame[1]


def _depth_m(frame: Frame) -> float | None:
    measured = frame[0]["depth_m"]
    return None if measured is None else float(measured)
