"""Commands side by side: both run, neither's output is cut, one failure fails all."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from scripts.at_once import BETWEEN
from tests.known import known


def together(*programs: str) -> list[str]:
    words = [sys.executable, "-m", "scripts.at_once"]
    for number, program in enumerate(programs):
        words += [BETWEEN] * (number > 0) + [sys.executable, "-c", program]
    return words


def run(repository: Path, *programs: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        together(*programs), cwd=repository, capture_output=True, text=True, check=False, timeout=40
    )


def test_each_waits_for_the_other_and_each_ones_words_stay_together(
    repository: Path, tmp_path: Path
) -> None:
    meet = (  # ends only if both run at once
        "import sys, pathlib\n"
        "here = pathlib.Path({0!r}); (here / '{1}').touch(); print('{1} began')\n"
        "while not (here / '{2}').exists(): pass\n"
        "print('{1} met')"
    )
    done = run(
        repository,
        meet.format(str(tmp_path), "one", "two"),
        meet.format(str(tmp_path), "two", "one"),
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.split("\n")[:4] == ["one began", "one met", "two began", "two met"]


@pytest.mark.parametrize("codes", [(3, 0), (0, 3)])
def test_one_that_fails_fails_all_but_stops_none(repository: Path, codes: tuple[int, int]) -> None:
    done = run(repository, *(f"print('ran'); raise SystemExit({code})" for code in codes))
    assert (done.returncode, done.stdout.count("ran")) == (3, 2)


def test_an_interrupt_ends_both_and_is_told(repository: Path) -> None:
    wait = (
        "import time\n"
        "try: print('up', flush=True); time.sleep(60)\n"
        "except KeyboardInterrupt: print('ended')"
    )
    with subprocess.Popen(
        together(wait, wait),
        cwd=repository,
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as both:
        assert known(both.stdout).readline() == "up\n"
        os.killpg(both.pid, signal.SIGINT)
        rest = known(both.stdout).read()
    assert both.returncode == 130
    assert rest.count("ended") >= 1
