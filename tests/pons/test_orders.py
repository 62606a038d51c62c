"""`pons orders` keeps, leaves out a day, writes a calendar and takes one, with a real planner."""

from __future__ import annotations

import io
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from pons.orders import EXIT_DONE, EXIT_DOWN, EXIT_REFUSED, EXIT_USAGE, run
from pons.settings import LaunchSettings
from tests.planner.api.fakes import FakeServices
from tests.planner.api.serving import served
from tests.planner.orders.fakes import FakeMissions, MovedClocks, standing_orders

Captured = pytest.CaptureFixture[str]


@pytest.fixture
def asked(tmp_path: Path, settings: LaunchSettings) -> Iterator[LaunchSettings]:
    """Return settings of a planner that keeps orders."""
    clock, services = MovedClocks(), FakeServices()
    services.orders = standing_orders(tmp_path, clock, FakeMissions(clock, "two_room"))
    with served(services) as planner:
        yield replace(settings, port=planner.port)


def test_a_day_is_left_out_and_an_order_comes_back_from_its_calendar(
    asked: LaunchSettings, tmp_path: Path, capsys: Captured, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert run(asked, "add", ["every evening at eight go to the kitchen"]) == EXIT_DONE
    assert run(asked, "skip", ["o1", "2027-01-16"]) == EXIT_DONE
    assert "(not on Saturday 2027-01-16)" in capsys.readouterr().out
    assert run(asked, "export", []) == EXIT_DONE
    calendar = tmp_path / "orders.ics"
    calendar.write_text(capsys.readouterr().out, "utf-8")
    assert "EXDATE" in calendar.read_text("utf-8")
    assert run(asked, "remove", ["o1"]) == EXIT_DONE
    for said, verdict, kept in (("n\n", EXIT_REFUSED, 0), ("y\n", EXIT_DONE, 1)):
        monkeypatch.setattr("sys.stdin", io.StringIO(said))
        assert run(asked, "import", [str(calendar)]) == verdict
        assert "not on 2027-01-16" in capsys.readouterr().out
        assert run(asked, "list", []) == EXIT_DONE
        assert capsys.readouterr().out.count("go to the kitchen") == kept


@pytest.mark.parametrize(
    ("act", "words", "verdict"),
    [
        ("skip", [], EXIT_USAGE),
        ("skip", ["o9", "2027-01-16"], EXIT_REFUSED),
        ("import", [], EXIT_USAGE),
        ("import", ["/nowhere/at/all.ics"], EXIT_USAGE),
    ],
)
def test_what_is_lacking_is_told(
    asked: LaunchSettings, act: str, words: list[str], verdict: int, capsys: Captured
) -> None:
    assert run(asked, act, words) == verdict
    assert capsys.readouterr().err


def test_a_calendar_that_can_not_be_kept_is_refused_with_its_code(
    asked: LaunchSettings, tmp_path: Path, capsys: Captured
) -> None:
    calendar = tmp_path / "bad.ics"
    calendar.write_text("no calendar", "utf-8")
    assert run(asked, "import", [str(calendar)]) == EXIT_REFUSED
    assert "calendar" in capsys.readouterr().err


def test_nobody_who_answers_is_told(settings: LaunchSettings, capsys: Captured) -> None:
    assert run(settings, "export", []) == EXIT_DOWN
    assert capsys.readouterr().err
