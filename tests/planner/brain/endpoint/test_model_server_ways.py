"""Check a brain against the mock server's faults: cold, barren, open, failing in words."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from pathlib import Path

import pytest

from planner.brain import FallbackBrain, OfflineBrain, ThinkRequest, ThinkResult
from planner.brain.endpoint import EndpointBrain
from planner.brain.endpoint import line as line_module
from planner.brain.errors import BrainDown
from planner.brain.streamed_draft import Draft
from planner.plan import Language, StepPlan, Vocabulary
from planner.settings import ModelSettings
from tests.pons.mock_llm.mocks import RunningMock, running_mock

pytestmark = pytest.mark.nightly(keep=4)


SURE = "go to the kitchen"
UNSURE = "would it be a bother to glance at whatever the stove is up to"


@pytest.fixture
def mock() -> Iterator[RunningMock]:
    """Return a server of its own: one counts who has left it, also those of a test before."""
    with running_mock() as running:
        yield running


def think(
    mock: RunningMock,
    home: Vocabulary,
    folder: Path,
    *texts: str,
    drafts: list[Draft] | None = None,
    **more: object,
) -> list[ThinkResult]:
    asked = {"url": mock.url, "name": "m", "timeout_s": 1.0, "load_timeout_s": 20.0, **more}

    async def all_of_them() -> list[ThinkResult]:
        model = EndpointBrain(ModelSettings.model_validate(asked), folder)
        brain = FallbackBrain(model, OfflineBrain())
        hear = None if drafts is None else drafts.append
        try:
            requests = [ThinkRequest(text=t, vocabulary=home, language=Language.EN) for t in texts]
            return [await brain.think(each, hear) for each in requests]
        finally:
            await model.close()

    return asyncio.run(all_of_them())


def test_a_cold_model_is_waited_for_where_the_grammar_is_not_sure(
    mock: RunningMock, home: Vocabulary, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One connection is held until it is loaded, and the person is told why it takes so long."""
    monkeypatch.setattr(line_module, "SLOW_S", 0.1)
    mock.set(fault="cold", load_s=2.0)
    drafts: list[Draft] = []
    calls = mock.report()["calls"]
    (thought,) = think(mock, home, tmp_path, UNSURE, drafts=drafts)
    assert thought.brain.name == "m"
    assert thought.brain.fallback_from is None
    assert (mock.report()["calls"] - calls, mock.report()["left_load"]) == (1, 0)
    assert "may still be loading" in drafts[0].text
    assert [draft.loads for draft in drafts] == [True, *[False] * (len(drafts) - 1)]


def test_a_sentence_that_the_grammar_reads_surely_waits_for_no_load(
    mock: RunningMock, home: Vocabulary, tmp_path: Path
) -> None:
    mock.set(fault="cold", load_s=2.0)
    left = mock.report()["left_load"]
    first, second = think(mock, home, tmp_path, SURE, UNSURE)
    assert isinstance(first.plan, StepPlan)
    assert (first.brain.name, first.brain.fallback_reason) == ("offline", "loading")
    assert second.brain.name == "m", "the connection of the first order has loaded the model"
    assert mock.report()["left_load"] == left


def test_a_load_in_vain_is_waited_for_once(
    mock: RunningMock, home: Vocabulary, tmp_path: Path
) -> None:
    mock.set(fault="hang")

    async def ask() -> list[str]:
        asked = {"url": mock.url, "name": "m", "timeout_s": 0.5, "load_timeout_s": 1.0}
        model = EndpointBrain(ModelSettings.model_validate(asked), tmp_path)
        brain, why = FallbackBrain(model, OfflineBrain()), []
        try:
            for _ in range(2):
                with pytest.raises(BrainDown) as down:
                    await brain.think(ThinkRequest(text="qwx zzr", vocabulary=home))
                why.append(down.value.why)
        finally:
            await model.close()
        return why

    assert asyncio.run(ask()) == ["loading", "timeout"]


def test_a_server_that_says_it_loads_is_asked_again_until_it_has(
    mock: RunningMock, home: Vocabulary, tmp_path: Path
) -> None:
    mock.set(fault="loading", times=3)
    (thought,) = think(mock, home, tmp_path, UNSURE)
    assert thought.brain.name == "m"


def test_a_warm_up_loads_the_model_before_anybody_asks(
    mock: RunningMock, home: Vocabulary, tmp_path: Path
) -> None:
    mock.set(fault="cold", load_s=0.5)

    async def begin() -> bool:
        asked = {"url": mock.url, "name": "m", "warm_up": True}
        model = EndpointBrain(ModelSettings.model_validate(asked), tmp_path)
        try:
            await model.warm_up(ThinkRequest(text="hello", vocabulary=home))
            thought = await model.think(ThinkRequest(text=SURE, vocabulary=home))
            return thought.plan.kind == "plan"
        finally:
            await model.close()

    assert asyncio.run(begin())
    assert mock.report()["left_load"] == 0 or mock.report()["served"]["cold"] >= 2


@pytest.mark.parametrize("fault", ["stream_open", "stream_silent"])
def test_a_whole_plan_is_used_though_its_stream_stays_open(
    fault: str, mock: RunningMock, home: Vocabulary, tmp_path: Path
) -> None:
    mock.set(fault=fault)
    (thought,) = think(mock, home, tmp_path, SURE, drafts=[], timeout_s=10.0, load_timeout_s=0.0)
    assert (thought.brain.name, thought.plan.kind) == ("m", "plan")


@pytest.mark.parametrize("fault", ["schema_barren", "strict_barren", "tool_never"])
def test_a_way_that_brings_nothing_is_stepped_down_from(
    fault: str, mock: RunningMock, home: Vocabulary, tmp_path: Path
) -> None:
    mock.set(fault=fault)
    first, second = think(mock, home, tmp_path, SURE, SURE, timeout_s=10.0)
    assert [first.brain.name, second.brain.name] == ["m", "m"]
    assert second.calls == 1


@pytest.mark.parametrize(
    ("fault", "code", "words"),
    [
        ("small_context", "context_too_small", "n_ctx 1024"),
        ("error_200", "server_error", "the backend failed"),
        ("status", "server_error", "mock status 500"),
    ],
)
def test_what_the_server_said_is_told_to_the_person(
    fault: str, code: str, words: str, mock: RunningMock, home: Vocabulary, tmp_path: Path
) -> None:
    mock.set(fault=fault)
    (thought,) = think(mock, home, tmp_path, SURE, timeout_s=10.0)
    told = thought.brain.fallback_message
    assert thought.brain.fallback_reason == code
    assert told is not None
    assert words in told.en
    assert words in told.zh


def test_an_error_beside_an_empty_choice_is_an_error(
    mock: RunningMock, home: Vocabulary, tmp_path: Path
) -> None:
    mock.set(fault="stream_error_choice")
    (thought,) = think(mock, home, tmp_path, SURE, drafts=[], timeout_s=10.0)
    assert thought.brain.name == "m", "it is asked for once more, plainly"
