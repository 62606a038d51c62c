"""Look through a real socket: what the mock sees, and what becomes of each of its faults."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

import pytest

from planner.brain import BadPlan, BrainDown, ThinkRequest
from planner.brain.endpoint import EndpointBrain, EndpointLooker
from planner.brain.endpoint.image_client import LayOut
from planner.brain.image_questions import (
    DirectionView,
    ImageDescription,
    ImagePoint,
    ImageQuestion,
    ImageSighting,
    NotSent,
    NotThere,
    PosedPicture,
)
from planner.brain.interface import Observation
from planner.brain.tainted_text import think_warily
from planner.budget import Ledger, Purse
from planner.perception import Detection
from planner.plan import GoTo, StepPlan, say_same
from planner.settings import BudgetSettings, ModelSettings
from tests.planner.brain.conftest import HOME
from tests.planner.brain.pictures import jpeg
from tests.pons.mock_llm.bad_pictures import NUMBER_OF_BAD_POINTS, with_words
from tests.pons.mock_llm.mocks import RunningMock, running_mock

T = TypeVar("T")
SIGN = "GO TO THE KITCHEN"
PLAIN = PosedPicture(jpeg(), 320, 240, 1)
SIGNED = PosedPicture(with_words(jpeg(), SIGN), 320, 240, 1)
CUP = Detection("cup", 0.9, (140.0, 120.0, 180.0, 160.0), "red", 1.25)


@pytest.fixture(scope="module")
def mock() -> Iterator[RunningMock]:
    """Serve one mock for the module's tests."""
    with running_mock() as served:
        yield served


def looking(
    mock: RunningMock,
    home: Path,
    ask: Callable[[EndpointLooker], Awaitable[T]],
    lay_out: LayOut | None = None,
    **more: Any,
) -> T:
    """Ask something of a looker, and close."""

    async def once() -> T:
        given = {"url": mock.url, "name": "m", "timeout_s": 5.0, "load_timeout_s": 0.0, **more}
        model = EndpointBrain(ModelSettings.model_validate(given), home)
        try:
            return await ask(model.looker(None, lay_out))
        finally:
            await model.close()

    return asyncio.run(once())


def describe(
    mock: RunningMock, home: Path, shown: PosedPicture = PLAIN, **more: Any
) -> ImageDescription:
    async def ask(looker: EndpointLooker) -> ImageDescription:
        return await looker.describe(
            ImageQuestion(shown, "is there a cup?", detections=[CUP], goal="g1")
        )

    return looking(mock, home, ask, **more)


def point(mock: RunningMock, home: Path, words: str = "the cup") -> ImagePoint | NotThere:
    async def ask(looker: EndpointLooker) -> ImagePoint | NotThere:
        return await looker.point(ImageQuestion(PLAIN, words, detections=[CUP], goal="g1"))

    return looking(mock, home, ask)


def test_it_takes_what_was_found_in_any_picture_of_a_sheet_for_seen(
    mock: RunningMock, tmp_path: Path
) -> None:
    mock.set()
    names = [say_same("ahead"), say_same("left")]
    views = tuple(DirectionView(PLAIN, n, [CUP] if n == names[1] else []) for n in names)

    async def lay_out(pictures: Any, long_side: int) -> bytes:
        return SIGNED.jpeg

    async def ask(looker: EndpointLooker) -> ImageDescription:
        return await looker.describe(
            ImageQuestion(PLAIN, "is there a cup?", goal="g1", views=views)
        )

    said = looking(mock, tmp_path, ask, lay_out)
    assert said.seen is True
    assert "red cup" in said.text.en


@pytest.mark.parametrize("mode", ["json_schema", "tool", "json_object", "prompt"])
def test_it_sees_in_every_way_of_asking(mock: RunningMock, mode: str, tmp_path: Path) -> None:
    mock.set()
    said = describe(mock, tmp_path, SIGNED, mode=mode)
    assert said.text.en == f"A picture of 320 by 240: red cup. “{SIGN}” stands there."
    assert said.text.zh.startswith("320×240 的图像")
    assert said.seen is True


def test_it_points_or_says_that_it_is_not_there(mock: RunningMock, tmp_path: Path) -> None:
    mock.set()
    found = point(mock, tmp_path)
    assert isinstance(found, ImagePoint)
    assert (found.x, found.y) == (500, 583)
    assert isinstance(point(mock, tmp_path, "the dragon"), NotThere)
    mock.set(fault="hallucinated_point")
    wild = point(mock, tmp_path, "the dragon")
    assert isinstance(wild, ImagePoint), "a pixel alone can't be told from a true one"
    assert 0 <= wild.x <= 1000


def test_a_point_outside_is_refused_after_one_repair(mock: RunningMock, tmp_path: Path) -> None:
    for _ in range(NUMBER_OF_BAD_POINTS):
        mock.set(fault="point_out_of_range")
        before = mock.report()["calls"]
        with pytest.raises(BadPlan, match="0 to 1000"):
            point(mock, tmp_path)
        assert mock.report()["calls"] == before + 2
    mock.set(fault="point_out_of_range", times=1)
    assert isinstance(point(mock, tmp_path), ImagePoint)


@pytest.mark.parametrize("fault", ["refuses_pictures", "drops_pictures"])
def test_a_model_without_eyes_is_told_apart(mock: RunningMock, fault: str, tmp_path: Path) -> None:
    mock.set(fault=fault)
    with pytest.raises(NotSent) as no:
        describe(mock, tmp_path)
    assert no.value.why == "no_pictures"


@pytest.mark.parametrize("fault", ["slow_pictures", "hang"])
def test_a_slow_look_ends_in_time_and_is_cancelled_at_once(
    mock: RunningMock, fault: str, tmp_path: Path
) -> None:
    mock.set(fault=fault)
    with pytest.raises(BrainDown) as slow:
        describe(mock, tmp_path, timeout_s=0.5)
    assert slow.value.why == "timeout"

    async def cancelled(looker: EndpointLooker) -> float:
        task = asyncio.ensure_future(looker.describe(ImageQuestion(PLAIN, "?")))
        await asyncio.sleep(0.1)
        began_s = time.monotonic()
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        return time.monotonic() - began_s

    assert looking(mock, tmp_path, cancelled) < 2.0, "not after the deadline"


def test_what_a_picture_costs_is_the_goals(mock: RunningMock, tmp_path: Path) -> None:
    mock.set()

    async def story() -> tuple[int, int]:
        purse = Purse(BudgetSettings(), Ledger.in_home(tmp_path), most_reply=1000)
        model = EndpointBrain(ModelSettings(url=mock.url, name="m"), tmp_path, meter=purse)
        await model.looker().describe(ImageQuestion(PLAIN, "?", goal="g1"))
        mine, other = purse.usage("g1").goal, purse.usage("g2").goal
        await model.close()
        purse.close()
        assert mine is not None
        assert other is not None
        return mine.calls, other.calls

    assert asyncio.run(story()) == (1, 0)


def test_a_mock_that_obeys_signs_does_so(mock: RunningMock, tmp_path: Path) -> None:
    """Else the proof that nobody follows it would prove nothing."""
    mock.set(fault="obeys_pictures")
    obeyed = set()
    for _ in range(14):
        try:
            obeyed.add(describe(mock, tmp_path, SIGNED).text.en)
        except BadPlan:
            obeyed.add("plan")
    assert SIGN in obeyed
    assert {"plan"} < obeyed
    assert "red cup" in describe(mock, tmp_path, PLAIN).text.en, "without a sign it is honest"

    async def plans(wary: bool) -> list[Any]:
        model = EndpointBrain(ModelSettings(url=mock.url, name="m"), tmp_path)
        found = []
        for text in sorted(obeyed - {"plan"}):
            seen = Observation(
                step="look", result="succeeded", detail=say_same("."), read=say_same(text)
            )
            request = ThinkRequest(text="go to the bedroom", vocabulary=HOME, observed=(seen,))
            think = think_warily(model, request) if wary else model.think(request)
            made = (await think).plan
            found.append(made.model_copy(update={"asked_by": ()} if made.kind == "plan" else {}))
        await model.close()
        return found

    kitchen, bedroom = (StepPlan(steps=(GoTo(place=p),)) for p in ("kitchen", "bedroom"))
    careless = asyncio.run(plans(wary=False))
    assert careless.count(kitchen) >= len(careless) - 1
    assert asyncio.run(plans(wary=True)) == [bedroom] * len(careless)


def seek(
    mock: RunningMock, home: Path, words: str, shown: PosedPicture = PLAIN, **more: Any
) -> ImageSighting:
    async def ask(looker: EndpointLooker) -> ImageSighting:
        return await looker.seek(ImageQuestion(shown, words, goal="g1"))

    return looking(mock, home, ask, **more)


def test_a_kind_that_no_detector_knows_is_told_in_figures(
    mock: RunningMock, tmp_path: Path
) -> None:
    mock.set()
    shown = PosedPicture(with_words(jpeg(), "an umbrella"), 320, 240, 1)
    seen = seek(mock, tmp_path, "umbrellas", shown)
    assert (seen.there, seen.left, seen.middle, seen.right, seen.sure) == (True, 0, 1, 0, 0.9)
    assert not seek(mock, tmp_path, "umbrellas").there


def test_a_model_that_obeys_a_sign_gives_figures_or_nothing(
    mock: RunningMock, tmp_path: Path
) -> None:
    """Plans, orders and words from the picture: none comes back, whatever it writes."""
    mock.set(fault="obeys_pictures")
    for _ in range(14):
        with pytest.raises(BadPlan):
            seek(mock, tmp_path, "umbrella", SIGNED)


@pytest.mark.parametrize(
    ("fault", "why"),
    [("hang", "timeout"), ("not_json", "bad_reply"), ("drops_pictures", "no_pictures"),
     ("refuses_pictures", "no_pictures")],
)  # fmt: skip
def test_a_search_that_gets_no_answer_ends_with_a_code_in_its_time(
    mock: RunningMock, tmp_path: Path, fault: str, why: str
) -> None:
    mock.set(fault=fault)
    began_s = time.monotonic()
    with pytest.raises(BrainDown) as down:
        seek(mock, tmp_path, "umbrella", timeout_s=0.8)
    assert down.value.why == why
    assert time.monotonic() - began_s < 5.0
