"""Hold the fleet's code to its laws, by its own text."""

from __future__ import annotations

import asyncio
import re
import subprocess
import sys
from dataclasses import replace

import pytest

from fleet import workflow
from fleet.errors import WORDS, tell
from tests.conftest import ROOT
from tests.fleet.test_store import kept_mission

SOURCES = {path.name: path.read_text("utf-8") for path in (ROOT / "fleet").glob("*.py")}


def test_durable_step_is_the_one_way_to_a_step() -> None:
    assert not [name for name, text in SOURCES.items() if re.search(r"DBOS\.step\b", text)]
    calls = sum(len(re.findall(r"DBOS\.run_step", text)) for text in SOURCES.values())
    assert calls == 1


def test_no_queue_of_the_engine_is_used() -> None:
    assert not [name for name, text in SOURCES.items() if re.search(r"\bQueue\(|_queue\(", text)]


@pytest.mark.parametrize("mission_id", ["", "  "])
def test_an_empty_id_is_refused_before_the_engine_sees_it(mission_id: str) -> None:
    mission = replace(kept_mission(), id=mission_id)
    with pytest.raises(ValueError, match="without an id"):
        asyncio.run(workflow.begin(mission))


@pytest.mark.parametrize("code", WORDS)
def test_each_code_is_told_in_both_languages(code: str) -> None:
    facts = dict.fromkeys(("name", "known", "state", "why", "found", "role", "count"), "X")
    told = tell(code, facts)
    assert told["en"] != told["zh"]
    assert re.search(r"[\u4e00-\u9fff]", told["zh"])
    assert "{" not in told["en"] + told["zh"]


def test_each_code_that_is_raised_has_words() -> None:
    raised = {
        code
        for text in SOURCES.values()
        for code in re.findall(r'FleetError\(\s*"([a-z_]+)"', text)
    }
    assert raised <= set(WORDS)


def test_a_robot_without_a_fleet_loads_nothing_of_it() -> None:
    """Neither the fleet, nor its engine, nor its database's driver."""
    code = (
        "import sys, planner.__main__, planner.app, pons.__main__\n"
        "kept = ('fleet', 'dbos', 'psycopg')\n"
        "print([name for name in sys.modules if name.split('.')[0] in kept])"
    )
    ran = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert ran.stdout.strip().splitlines()[-1] == "[]"
