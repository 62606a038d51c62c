"""The gate runs as many as a mark keeps, others from seed to seed; without it all run."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

CONFTEST = """
from tests.nightly import Sampled, pytest_addoption

def pytest_configure(config):
    config.addinivalue_line("markers", "nightly(keep=0): sampled")
    config.pluginmanager.register(Sampled(config))
"""
CASES = """
import pytest

@pytest.mark.nightly(keep=2)
@pytest.mark.parametrize("case", range(12))
def test_case(case):
    assert case != 7

@pytest.mark.nightly
def test_whole():
    pass

def test_always():
    pass
"""
MODULE = """
import pytest

pytestmark = pytest.mark.nightly(keep=1)

def test_first():
    pass

@pytest.mark.parametrize("case", range(3))
def test_second(case):
    pass
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name, text in {"conftest": CONFTEST, "test_cases": CASES, "test_module": MODULE}.items():
        (tmp_path / f"{name}.py").write_text(text, "utf-8")
    return tmp_path


def ran(folder: Path, repository: Path, *words: str) -> set[str]:
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-v", "-n", "0", *words],
        cwd=folder, env={"PYTHONPATH": str(repository), "PATH": ""},
        capture_output=True, text=True, check=False, timeout=50,
    )  # fmt: skip
    assert done.returncode in {0, 1}, done.stdout + done.stderr
    return set(re.findall(r"^test_\w+\.py::(\S+) (?:PASSED|FAILED)", done.stdout, re.MULTILINE))


def test_without_the_gate_all_run(folder: Path, repository: Path) -> None:
    assert len(ran(folder, repository)) == 12 + 1 + 1 + 4


def test_each_seed_draws_its_own_and_always_the_same(folder: Path, repository: Path) -> None:
    draws = [ran(folder, repository, "--gate", f"--randomly-seed={seed}") for seed in (1, 1, 2, 3)]
    assert draws[0] == draws[1]
    assert len({frozenset(each) for each in draws}) > 1
    for drawn in draws:
        assert "test_always" in drawn
        assert "test_whole" not in drawn
        assert sum(name.startswith("test_case[") for name in drawn) == 2
        assert sum(name.startswith(("test_first", "test_second")) for name in drawn) == 1


def test_what_failed_is_run_again_though_another_seed_would_leave_it_out(
    folder: Path, repository: Path
) -> None:
    ran(folder, repository)
    assert ran(folder, repository, "--gate", "--last-failed") == {"test_case[7]"}
