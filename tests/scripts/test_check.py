"""Check that a failing step fails the whole check and that every step is reported."""

from __future__ import annotations

import signal
import sys
from pathlib import Path

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


def test_steps_beside_each_other_run_at_once_and_are_each_told(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    meet = (  # ends only if both run at once
        "import pathlib; here = pathlib.Path({0!r}); (here / '{1}').touch(); print('in {1}')\n"
        "while not (here / '{2}').exists(): pass\n"
        "raise SystemExit({3})"
    )
    steps = tuple(
        check.Step(own, (sys.executable, "-c", meet.format(str(tmp_path), own, other, code)), late)
        for own, other, code, late in (("a", "b", 0, False), ("b", "a", 4, True))
    )
    monkeypatch.setattr(check, "STEPS", (*steps, step("after", 0)))
    assert check.main() == 4
    printed = capfd.readouterr().out
    assert printed.index("== b") < printed.index("in b") < printed.index("== after")
    assert [line.split()[0] for line in printed.splitlines()[-4:]] == ["a", "b", "after", "total"]


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
