"""``pons goals`` and ``pons log`` tell what was; a mission is shared as one page."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from planner.api.history import page_of
from planner.mission.effects import Journal
from planner.mission.goal_history import GoalHistory
from planner.mission.journal import MissionJournal
from planner.plan import GoalState, Language
from pons import history
from pons.grammar import parser
from pons.mission_track import read_track
from pons.settings import LaunchSettings, load
from tests.bridge.core.scripted import World
from tests.bridge.recorded import UNIX_S, stream_of, written
from tests.bridge.test_replay import taken
from tests.planner.api.fakes import FakeServices
from tests.planner.api.serving import served
from tests.planner.mission.test_goal_history import mission

pytestmark = pytest.mark.nightly(keep=4)


TOLD: dict[str, Any] = {
    "goal": {"id": "g1", "text": "</script><b>x", "state": "succeeded", "language": "en"},
    "story": {"source": "api", "questions": [], "replies": [], "changes": [], "metres": 0.0},
    "usage": {"goal": None},
}


@pytest.fixture
def settings(tmp_path: Path) -> LaunchSettings:
    journal = MissionJournal.in_home(tmp_path)
    for order in range(1, 4):
        state = GoalState.FAILED if order == 2 else GoalState.SUCCEEDED
        journal.write((Journal(order, (mission(order, f"go to room {order}", state),), ()),))
    return replace(load(), home=tmp_path, host="127.0.0.1")


def ask(settings: LaunchSettings, *words: str) -> int:
    services = FakeServices()
    services.history = GoalHistory.in_home(settings.home)
    said = parser().parse_args(words)
    with served(services) as planner:
        at = replace(settings, port=planner.port)
        return history.run(at, said) if words[0] == "goals" else history.log(at, said)


def test_goals_are_listed_by_day_newest_first_with_result_time_and_length(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    assert ask(settings, "goals") == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line[:10] for line in lines[::2]] == ["1970-01-04", "1970-01-03", "1970-01-02"]
    assert "failed" in lines[3]
    assert "40 s" in lines[3]
    assert "2.5 m" in lines[3]


@pytest.mark.parametrize(
    ("words", "ids"),
    [(["--day", "1970-01-03"], ["g2"]), (["--state", "failed"], ["g2"]),
     (["--search", "room 3"], ["g3"]), (["--most", "2"], ["g3", "g2"])],
)  # fmt: skip
def test_goals_are_found_and_told_as_json(
    settings: LaunchSettings, words: list[str], ids: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert ask(settings, "goals", "--json", *words) == 0
    assert [goal["id"] for goal in json.loads(capsys.readouterr().out)["goals"]] == ids


def test_one_goal_is_shown_with_its_questions(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    assert ask(settings, "goals", "g1") == 0
    told = capsys.readouterr().out
    assert "by cli:ana" in told
    assert "Which cup? -> the red one" in told


@pytest.mark.parametrize(
    ("words", "status"),
    [(["g9"], 3), (["--search", "attic"], 1), (["--day", "yesterday"], 2), (["--html", "x"], 2)],
)
def test_what_is_not_there_or_not_said_well_has_its_status(
    settings: LaunchSettings, words: list[str], status: int
) -> None:
    assert ask(settings, "goals", *words) == status


def test_the_log_tells_the_oldest_first_with_how_each_ended(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    assert ask(settings, "log") == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line[:10] for line in lines] == ["1970-01-02", "1970-01-03", "1970-01-04"]
    assert "'go to room 2'" in lines[1]


def test_a_shared_page_holds_all_asks_no_network_and_runs_no_words(
    settings: LaunchSettings, tmp_path: Path
) -> None:
    assert ask(settings, "goals", "g1", "--html", str(tmp_path / "m.html")) == 0
    assert "the red one" in (tmp_path / "m.html").read_text("utf-8")
    assert ask(settings, "goals", "g9", "--html", str(tmp_path / "m.html")) == 3
    assert ask(settings, "goals", "g1", "--html", str(tmp_path)) == 2
    page = page_of(TOLD, {"samples": [], "events": [], "gaps": [], "way_m": 0.0}, Language.ZH)
    assert "</script><b>" not in page
    assert "http:" not in page
    assert "https:" not in page
    assert "default-src 'none'" in page


def test_a_track_tells_poses_speeds_and_stops_of_its_time(tmp_path: Path) -> None:
    world = World(keep=True).driving((5.0, 0.0))
    world.run(2.0)
    world.stop()
    world.run(2.0)
    (path,) = written(tmp_path, stream_of(world.core, taken(world)), closed=False)
    (tmp_path / "broken.mcap").write_bytes(b"no recording")
    track = read_track(tmp_path, UNIX_S, UNIX_S + 200.0)
    assert path.exists()
    assert max(one["measured_mps"] for one in track["samples"]) > 0.1
    assert track["way_m"] > 0.2
    assert any("STOPPING" in event["detail"] for event in track["events"])
    assert read_track(tmp_path, 0.0, 1.0)["samples"] == []
