"""``pons replies`` shows what a model wrote, or says in both languages why there is nothing."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest

from planner.api import Access
from planner.brain.model_replies import ReplyCollector, ReplyTurn
from pons import replies
from pons.__main__ import _dispatch
from pons.grammar import parser
from pons.settings import LaunchSettings, load
from tests.planner.api.fakes import FakeServices
from tests.planner.api.serving import served as real_planner
from tests.pons.served_goals import Planner

ACCESS = Access("127.0.0.1", operator_token="o" * 16, viewer_token="v" * 16)


@pytest.fixture(scope="module")
def running() -> Iterator[tuple[FakeServices, LaunchSettings]]:
    with real_planner() as planner:
        yield planner.services, replace(load(), host="127.0.0.1", port=planner.port)


def collect(most: int, *texts: str) -> ReplyCollector:
    collector = ReplyCollector(most)
    for number, text in enumerate(texts):
        turn = ReplyTurn.REPAIR if number else ReplyTurn.PLAN
        collector.keep("g1", text, model="qwen3", turn=turn, used=bool(number))
    return collector


@pytest.mark.parametrize("words", [["replies"], ["replies", "g1"]])
def test_what_the_model_wrote_is_shown_turn_by_turn(
    running: tuple[FakeServices, LaunchSettings],
    words: list[str],
    capsys: pytest.CaptureFixture[str],
) -> None:
    services, settings = running
    services.replies = collect(5, "", '{\n"kind": "plan"}')
    assert _dispatch(settings, parser().parse_args(words), words) == replies.EXIT_SHOWN
    head, first, second = capsys.readouterr().out.strip().split("\n\n")
    assert head.startswith("g1")
    assert first.endswith("qwen3  plan  not used\n  (empty)")
    assert second.endswith('repair  used\n  {\n  "kind": "plan"}')


def test_where_nothing_is_kept_the_setting_is_named_in_both_languages(
    running: tuple[FakeServices, LaunchSettings],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    services, settings = running
    services.replies = collect(0)
    assert replies.run(settings, None) == replies.EXIT_NOTHING
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    assert replies.run(settings, None) == replies.EXIT_NOTHING
    english, chinese = capsys.readouterr().out.strip().split("\n")
    assert english.startswith("not_kept: ")
    for sentence in (english, chinese):
        assert "keep_replies = 20" in sentence
        assert "[model]" in sentence
    assert "没有保留" in chinese


def test_where_nothing_of_this_goal_is_kept_that_is_told(
    running: tuple[FakeServices, LaunchSettings], capsys: pytest.CaptureFixture[str]
) -> None:
    services, settings = running
    services.replies = collect(7)
    assert replies.run(settings, "g1") == replies.EXIT_NOTHING
    told = capsys.readouterr().out
    assert "no_replies: " in told
    assert told.count("7") == 1


def test_an_unknown_goal_is_refused_as_ever(
    running: tuple[FakeServices, LaunchSettings], capsys: pytest.CaptureFixture[str]
) -> None:
    _, settings = running
    assert replies.run(settings, "no/such") == replies.EXIT_REFUSED
    assert replies.run(settings, "g9") == replies.EXIT_REFUSED
    assert "unknown_goal" in capsys.readouterr().err


def test_a_viewer_is_refused_in_both_languages(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PONS_OPERATOR_TOKEN", "v" * 16)
    with real_planner(access=ACCESS) as planner:
        settings = replace(load(), host="127.0.0.1", port=planner.port)
        assert replies.run(settings, "g1") == replies.EXIT_REFUSED
    told = capsys.readouterr().err
    assert "operator_needed" in told
    assert "operator's token" in told


def test_without_a_goal_or_a_planner_that_is_told(
    served: tuple[Planner, LaunchSettings], capsys: pytest.CaptureFixture[str]
) -> None:
    _, settings = served
    assert replies.run(settings, None) == replies.EXIT_NOTHING
    assert "no goal was given yet" in capsys.readouterr().err
    assert replies.run(replace(settings, port=1), None) == replies.EXIT_DOWN
    assert "Is `pons up` running?" in capsys.readouterr().err
