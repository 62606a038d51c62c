"""Check that a failing step fails the whole check and that every step is reported."""

from __future__ import annotations

import signal
import sys

import pytest

from scripts import check, generated


@pytest.fixture(autouse=True)
def keep_interrupt_handler(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave the test run's own handling of Ctrl-C alone."""
    monkeypatch.setattr(signal, "signal", lambda *_: None)


def step(name: str, code: int) -> check.Step:
    return check.Step(name, (sys.executable, "-c", f"raise SystemExit({code})"))


def test_all_passed_is_zero(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(check, "STEPS", (step("one", 0), step("two", 0)))
    assert check.main() == 0


def test_one_failure_fails_all_but_stops_none(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(check, "STEPS", (step("bad", 3), step("good", 0)))
    assert check.main() == 3
    printed = capsys.readouterr().out
    assert "FAILED (3)" in printed
    assert "good" in printed.splitlines()[-2]
    assert "total" in printed.splitlines()[-1]


def test_a_step_killed_by_a_signal_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    kill = "import os, signal; os.kill(os.getpid(), signal.SIGKILL)"
    monkeypatch.setattr(check, "STEPS", (check.Step("killed", (sys.executable, "-c", kill)),))
    assert check.main() != 0


def test_a_missing_generator_fails(capsys: pytest.CaptureFixture[str]) -> None:
    absent = generated.Generator("wire.no_such_module", "docs/nothing.md")
    assert not generated.run(absent, check=True)
    assert "wire.no_such_module" in capsys.readouterr().out


def test_a_generator_below_a_missing_package_is_missing() -> None:
    assert not generated.exists("no_such_package.docs")
    assert generated.exists("json.tool")
