"""Measure what a look costs beside the bare model: the same model, threads and frames, by turns.

Raw is ``session.run`` on an input that lies ready in the cache. Where a file takes bytes and does
itself what else is done beside it, its bare network is run too, and a look held against that as
well: what costs less outside is not to be hidden inside. A look is all that Pons does: fit
the picture in, run, read the output, suppress, name colours; a second row unpacks the JPEG too, a
third is what the planner asks for: with the depth picture unpacked and read in each box. The pipe
between the processes has a row of its own.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from statistics import median
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from planner.perception import VisionWorker
from planner.perception.process_client import DEFAULT_MODEL
from planner.settings import VisionSettings
from pons.settings import CHECKOUT
from tools.bench.bare_net import BareNet
from tools.bench.processes import rss_mb
from tools.bench.report import ReportRow, row_of
from wire import Image, ImageHeader

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "vision_overhead"
TITLE = "looks beside the bare model, and the vision process's memory"
LONG_ONLY = False
OUTSIDE = CHECKOUT.parent / "shared" / "data"
SIZE = (320, 240)
"""The camera's, as robot.toml has it."""
FRAMES, SEED = 8, 6
THREADS = 1
GOAL = "<= 5 %"
GOAL_MEMORY = "<= 180"
LOOKS = 60
WAYS = ("raw", "bare", "look", "jpeg", "whole", "opencv")
FOCAL_PX = 277.0
"""Of a camera that sees 60 degrees across 320 px."""


@dataclass(frozen=True)
class Subject:
    """One model to measure."""

    name: str
    model: Path
    labels: Path | None = None


@dataclass(frozen=True, slots=True)
class CameraPicture:
    """Hold one picture as the camera sends it."""

    color: bytes
    """JPEG."""
    depth: bytes
    """16-bit PNG [mm]."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Measure each model that is there."""
    rows: list[ReportRow] = []
    for subject in _subjects():
        if subject.model.is_file():
            rows += _measure_subject(lab, subject)
        else:
            note = f"no {subject.model.name} here"
            rows.append(ReportRow(subject.name, "", GOAL, value="not measured", note=note))
    return rows


def _measure_subject(lab: BenchLab, subject: Subject) -> list[ReportRow]:
    rounds = lab.count(12, 40)
    rows: list[ReportRow] = []
    for data in lab.slices(f"rounds.{subject.name}", 1, lambda _: _rounds(subject, rounds)):
        rows += _time_rows(subject, data)
    for data in lab.slices(f"worker.{subject.name}", 1, lambda _: _worker(subject)):
        rows += _worker_rows(subject, data)
    return rows


def _subjects() -> tuple[Subject, ...]:
    labels = OUTSIDE / "models" / "coco_classes.txt"
    return (
        Subject("yolox_nano", OUTSIDE / "models" / "yolox_nano.onnx", labels),
        Subject("default", DEFAULT_MODEL),
    )


def _time_rows(subject: Subject, data: dict[str, Any]) -> list[ReportRow]:
    raw = data["raw"]
    base = f"{FRAMES} frames of {SIZE[0]}x{SIZE[1]}, {THREADS} thread, per frame, by rounds"
    rows = [row_of(f"{subject.name}: raw session.run", "ms", "", raw, base)]
    found = data["detections"]
    # Where nothing is found a look ends before it suppresses and names colours.
    told, valid = f"{found:.1f} detections a frame", found > 0
    for way, inside in (
        ("look", f"fit in, run, read, suppress, colours; {told}"),
        ("jpeg", f"the same and unpacking the JPEG; {told}"),
        ("whole", f"the same and depth, unpacked and read in each box; {told}"),
    ):
        over = [100 * (one / bare - 1) for one, bare in zip(data[way], raw, strict=True)]
        rows.append(row_of(f"{subject.name}: {way} over raw", "%", GOAL, over, inside, valid=valid))
    if data["bare"]:
        rows += _bare_rows(subject, data, told, valid=valid)
    if data["opencv"]:
        rows.append(
            row_of(
                f"{subject.name}: OpenCV's dnn",
                "ms",
                "",
                data["opencv"],
                "forward of the whole file",
            )
        )
    else:
        rows.append(
            ReportRow(f"{subject.name}: OpenCV's dnn", "ms", "", value="none", note=data["refused"])
        )
    return rows


def _bare_rows(
    subject: Subject, data: dict[str, Any], told: str, *, valid: bool
) -> list[ReportRow]:
    bare = data["bare"]
    net = "the file from its first convolution to its last ones: no bytes, no boxes"
    over = [100 * (one / alone - 1) for one, alone in zip(data["look"], bare, strict=True)]
    inside = f"a look beside the network alone; {told}"
    return [
        row_of(f"{subject.name}: bare net", "ms", "", bare, net),
        row_of(f"{subject.name}: look over bare net", "%", "", over, inside, valid=valid),
    ]


def _worker_rows(subject: Subject, data: dict[str, Any]) -> list[ReportRow]:
    pipe = f"{LOOKS} looks; what asking adds to what the process itself takes"
    return [
        row_of(f"{subject.name}: asking the process", "ms", "", data["pipe_ms"], pipe),
        row_of(f"{subject.name}: process's memory", "MB", GOAL_MEMORY, data["rss_mb"], "resident"),
    ]


def _rounds(subject: Subject, count: int) -> dict[str, Any]:
    """Return milliseconds a frame of each way, round by round, the ways in turning order."""
    import numpy as np

    from planner.perception.detect import ModelOptions, OnnxDetector, unpack_color

    detector = OnnxDetector(
        ModelOptions(subject.model, subject.labels, provider="cpu", threads=THREADS)
    )
    shown = frames(subject)
    pictures: list[Any] = [unpack_color(one.color) for one in shown]
    inputs = [detector.prepare(picture).copy() for picture in pictures]
    buffer = detector.prepare(pictures[0])
    session, feeds = detector.model.session, detector.feeds(buffer)
    network, refused = _opencv(subject.model)
    bare = _bare(subject.model, inputs) if detector.model.input.bytes_in else None

    def ready(number: int) -> None:
        np.copyto(buffer, inputs[number])  # as a look leaves it: in the cache

    def opencv(number: int) -> None:
        network.setInput(inputs[number])
        network.forward(network.getUnconnectedOutLayersNames())

    def whole(one: CameraPicture) -> None:
        detector.look(one.color, one.depth, SIZE, FOCAL_PX)

    ways: dict[str, tuple[Callable[[int], Any], Callable[[int], Any]]] = {
        "raw": (ready, lambda _: session.run(feeds)),
        "look": (_nothing, lambda number: detector.find(pictures[number])),
        "jpeg": (_nothing, lambda number: detector.look(shown[number].color)),
        "whole": (_nothing, lambda number: whole(shown[number])),
    }
    if bare is not None:
        ways["bare"] = (bare.ready, lambda _: bare.run())
    if network is not None:
        ways["opencv"] = (_nothing, opencv)
    detections = sum(len(detector.find(picture)) for picture in pictures) / len(pictures)
    found: dict[str, Any] = {way: [] for way in WAYS}
    found |= {"refused": refused, "detections": detections}
    for turn in range(count + 1):
        order = list(ways)[turn % len(ways) :] + list(ways)[: turn % len(ways)]
        for way in order:
            took_ms = _frame_ms(*ways[way])
            if turn:  # the first warms everything up
                found[way].append(took_ms)
    return found


def _nothing(_: int) -> None:
    """Get nothing ready."""


def _frame_ms(ready: Callable[[int], Any], work: Callable[[int], Any]) -> float:
    """Return the median over the frames, so that one frame's bad luck is not the round's."""
    took_ms = []
    for number in range(FRAMES):
        ready(number)
        began_s = time.perf_counter()
        work(number)
        took_ms.append((time.perf_counter() - began_s) * 1e3)
    return median(took_ms)


def _bare(model: Path, inputs: Sequence[Any]) -> BareNet:
    """Return a model's network alone, ready for the same frames."""
    with TemporaryDirectory() as folder:
        return BareNet(model, inputs, THREADS, Path(folder))


def _opencv(model: Path) -> tuple[Any, str]:
    """Return OpenCV's own reading of a model, or why there is none."""
    import cv2

    try:
        return cv2.dnn.readNetFromONNX(str(model)), ""
    except cv2.error as error:
        return None, f"it can't read the model: {' '.join(str(error).split())[-80:]}"


def frames(subject: Subject) -> Sequence[CameraPicture]:
    """Return pictures that hold what the model knows: photographs for a stranger's, else drawn."""
    photographs = [] if subject.labels is None else sorted((OUTSIDE / "images").glob("*.jpg"))
    return _photographs(photographs[:FRAMES]) if len(photographs) >= FRAMES else drawn_frames()


def _photographs(paths: Sequence[Path]) -> list[CameraPicture]:
    """Return photographs with the depth of a floor that rises to 5 m, as noisy as a camera's."""
    import cv2
    import numpy as np

    rng, (wide, high) = np.random.default_rng(SEED), SIZE
    floor_mm = np.linspace(5_000.0, 1_000.0, high)[:, None]
    made = []
    for path in paths:
        picture: Any = cv2.imread(str(path))
        small = cv2.resize(picture, SIZE, interpolation=cv2.INTER_AREA)
        depth = (floor_mm + rng.normal(0.0, 10.0, (high, wide))).astype(np.uint16)
        raw = [cv2.IMWRITE_PNG_COMPRESSION, 0]  # as the simulated camera sends it
        packed = cv2.imencode(".jpg", small)[1], cv2.imencode(".png", depth, raw)[1]
        made.append(CameraPicture(*(data.tobytes() for data in packed)))
    return made


def drawn_frames() -> list[CameraPicture]:
    """Return what the simulated camera sends from places where a thing is in sight."""
    import numpy as np

    from sim.camera.pictures import depth_png, jpeg
    from tools.bench.measure.object_position import Lookout

    lookout, random, rng = Lookout(), Random(SEED), np.random.default_rng(SEED)
    made: list[CameraPicture] = []
    while len(made) < FRAMES:
        pose = lookout.draw_pose(random)
        frame = lookout.shoot(pose, rng)
        if lookout.true_boxes(frame, pose):
            made.append(CameraPicture(jpeg(frame), depth_png(frame)))
    return made


def _worker(subject: Subject) -> dict[str, Any]:
    """Ask a process of its own; return what asking costs and what it holds in memory."""
    settings = VisionSettings(
        model=subject.model, labels=subject.labels, provider="cpu", threads=THREADS
    )
    return asyncio.run(_ask_worker(VisionWorker(settings), frames(subject)))


async def _ask_worker(worker: VisionWorker, shown: Sequence[CameraPicture]) -> dict[str, Any]:
    header = ImageHeader(
        boot_id="bench", seq=1, stamp_s=0.0, width=SIZE[0], height=SIZE[1],
        focal_px=FOCAL_PX, center_x_px=SIZE[0] / 2, center_y_px=SIZE[1] / 2,
    )  # fmt: skip
    pipe_ms, used_mb = [], []
    await worker.start()
    try:
        for number in range(LOOKS):
            began_s = time.perf_counter()
            one = shown[number % len(shown)]
            result = await worker.look(Image(header, one.color), Image(header, one.depth))
            pipe_ms.append((time.perf_counter() - began_s - result.took_s) * 1e3)
            if number % 10 == 9 and worker.pid is not None:
                used_mb.append(rss_mb(worker.pid))
    finally:
        await worker.close()
    return {"pipe_ms": pipe_ms, "rss_mb": used_mb}
