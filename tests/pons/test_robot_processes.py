"""Processes of one robot start as told, say who died, and end with their context."""

from __future__ import annotations

from pathlib import Path

import psutil
import pytest

from pons.robot_processes import BODY, ProcessGone, RobotProcesses
from pons.settings import CHECKOUT, LaunchSettings
from tests.e2e.polling import until

IDLE = "import sys, time\nprint(' '.join(sys.argv[1:]), flush=True)\ntime.sleep(600)\n"
START_S = 40.0


def described(home: Path, port: int) -> RobotProcesses:
    """Return a body and a planner, each a process that says its arguments and then sleeps."""
    (home / "idle.py").write_text(IDLE)
    site = CHECKOUT / "sites" / "two_room"
    names = (*BODY, "planner")
    found = RobotProcesses(
        LaunchSettings(home, CHECKOUT / "robot.toml", site, "127.0.0.1", port),
        names,
        modules=dict.fromkeys(names, "idle"),
        arguments={"sim": ("--start", "1")},
    )
    for child in found.children.values():
        child.environment["PYTHONPATH"] = str(home)
    return found


def test_each_is_told_what_it_needs_and_ends_with_the_context(
    tmp_path: Path, free_port: int
) -> None:
    with described(tmp_path, free_port) as running:
        children = running.children
        until(lambda: all(c.last_words() for c in children.values()), START_S, "all words")
        said = {name: child.last_words() for name, child in children.items()}
        pids = [running.pid(name) for name in children]
        assert running.find_ended() is None
    common = f"--home {tmp_path} --robot {CHECKOUT}/robot.toml --site {CHECKOUT}/sites/two_room"
    assert said["bridge"] == said["localization"] == common
    assert said["sim"] == f"{common} --start 1"
    assert said["planner"] == f"{common} --host 127.0.0.1 --port {free_port}"
    assert [name for name, child in children.items() if child.knows_tokens] == ["planner"]
    assert not any(map(psutil.pid_exists, pids))


def test_one_that_died_is_named_with_its_last_words(tmp_path: Path, free_port: int) -> None:
    running = described(tmp_path, free_port)
    running.children["localization"].arguments[0] = "this"
    with running:
        ended = until(running.find_ended, START_S, "a death", running.logs)
        assert ended.name == "localization"
        assert "Namespaces" in ended.last_words()
        with pytest.raises(ProcessGone, match=r"localization does not run; its log ends:\n"):
            running.pid("localization")
        assert "localization: " in running.logs()
