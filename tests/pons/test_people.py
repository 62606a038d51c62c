"""``pons people`` lists, adds and removes, and prints a QR code that a telephone reads."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from pons import people
from pons.http import PlannerDown, PlannerProblem
from pons.settings import LaunchSettings, load
from tests.pons.test_places import Planner

ANA = {"id": "ana", "name": "Ana", "role": "operator", "since": "2026-11-21T10:11:12+00:00"}


@pytest.fixture
def settings(monkeypatch: pytest.MonkeyPatch) -> LaunchSettings:
    monkeypatch.setenv("PONS_PORT", "8420")
    return load()


@pytest.mark.parametrize(
    ("act", "name", "answer", "asked", "said"),
    [
        ("list", None, {"people": [ANA]}, ("GET", "/v1/people"), "ana"),
        ("list", None, {"people": []}, ("GET", "/v1/people"), "nobody yet"),
        (
            "add",
            "Ana",
            {**ANA, "token": "t" * 43},
            ("POST", "/v1/people", {"name": "Ana", "role": "operator"}),
            "/#token=" + "t" * 43,
        ),
        ("remove", "a b", ANA, ("DELETE", "/v1/people/a%20b"), "removed ana"),
    ],
)
def test_an_act_asks_the_planner_and_tells_what_came_of_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], settings: LaunchSettings,
    act: str, name: str | None, answer: Any, asked: tuple[Any, ...], said: str,
) -> None:  # fmt: skip
    planner = Planner(answer)
    monkeypatch.setattr(people, "call", planner)
    assert people.run(settings, act, name, role="operator") == 0
    assert planner.asked == [asked]
    assert said in capsys.readouterr().out


def test_json_is_one_object_with_the_link(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], settings: LaunchSettings
) -> None:
    monkeypatch.setattr(people, "call", Planner({**ANA, "token": "t"}))
    people.run(settings, "add", "Ana", role="operator", as_json=True)
    assert json.loads(capsys.readouterr().out)["link"].endswith("/#token=t")


@pytest.mark.parametrize(
    ("act", "name", "answer", "status", "said"),
    [
        ("add", None, ANA, 2, "no_name"),
        (
            "add",
            "Ana",
            PlannerProblem(409, "person_exists", "known", {"en": "Known."}),
            3,
            "Known.",
        ),
        ("list", None, PlannerDown("nobody"), 6, "nobody"),
    ],
)
def test_what_fails_is_told_with_its_status(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], settings: LaunchSettings,
    act: str, name: str | None, answer: Any, status: int, said: str,
) -> None:  # fmt: skip
    monkeypatch.setattr(people, "call", Planner(answer))
    assert people.run(settings, act, name, role="viewer") == status
    assert said in capsys.readouterr().err


def test_the_qr_code_on_a_terminal_is_read_back() -> None:
    link = "https://192.168.1.20:8420/#token=" + "Ab-_" * 10
    halves = {" ": (0, 0), "▀": (1, 0), "▄": (0, 1), "█": (1, 1)}
    rows: list[list[int]] = []
    for line in people.qr_text(link).splitlines():
        pairs = [halves[each] for each in re.sub(r"\x1b\[[\d;]*m", "", line)]
        rows += [[top for top, _ in pairs], [bottom for _, bottom in pairs]]
    picture = np.kron(np.array(rows, np.uint8) * 255, np.ones((8, 8), np.uint8))
    assert cv2.QRCodeDetector().detectAndDecode(picture)[0] == link


PAIRS = {"PONS_HOST": "127.0.0.1", "PONS_TLS": "0", "PONS_OPERATOR_TOKEN": "o" * 20}


@pytest.mark.parametrize(
    ("more", "link"),
    [
        ({}, "http://127.0.0.1:8420/#token=OOO&key=KEY"),
        ({"PONS_OPERATOR_TOKEN": ""}, "http://127.0.0.1:8420/#key=KEY"),
        ({"PONS_HOST": "192.0.2.7"}, "http://192.0.2.7:8420/#token=OOO"),
        ({"PONS_HOST": "192.0.2.7", "PONS_TLS": "1"}, "https://192.0.2.7:8420/#token=OOO&key=KEY"),
        (
            {"PONS_HOST": "0.0.0.0", "PONS_TLS": "1", "PONS_ALLOWED_HOSTS": "rover.local"},
            "https://rover.local:8420/#token=OOO&key=KEY",
        ),
    ],
)
def test_the_owners_link_carries_the_key_where_a_page_takes_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path,
    more: dict[str, str], link: str,
) -> None:  # fmt: skip
    for name, value in {**PAIRS, "PONS_PORT": "8420", "PONS_HOME": str(tmp_path), **more}.items():
        monkeypatch.setenv(name, value)
    (tmp_path / "operator.key").write_text("k" * 64 + "\n")
    assert people.run(load(), "pair", None, role="operator") == 0
    out = capsys.readouterr().out
    assert link.replace("OOO", "o" * 20).replace("KEY", "k" * 64) in out.splitlines()
    assert ("without https" in out) is ("KEY" not in link)
