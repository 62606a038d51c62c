"""Kill, freeze and mislead the vision process; the caller gets a look or a typed failure."""

from __future__ import annotations

import asyncio
import os
import signal
import subprocess
import sys
import time
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator
from contextlib import asynccontextmanager
from pathlib import Path

import psutil
import pytest

from planner.settings import VisionSettings
from planner.vision import VisionFailure, VisionWorker
from planner.vision.child import NICE
from planner.vision.detect.header import read_header
from tests.planner.vision.detect import tiny
from tests.planner.vision.detect.tiny import Seen
from wire import Image, ImageHeader

LIMIT_S = 30.0
STUB = "tests.planner.vision.stub_child"
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


@asynccontextmanager
async def running(
    settings: VisionSettings, child: str = "planner.vision.child"
) -> AsyncIterator[VisionWorker]:
    made = VisionWorker(settings, child)
    await made.start(LIMIT_S)
    try:
        yield made
    finally:
        await made.close()


def pid(worker: VisionWorker) -> int:
    assert worker.pid is not None
    return worker.pid


async def code_of(asked: Awaitable[object]) -> str:
    with pytest.raises(VisionFailure) as caught:
        await asked
    return caught.value.code


def run(story: Callable[[], Awaitable[None]], loop: asyncio.Runner | None = None) -> None:
    async def bounded() -> None:
        async with asyncio.timeout(LIMIT_S):
            await story()

    if loop is None:
        asyncio.run(bounded())
    else:
        loop.run(bounded())


def test_a_look_comes_from_another_process_that_yields_to_us(
    worker: VisionWorker, loop: asyncio.Runner
) -> None:
    async def story() -> None:
        result = await worker.look(image(JPEG), None)
        assert [(it.label, it.color) for it in result.detections] == [("cup", "red")]
        assert (result.width, result.height, result.skipped) == (*SIZE, None)
        child = psutil.Process(pid(worker))
        assert child.pid != os.getpid()
        assert child.nice() >= NICE
        assert worker.about is not None
        assert (worker.about.decoder, worker.classes) == ("yolov8", ("person", "cup"))
        assert "metadata: 2 names" in worker.about.line

    run(story, loop)


def test_bad_pictures_are_skipped_and_counted_and_the_process_lives(
    worker: VisionWorker, loop: asyncio.Runner
) -> None:
    async def story() -> None:
        first = pid(worker)
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
        assert pid(worker) == first

    run(story, loop)


def test_a_picture_is_made_small_for_others(worker: VisionWorker, loop: asyncio.Runner) -> None:
    async def story() -> None:
        header = read_header(await worker.crop(JPEG, 32))
        assert header is not None
        assert (header.kind, header.width, header.height) == ("jpeg", 32, 24)
        assert await code_of(worker.crop(b"no picture", 32)) == "picture_not_known"

    run(story, loop)


def test_who_gives_up_waiting_leaves_the_next_answer_whole(
    worker: VisionWorker, loop: asyncio.Runner
) -> None:
    async def story() -> None:
        first = pid(worker)
        os.kill(first, signal.SIGSTOP)
        try:
            asked = asyncio.create_task(worker.crop(JPEG, 32))
            await asyncio.sleep(0)
            asked.cancel()
            with pytest.raises(asyncio.CancelledError):
                await asked
        finally:
            os.kill(first, signal.SIGCONT)
        assert len((await worker.look(image(JPEG), None)).detections) == 1
        assert pid(worker) == first

    run(story, loop)


def test_killed_in_the_middle_or_frozen_it_fails_typed_and_comes_back(model: Path) -> None:
    async def story() -> None:
        async with running(VisionSettings(model=model), STUB) as worker:
            first = pid(worker)
            os.kill(first, signal.SIGSTOP)  # so that the request is surely unanswered
            asked = asyncio.create_task(worker.look(image(JPEG), None))
            beside = asyncio.create_task(worker.crop(JPEG, 9))
            await asyncio.sleep(0)
            os.kill(first, signal.SIGKILL)
            assert await code_of(asked) == "detector_down"
            await beside  # it waited, and is answered by the next process
            second = pid(worker)
            assert second != first

            os.kill(second, signal.SIGSTOP)
            late = worker.look(image(JPEG), None, 0.05)
            assert await code_of(late) == "detector_timed_out"
            assert (await worker.look(image(JPEG), None, LIMIT_S)).skipped is None
            assert not psutil.pid_exists(second)

    run(story)


def test_a_refused_model_is_refused_at_start_with_its_code(tmp_path: Path) -> None:
    async def story() -> None:
        (tmp_path / "m.onnx").write_text("weights")
        worker = VisionWorker(VisionSettings(model=tmp_path / "m.onnx"))
        assert await code_of(worker.start(LIMIT_S)) == "model_not_onnx"
        assert worker.pid is None
        assert await code_of(worker.look(image(JPEG), None)) == "model_not_onnx"

    run(story)


def test_without_a_model_pictures_are_still_made_small() -> None:
    async def story() -> None:
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("planner.vision.worker.DEFAULT_MODEL", Path("nowhere.onnx"))
            worker = VisionWorker(VisionSettings())
        assert await code_of(worker.look(image(JPEG), None)) == "detector_down"  # not started
        await worker.start(LIMIT_S)
        assert (worker.about, worker.classes) == (None, ())
        assert await code_of(worker.look(image(JPEG), None)) == "no_detector"
        assert await worker.crop(JPEG, 32)
        child = pid(worker)
        await worker.close()
        await worker.close()
        assert not psutil.pid_exists(child)

    run(story)


def test_deaths_before_the_first_word_are_no_refusal_and_it_is_tried_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """Out of memory says nothing of the model."""
    monkeypatch.setattr("planner.vision.keeper.FIRST_PAUSE_S", 0.01)

    async def story() -> None:
        worker = VisionWorker(VisionSettings(model=tmp_path / "dies4.onnx"), STUB)
        try:
            with pytest.raises(VisionFailure, match="not ready") as caught:
                await worker.start(0.01)
            assert caught.value.code == "detector_down"
            assert (await worker.look(image(JPEG), None, LIMIT_S)).skipped is None
        finally:
            await worker.close()
        assert worker.pid is None
        assert sum("started again" in record.message for record in caplog.records) == 4

    run(story)


def test_a_refusal_that_comes_late_is_told_to_whoever_asks(tmp_path: Path) -> None:
    async def story() -> None:
        (tmp_path / "m.onnx").write_text("weights")
        worker = VisionWorker(VisionSettings(model=tmp_path / "m.onnx"))
        assert await code_of(worker.start(0.01)) == "detector_down"
        assert await code_of(worker.look(image(JPEG), None, LIMIT_S)) == "model_not_onnx"
        await worker.close()
        assert worker.pid is None

    run(story)


PARENT = """
import asyncio, sys
from pathlib import Path
from planner.settings import VisionSettings
from planner.vision import VisionWorker

async def main():
    worker = VisionWorker(VisionSettings(model=Path(sys.argv[1])))
    await worker.start()
    print(worker.pid, flush=True)
    await asyncio.sleep(60)

asyncio.run(main())
"""


def test_it_dies_with_a_planner_that_is_killed(model: Path) -> None:
    arguments = [sys.executable, "-c", PARENT, str(model)]
    with subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True) as parent:
        try:
            assert parent.stdout is not None
            child = int(parent.stdout.readline())
            assert psutil.pid_exists(child)
        finally:
            parent.kill()
    until_s = time.monotonic() + 5.0
    while psutil.pid_exists(child) and time.monotonic() < until_s:
        time.sleep(0.01)
    assert not psutil.pid_exists(child)


def test_the_planners_own_process_loads_no_array_library() -> None:
    code = (
        "import sys, planner.vision\n"
        "print([name for name in ('numpy', 'cv2', 'onnxruntime') if name in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True, timeout=LIMIT_S
    )
    assert done.stdout.strip() == "[]"
