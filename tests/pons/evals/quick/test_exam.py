"""Check the exam of a model: what it asks, where it ends, what it spends, how it grades."""

from __future__ import annotations

import asyncio
import json
from dataclasses import astuple, dataclass, field, replace
from pathlib import Path
from typing import cast

import pytest

from planner.brain import BadPlan, BrainDown
from planner.brain.image_questions import (
    ImageDescription,
    ImagePoint,
    ImageQuestion,
    Looker,
    NotSent,
    NotThere,
)
from planner.brain.jpeg_metadata import jpeg_size
from planner.budget import Ledger, Purse
from planner.budget.budget import OpenCall
from planner.budget.utc_day import utc_date
from planner.plan import BrainTag, say_same
from planner.settings import (
    FILE,
    BudgetSettings,
    DayLimits,
    GoalLimits,
    ModelSettings,
    Settings,
    load_settings,
)
from pons.__main__ import main
from pons.evals.matchers import read_expectation
from pons.evals.model_access import choose_model
from pons.evals.quick import command, show
from pons.evals.quick.ask import PROMPT_TOKENS, Caps, examine
from pons.evals.quick.exam import (
    QUESTIONS,
    WORLD,
    Exam,
    ExamPart,
    MarkedAnswer,
    ModeResult,
    Result,
    ServerPace,
)
from pons.evals.quick.eyes import DISC, PICTURE, examine_eyes
from pons.evals.quick.grade import grade
from tests.pons.mock_llm.mocks import RunningMock
from wire import ConfigError

pytestmark = pytest.mark.nightly(keep=18)


STRICT = (ModeResult("json_schema", taken=True, right=True),)


def taken(mock: RunningMock, home: Path, caps: Caps | None = None, **day: int) -> Exam:
    """Let the mock take the exam."""
    model = ModelSettings(url=mock.url, name="mock", timeout_s=1.0, load_timeout_s=0.0)
    settings = Settings(model=model, budget=BudgetSettings(day=DayLimits(**day)))
    return asyncio.run(examine(settings, model, home, None, caps or Caps()))


def test_a_good_model_takes_every_mode_and_pays_for_its_calls(
    mock: RunningMock, tmp_path: Path
) -> None:
    before = mock.set()["calls"]
    exam = taken(mock, tmp_path)
    assert all(rung.right for rung in exam.rungs)
    assert [m.question for m in exam.marked] == list(QUESTIONS)
    for part in (ExamPart.REFUSAL, ExamPart.INJECTION):
        assert {m.result for m in exam.of(part)} == {"right"}
    assert mock.report()["calls"] - before == exam.cost.calls
    ledger = Ledger.in_home(tmp_path)
    today = ledger.newest or utc_date(0.0)
    ledger.remember(today)
    assert ledger.of_day(today).calls == exam.cost.calls > len(QUESTIONS)
    ledger.close()
    assert not (tmp_path / "model_dialects.json").exists()
    assert exam.eyes.result == "no_answer", "the mock takes pictures and has no eyes"


@pytest.mark.parametrize(
    ("fault", "modes", "letters"),
    [
        ("no_schema", {"prompt"}, "BCD"),
        ("garbage", set(), "F"),
        ("hang", set(), "F"),
        ("status", set(), "F"),
    ],
)
def test_a_model_with_a_fault_is_graded_down(
    mock: RunningMock, fault: str, modes: set[str], letters: str, tmp_path: Path
) -> None:
    mock.set(fault=fault)
    exam = taken(mock, tmp_path, Caps(calls=14, seconds=0.6 if fault == "hang" else 60.0))
    assert {rung.mode for rung in exam.rungs if rung.right} == modes
    found = grade(exam)
    assert found.letter in letters
    assert all(reason.words.en and reason.words.zh for reason in found.reasons)
    if not any(rung.taken for rung in exam.rungs):
        assert {m.result for m in exam.marked} == {"not_asked"}, "no order was asked"


def test_a_model_that_is_too_slow_is_told_from_one_that_is_gone(
    mock: RunningMock, tmp_path: Path
) -> None:
    told = []
    for switches in ({"fault": "hang"}, {"fault": "status", "status": 500}):
        mock.set(**switches)
        model = ModelSettings(url=mock.url, name="mock", timeout_s=0.5, load_timeout_s=0.0)
        exam = asyncio.run(examine(Settings(model=model), model, tmp_path, None, Caps()))
        told.append(grade(exam).reasons[0].words.en)
    assert "timeout_s in [model]" in told[0]
    assert told[1] == "it answered nothing"


TAG = BrainTag(name="m", version="1")


@dataclass
class Scripted:
    """Look as a script says."""

    words: str = "A red disc."
    at: ImagePoint | NotThere = field(default_factory=lambda: ImagePoint(*DISC, TAG))
    failure: Exception | None = None
    tag: BrainTag = TAG

    async def describe(self, asked: ImageQuestion) -> ImageDescription:
        assert asked.goal == "exam"
        if self.failure is not None:
            raise self.failure
        return ImageDescription(say_same(self.words), None, TAG)

    async def point(self, _asked: ImageQuestion) -> ImagePoint | NotThere:
        return self.at


@pytest.mark.parametrize(
    ("looker", "result", "why"),
    [
        (Scripted(), "right", ""),
        (Scripted(at=ImagePoint(740, 500, TAG)), "wrong", "(740, 500)"),
        (Scripted(at=NotThere(TAG)), "wrong", "nowhere"),
        (Scripted("I see a red and a blue thing."), "wrong", "blue"),
        (Scripted("A nice cat."), "wrong", "cat"),
        (Scripted(failure=NotSent("x", why="no_pictures")), "none", "no_pictures"),
        (Scripted(failure=BrainDown("x", why="timeout")), "no_answer", "timeout"),
        (Scripted(failure=BadPlan("twice")), "no_answer", "twice"),
    ],
)
def test_whether_a_model_sees_is_found_out(looker: Scripted, result: str, why: str) -> None:
    assert jpeg_size(PICTURE.jpeg) == (PICTURE.width, PICTURE.height)
    eyes = asyncio.run(examine_eyes(cast("Looker", looker), "exam"))
    assert eyes.result == result
    assert why in eyes.why
    assert why in show.table(replace(exam_of(), eyes=eyes), grade(exam_of()), None)


@pytest.mark.parametrize(
    ("caps", "day", "calls"),
    [(Caps(calls=6), {}, 6), (Caps(seconds=0.0), {}, 0), (Caps(), {"calls": 5}, 5)],
)
def test_the_exam_ends_at_its_caps_and_at_the_days(
    mock: RunningMock, caps: Caps, day: dict[str, int], calls: int, tmp_path: Path
) -> None:
    before = mock.set()["calls"]
    exam = taken(mock, tmp_path, caps, **day)
    assert mock.report()["calls"] - before == exam.cost.calls == calls
    assert any(m.result in ("not_asked", "no_answer") for m in exam.marked)
    assert grade(exam).letter != "A"


def test_a_slow_model_has_time_left_for_the_orders(mock: RunningMock, tmp_path: Path) -> None:
    """By this clock each call takes 16 s, so that four rungs would take the whole minute."""
    before = mock.set()["calls"]
    model = ModelSettings(url=mock.url, name="mock")
    exam = asyncio.run(
        examine(
            Settings(model=model),
            model,
            tmp_path,
            None,
            Caps(),
            lambda: 16.0 * (mock.report()["calls"] - before),
        )
    )
    assert [rung.asked for rung in exam.rungs] == [True, True, False, False]
    assert [m.result for m in exam.marked[:3]] == ["right", "right", "not_asked"]
    assert "json_object not asked · prompt not asked" in show.table(exam, grade(exam), None)


def test_the_command_shows_a_table_and_json(
    mock: RunningMock,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    mock.set()
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    status = main(["doctor", "--model", f"mock@{mock.url}", "--json"])
    shown = json.loads(capsys.readouterr().out)
    assert status == command.EXIT[shown["grade"]]
    assert (shown["model"], shown["host"], len(shown["answers"])) == (
        "mock",
        "127.0.0.1",
        len(QUESTIONS),
    )
    assert 0 < shown["prompt_tokens_here"] <= 1500
    table = show.table(exam_of("w"), grade(exam_of("w")), "EUR")
    assert all(f"\n{name} " in table for name in ("modes", "injection", "latency", "grade"))
    assert "0.0000 EUR" in table


def test_no_call_of_an_exam_passes_what_was_said_to_be_the_most(
    mock: RunningMock, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sent, limits = list[int](), list[GoalLimits]()

    class Noted(Purse):
        async def open(self, prompt_tokens: int) -> OpenCall:
            limits.append(self._budget.goal)
            sent.append(prompt_tokens)
            return await super().open(prompt_tokens)

    monkeypatch.setattr("pons.evals.model_access.Purse", Noted)
    for fault in (None, "garbage"):  # with garbage, each second call is a repair
        mock.set(fault=fault)
        taken(mock, tmp_path)
    assert max(sent) <= PROMPT_TOKENS
    assert limits[0].prompt_tokens == Caps().calls * PROMPT_TOKENS
    assert limits[0].reply_tokens == Caps().calls * ModelSettings(url=mock.url, name="m").max_tokens


def test_elsewhere_it_says_what_it_will_spend_and_spends_nothing_unasked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    async def asked(*_: object) -> Exam:
        return Exam("m", "model.example")

    monkeypatch.setattr(command, "examine", asked)
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    (tmp_path / FILE).write_text(
        '[model]\nurl = "https://model.example/v1"\nname = "m"\nmax_tokens = 500\n'
        "[budget.price]\nprompt_per_million = 10\nreply_per_million = 100\n"
    )
    monkeypatch.setattr("sys.stdin.isatty", lambda: False, raising=False)
    for locale, told in (
        ("C", ("not this machine", "40 calls", "at most 140000 tokens", "at most 3.40 USD")),
        ("zh_CN.UTF-8", ("不是本机", "40 次", "最多发送 140000", "最多 3.40 USD")),
    ):
        monkeypatch.setenv("LC_ALL", locale)
        assert main(["doctor", "--model"]) == command.REFUSED
        said = capsys.readouterr()
        assert said.out == ""
        for words in ("model.example", "not_agreed", *told):
            assert words in said.err
    assert main(["doctor", "--model", "--yes"]) == command.EXIT["F"]
    assert main(["doctor", "--model", "http://169.254.169.254/v1", "--yes"]) == command.REFUSED
    assert "model_url" in capsys.readouterr().err


_MARKS: dict[str, Result] = {
    ".": "right",
    "w": "wrong",
    "u": "unsafe",
    "p": "no_plan",
    "n": "no_answer",
    "-": "not_asked",
}


def exam_of(marks: str = "", seconds: float = 1.0, calls: int = 1, *, strict: bool = True) -> Exam:
    """Return an exam with these marks in turn, the rest right."""
    given = [_MARKS[mark] for mark in marks.ljust(len(QUESTIONS), ".")]
    marked = [
        MarkedAnswer(
            q, r, seconds=seconds if r in ("right", "wrong", "unsafe") else None, calls=calls
        )
        for q, r in zip(QUESTIONS, given, strict=True)
    ]
    rungs = STRICT if strict else (replace(STRICT[0], right=False),)
    return Exam("m", "h", rungs, tuple(marked), took_s=60.0)


@pytest.mark.parametrize(
    ("exam", "letter", "told"),
    [
        (exam_of(), "A", ""),
        (exam_of("w"), "B", "3 of 4 right"),
        (exam_of("w...w"), "C", "2 of 4 right"),
        (exam_of("...u"), "D", "moved the robot wrongly"),
        (exam_of("p...p...w"), "D", "1 of 4"),
        (exam_of("n" * len(QUESTIONS)), "F", "answered nothing"),
        (exam_of("w" * len(QUESTIONS)), "F", "0 of 4 right"),
        (exam_of(strict=False), "B", "only the prompt"),
        (exam_of(seconds=7.0), "B", "slow"),
        (exam_of(seconds=12.0), "C", "slow"),
        (exam_of(calls=2), "B", "more than one call"),
        (exam_of("...............-"), "B", "1 of 16 orders not asked"),
        (exam_of("....------------"), "C", "12 of 16"),
        (exam_of("-" * len(QUESTIONS)), "F", "too slow: 60 s"),
    ],
)
def test_the_grade_is_the_worst_that_was_found(exam: Exam, letter: str, told: str) -> None:
    found = grade(exam)
    assert found.letter == letter
    assert not told or told in found.reasons[0].words.en


def test_every_part_is_asked_early_and_every_place_exists() -> None:
    assert {question.part for question in QUESTIONS[:4]} == set(ExamPart)
    for question in QUESTIONS:
        assert bool(read_expectation(question.right).plans) == (question.right != "still")
    assert {"kitchen", "bedroom", "noticeboard"} <= WORLD.by_id.keys()


@pytest.mark.parametrize(
    ("word", "name", "url"),
    [
        ("", "own", "http://127.0.0.1:1/v1"),
        ("other", "other", "http://127.0.0.1:1/v1"),
        ("http://127.0.0.1:2/v1", "own", "http://127.0.0.1:2/v1"),
        ("a@b@http://127.0.0.1:2/v1", "a@b", "http://127.0.0.1:2/v1"),
    ],
)
def test_a_model_is_chosen_by_name_and_url(word: str, name: str, url: str, tmp_path: Path) -> None:
    (tmp_path / FILE).write_text(
        '[model]\nurl = "http://127.0.0.1:1/v1"\nname = "own"\nkey = "sk-owners-own"\n'
        "[budget.price]\nreply_per_million = 1.0\n"
    )
    settings, model = choose_model(word, tmp_path, {})
    assert (model.name, model.url) == (name, url)
    elsewhere = ":2/" in url
    assert (model.key is None, settings.budget.price is None) == (elsewhere, elsewhere)


def test_without_any_model_the_choice_says_what_to_give(tmp_path: Path) -> None:
    assert load_settings(tmp_path, {}).model is None
    for word in ("", "m", "http://127.0.0.1:1/v1"):
        with pytest.raises(ConfigError, match=r"NAME@URL") as wrong:
            choose_model(word, tmp_path, {})
        assert wrong.value.code == "model_not_set"


@pytest.mark.parametrize(
    ("fault", "held", "told"),
    [
        (None, {"json_schema": True}, "json_schema binds"),
        ("schema_ignored", {"json_schema": False, "tool": False}, "tool taken and not held to"),
        ("no_json_schema", {"tool": True}, "tool binds"),
        ("no_schema", {}, "not found out"),
        ("fenced", {"json_schema": False, "tool": False}, "json_schema taken and not held to"),
    ],
)
def test_whether_a_schema_binds_is_proved_by_a_word_that_the_prompt_does_not_tell(
    mock: RunningMock, fault: str | None, held: dict[str, bool], told: str, tmp_path: Path
) -> None:
    mock.set(fault=fault)
    exam = taken(mock, tmp_path)
    assert {rung.mode: rung.held for rung in exam.rungs if rung.held is not None} == held
    found = grade(exam)
    assert told in show.table(exam, found, None)
    loose = [reason.words for reason in found.reasons if "does not hold" in reason.words.en]
    assert bool(loose) == (False in held.values())
    assert all("->" in words.en and "->" in words.zh for words in loose)


def test_the_first_word_is_timed_cold_and_warm_and_a_load_takes_no_time_from_the_orders(
    mock: RunningMock, tmp_path: Path
) -> None:
    mock.set(fault="cold", load_s=1.0, tokens_per_s=200.0)
    model = ModelSettings(url=mock.url, name="mock", timeout_s=5.0, load_timeout_s=20.0)
    caps = Caps(calls=4, seconds=60.0)
    exam = asyncio.run(examine(Settings(model=model), model, tmp_path, None, caps))
    first_s, second_s, rate = astuple(exam.speed)
    assert first_s >= 1.0 > second_s
    assert 0.0 < rate <= 250.0
    assert f"at the first call, the second {second_s:.2f} s" in show.table(exam, grade(exam), None)


def test_a_server_that_never_says_a_word_is_not_measured(mock: RunningMock, tmp_path: Path) -> None:
    mock.set(fault="hang")
    exam = taken(mock, tmp_path, Caps(seconds=0.6))
    assert exam.speed == ServerPace()
    assert "speed      not measured" in show.table(exam, grade(exam), None)


@pytest.mark.parametrize(
    ("speed", "told"),
    [
        (ServerPace(60.0, 0.3, 40.0), ["cold: the first call waited 60 s"]),
        (ServerPace(9.0, 8.5, 40.0), ["prefix cache"]),
        (ServerPace(1.0, 0.5, 6.0), ["6.0 tokens a second"]),
        (ServerPace(1.0, 0.5, 40.0), []),
        (ServerPace(1.0, 0.5, None), []),
        (ServerPace(), []),
    ],
)
def test_a_slow_server_is_told_with_a_cure_and_graded_by_its_orders(
    speed: ServerPace, told: list[str]
) -> None:
    found = grade(replace(exam_of(), speed=speed))
    assert found.letter == "A"
    assert len(found.reasons) == len(told)
    for words, reason in zip(told, found.reasons, strict=True):
        assert words in reason.words.en
        assert "->" in reason.words.en and "->" in reason.words.zh  # noqa: PT018  # both at once
