"""Ask the vision process what it sees, and hold what becomes of it to the codes of the eyes."""

from __future__ import annotations

import asyncio
import os
import signal
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest

from planner.language.object_names import name_kinds, name_object
from planner.perception import VisionWorker
from planner.settings import VisionSettings
from processes.parent_death import WORKER_NICE
from tests.planner.perception.detect import tiny
from tests.planner.perception.detect.tiny import Seen
from tests.processes import small_worker_main as tiny_process
from tests.processes.small_worker import LIMIT_S, code_of, pid_of, story
from wire import Image, ImageHeader
from wire.image_header import read_header

pytestmark = pytest.mark.nightly(keep=3)


SIZE = (64, 48)


def image(data: bytes, seq: int = 1) -> Image:
    header = ImageHeader(
        boot_id="c", seq=seq, stamp_s=1.0, width=SIZE[0], height=SIZE[1], focal_px=50.0,
        center_x_px=32.0, center_y_px=24.0,
    )  # fmt: skip
    return Image(header, data)


JPEG = tiny.jpeg(*SIZE)


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> Path:
    outputs = tiny.yolov8([Seen((16.0, 16.0, 48.0, 40.0), 1, 0.9)])
    path = tmp_path_factory.mktemp("model") / "tiny.onnx"
    return tiny.model(path, outputs, metadata=tiny.ULTRALYTICS)


@pytest.fixture(scope="module")
def loop() -> Iterator[asyncio.Runner]:
    with asyncio.Runner() as runner:
        yield runner


@pytest.fixture(scope="module")
def worker(loop: asyncio.Runner, model: Path) -> Iterator[VisionWorker]:
    """Start one process, a second of a processor, for all who leave it as it is."""
    made = VisionWorker(VisionSettings(model=model))
    loop.run(made.start())
    yield made
    loop.run(made.close())


@story
async def test_a_look_comes_from_another_process_that_yields_to_us(
    worker: VisionWorker, loop: asyncio.Runner
) -> None:
    result = await worker.look(image(JPEG), None)
    assert [(it.label, it.color) for it in result.detections] == [("cup", "red")]
    assert (result.width, result.height, result.skipped) == (*SIZE, None)
    child = psutil.Process(pid_of(worker))
    assert child.pid != os.getpid()
    assert child.nice() >= WORKER_NICE
    assert worker.about is not None
    assert (worker.about.decoder, worker.classes) == ("yolov8", ("person", "cup"))
    assert "metadata: 2 names" in worker.about.line


@story
async def test_bad_pictures_are_skipped_and_counted_and_the_process_lives(
    worker: VisionWorker, loop: asyncio.Runner
) -> None:
    first = pid_of(worker)
    worker.skipped.clear()
    for color, depth, code in (
        (b"\xff\xd8\xff\xe0", None, "picture_not_known"),
        (JPEG[:-9], None, "picture_truncated"),
        (tiny.jpeg(320, 240), None, "picture_size_wrong"),
        (JPEG, image(JPEG), "depth_not_known"),
        (JPEG, image(JPEG, seq=2), "depth_of_another"),
    ):
        result = await worker.look(image(color), depth)
        assert (result.skipped, result.detections) == (code, ())
    assert worker.skipped.total() == 5
    assert worker.skipped["picture_truncated"] == 1
    assert (await worker.look(image(JPEG), None)).skipped is None
    assert pid_of(worker) == first


@story
async def test_a_picture_is_made_small_for_others(
    worker: VisionWorker, loop: asyncio.Runner
) -> None:
    header = read_header(await worker.crop(JPEG, 32))
    assert header is not None
    assert (header.kind, header.width, header.height) == ("jpeg", 32, 24)
    assert await code_of(worker.crop(b"no picture", 32)) == "picture_not_known"


@story
async def test_pictures_of_several_directions_become_one(
    worker: VisionWorker, loop: asyncio.Runner
) -> None:
    header = read_header(await worker.sheet([(JPEG, "1 ahead"), (JPEG, "2 left")], 100))
    assert header is not None
    assert (header.kind, max(header.width, header.height) <= 100) == ("jpeg", True)
    broken = worker.sheet([(JPEG, "1 ahead"), (b"no picture", "2 left")], 100)
    assert await code_of(broken) == "picture_not_known"


async def test_what_becomes_of_the_process_has_a_code_of_the_eyes(model: Path) -> None:
    worker = VisionWorker(VisionSettings(model=model), tiny_process.MODULE)
    await worker.start(LIMIT_S)
    try:
        nonsense = worker.look(image(JPEG), None, LIMIT_S)
        assert await code_of(nonsense) == "detector_down"
        assert await worker.crop(b"abc", 9, LIMIT_S) == b"cba"
        os.kill(pid_of(worker), signal.SIGSTOP)
        frozen = asyncio.create_task(worker.look(image(JPEG), None, 0.1))
        await asyncio.sleep(0)
        assert await code_of(worker.crop(JPEG, 9, 0.01)) == "detector_down"  # busy
        assert await code_of(frozen) == "detector_timed_out"
    finally:
        await worker.close()


async def test_an_open_vocabulary_model_looks_beside_ours_where_it_is_asked(
    tmp_path: Path,
) -> None:
    seen = [Seen((8.0, 8.0, 40.0, 40.0), 1, 0.9), Seen((8.0, 8.0, 40.0, 40.0), 0, 0.9)]
    path = tiny.model(tmp_path / "world.onnx", tiny.mmyolo(seen))
    (tmp_path / "world.names").write_text("cup\numbrella stand | 雨伞架\n", "utf-8")
    worker = VisionWorker(VisionSettings(model=path, detector="open"))
    await worker.start(LIMIT_S)
    try:
        assert worker.about is not None
        assert worker.about.beside is not None
        assert worker.about.beside.decoder == "mmyolo"
        assert "beside it detector world.onnx" in worker.about.line
        assert "cup" in worker.classes  # it comes with Pons, and stays with that detector
        assert worker.open_classes == ("umbrella_stand",)
        assert worker.classes[-1] == "umbrella_stand"
        assert name_object("umbrella_stand").zh == "雨伞架"
        narrow = await worker.look(image(JPEG), None)
        assert (narrow.wide, narrow.detections) == (False, ())
        wide = await worker.look(image(JPEG), None, wide=True)
        assert (wide.wide, [it.label for it in wide.detections]) == (True, ["umbrella_stand"])
    finally:
        await worker.close()
        name_kinds({})


async def test_a_refused_model_is_refused_at_start_with_its_code(tmp_path: Path) -> None:
    (tmp_path / "m.onnx").write_text("weights")
    worker = VisionWorker(VisionSettings(model=tmp_path / "m.onnx"))
    assert await code_of(worker.start(LIMIT_S)) == "model_not_onnx"
    assert worker.pid is None
    assert await code_of(worker.look(image(JPEG), None)) == "model_not_onnx"


@pytest.mark.parametrize("floats", [1 << 30])
async def test_a_graph_of_a_few_bytes_that_asks_for_all_memory_is_refused(
    tmp_path: Path, floats: int
) -> None:
    path = tiny.hungry(tmp_path / "m.onnx", floats)
    assert path.stat().st_size < 1_000
    worker = VisionWorker(VisionSettings(model=path))
    assert await code_of(worker.start(LIMIT_S)) == "model_too_hungry"
    assert worker.pid is None


async def test_without_a_model_pictures_are_still_made_small() -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("planner.perception.process_client.DEFAULT_MODEL", Path("nowhere.onnx"))
        worker = VisionWorker(VisionSettings())
    assert await code_of(worker.look(image(JPEG), None)) == "detector_down"  # not started
    await worker.start(LIMIT_S)
    assert (worker.about, worker.classes) == (None, ())
    assert await code_of(worker.look(image(JPEG), None)) == "no_detector"
    assert await worker.crop(JPEG, 32)
    child = pid_of(worker)
    await worker.close()
    await worker.close()
    assert not psutil.pid_exists(child)
