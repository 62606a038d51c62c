"""The command measures, appends, refuses what it doesn't know, and leaves nothing on Ctrl-C."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

from tools.bench.__main__ import main
from tools.bench.context import BenchLab, MeasurementFailure
from tools.bench.measure import ALL
from tools.bench.report import ReportRow, row_of


def test_every_measurement_has_a_name_of_its_own_and_a_title() -> None:
    names = [one.NAME for one in ALL]
    assert len(set(names)) == len(names)
    assert all(one.TITLE for one in ALL)


class Fake:
    NAME = "fake"
    TITLE = "a fake"
    LONG_ONLY = False
    fails = False

    @classmethod
    def measure(cls, lab: BenchLab) -> list[ReportRow]:
        if cls.fails:
            raise MeasurementFailure("nothing came")
        return [row_of("speed", "x", ">= 10", list(lab.slices("one", 2, float)))]


@pytest.mark.parametrize(("fails", "code"), [(False, 0), (True, 1)])
def test_rows_are_printed_and_appended_whatever_happened(
    fails: bool,
    code: int,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr("tools.bench.__main__.ALL", (Fake,))
    monkeypatch.setattr(Fake, "fails", fails)
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    assert main([]) == code
    lines = (tmp_path / "bench" / "results.jsonl").read_text("utf-8").splitlines()
    row = json.loads(lines[-1])
    assert row["kind"] == "row"
    assert row["machine"]
    assert row["commit"]
    assert fails or row["figures"]["p50"] == 0.0
    assert ("nothing came" if fails else ">= 10") in capsys.readouterr().out


def test_a_lost_slice_is_shown_and_told_by_the_exit_status(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def measure(bench: BenchLab) -> list[ReportRow]:
        def take(index: int) -> float:
            raise MeasurementFailure("no robot")

        return [row_of("speed", "x", "", list(bench.slices("one", 1, take)))]

    monkeypatch.setattr("tools.bench.__main__.ALL", (Fake,))
    monkeypatch.setattr(Fake, "measure", measure)
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    assert main([]) == 1
    assert "lost: one 1: no robot" in capsys.readouterr().out


def test_an_unknown_name_is_refused_with_what_exists(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["no_such_bench"])
    assert "core_step" in capsys.readouterr().err


@pytest.mark.nightly
@pytest.mark.e2e
def test_ctrl_c_ends_every_process(tmp_path: Path) -> None:
    bench = subprocess.Popen(
        [sys.executable, "-m", "tools.bench", "footprint"],
        env={**os.environ, "PONS_HOME": str(tmp_path)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        parent = psutil.Process(bench.pid)
        deadline_s = time.monotonic() + 30.0
        while len(children := parent.children(recursive=True)) < 4:
            assert bench.poll() is None, "the bench ended before it started anything"
            assert time.monotonic() < deadline_s, "the bench started no robot"
            time.sleep(0.05)
        bench.send_signal(signal.SIGINT)
        assert bench.wait(timeout=30.0) == 130
        _, alive = psutil.wait_procs(children, timeout=10.0)
        assert alive == []
    finally:
        bench.kill()
        bench.wait()
