"""The routes of the mission list: pages, filters, one with its story."""

from __future__ import annotations

from pathlib import Path

import pytest
from starlette.testclient import TestClient

from planner.mission.effects import Journal
from planner.mission.errors import UnknownGoal
from planner.mission.goal_history import GoalHistory
from planner.mission.journal import MissionJournal
from planner.plan import Goal, GoalState
from tests.planner.api.fakes import FakeGoals, FakeServices
from tests.planner.api.served import client_of
from tests.planner.mission.test_goal_history import mission


@pytest.fixture
def client(tmp_path: Path) -> TestClient:
    services = FakeServices()
    journal = MissionJournal.in_home(tmp_path)
    missions = (mission(1, "go home"), mission(2, "go to the attic", GoalState.FAILED))
    journal.write((Journal(1, missions, ()),))
    services.history = GoalHistory.in_home(tmp_path)
    return client_of(services)


def test_the_list_is_told_page_by_page(client: TestClient) -> None:
    page = client.get("/v1/history", params={"limit": 1}).json()
    assert [goal["id"] for goal in page["goals"]] == ["g2"]
    rest = client.get("/v1/history", params={"before": page["next"]}).json()
    assert ([goal["id"] for goal in rest["goals"]], rest["next"]) == (["g1"], None)
    failed = client.get("/v1/history", params={"state": "failed", "search": "attic"}).json()
    assert [goal["id"] for goal in failed["goals"]] == ["g2"]


def test_one_goal_comes_with_its_story_and_its_cost(client: TestClient) -> None:
    told = client.get("/v1/history/g1").json()
    assert told["story"]["metres"] == 2.5
    assert told["story"]["replies"] == ["the red one"]
    assert "calls_since_start" in told["usage"]
    unknown = client.get("/v1/history/g9")
    assert (unknown.status_code, unknown.json()["code"]) == (404, "unknown_goal")


def test_a_track_is_read_by_a_process_and_empty_where_nothing_is_kept(client: TestClient) -> None:
    track = client.get("/v1/history/g1/track").json()
    assert track == {"samples": [], "events": [], "gaps": [], "way_m": 0.0}
    assert client.get("/v1/history/g9/track").status_code == 404


def test_a_mission_is_given_as_a_file_that_runs_nothing_here(client: TestClient) -> None:
    page = client.get("/v1/history/g1/page", params={"language": "zh"})
    assert page.status_code == 200
    assert page.headers["content-disposition"] == 'attachment; filename="pons-g1.html"'
    assert "script-src 'self'" in page.headers["content-security-policy"]
    assert page.headers["cache-control"] == "no-store"
    assert "the red one" in page.text
    assert '"labels": "zh"' in page.text
    assert client.get("/v1/history/g9/page").status_code == 404
    assert client.get("/v1/history/g1/page", params={"language": "fr"}).status_code == 422


@pytest.mark.parametrize(
    "wrong", ["limit=0", "limit=1000", "state=odd", "before=-1", "since_unix_s=x"]
)
def test_a_malformed_question_is_refused(client: TestClient, wrong: str) -> None:
    assert client.get(f"/v1/history?{wrong}").status_code == 422


def test_a_goal_that_is_at_hand_no_more_is_shown_by_its_id(client: TestClient) -> None:
    assert client.get("/v1/goals/g2").json()["state"] == "failed"
    assert client.get("/v1/goals/g9").status_code == 404


@pytest.mark.parametrize(
    ("made", "status", "told"), [("g2", 202, ("id", "g2")), ("g9", 409, ("code", "goal_forgotten"))]
)
def test_a_request_that_comes_again_makes_no_second_goal_however_old_the_first(
    client: TestClient,
    monkeypatch: pytest.MonkeyPatch,
    made: str,
    status: int,
    told: tuple[str, str],
) -> None:
    async def submit(*_: object, **__: object) -> Goal:
        raise UnknownGoal(made, ())

    monkeypatch.setattr(FakeGoals, "submit", submit)
    again = client.post("/v1/goals", json={"text": "go"}, headers={"Idempotency-Key": "k"})
    assert (again.status_code, again.json()[told[0]]) == (status, told[1])


def test_changes_are_listed_behind_a_cursor(client: TestClient) -> None:
    first = client.get("/v1/goals", params={"after": 0, "limit": 1}).json()
    rest = client.get("/v1/goals", params={"after": first["next"]}).json()
    assert [goal["id"] for goal in (*first["goals"], *rest["goals"])] == ["g1", "g2"]
    assert client.get("/v1/goals", params={"after": rest["next"]}).json() == {
        "goals": [], "next": rest["next"],
    }  # fmt: skip
    assert client.get("/v1/goals?after=-1").status_code == 422


def test_what_the_robot_can_do_is_told_by_itself(client: TestClient) -> None:
    told = client.get("/v1/capabilities").json()
    assert {"go_to", "say"} <= set(told["steps"])
    assert "go_to_pose" not in told["steps"]
    assert [place["id"] for place in told["places"]]
    assert (told["languages"], told["camera"]) == (["en", "zh"], "sim")
