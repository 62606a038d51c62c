"""An operator puts another fence in force on a running robot; nobody else and at no other time."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.e2e.polling import until
from tests.e2e.system import TWO_ROOM, Json, System

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(150), pytest.mark.nightly]

KEEP_OUT = [[0.4, 3.4], [0.9, 3.4], [0.9, 3.9], [0.4, 3.9]]


@pytest.fixture
def system(home: Path) -> Iterator[System]:
    site = home / "sites" / "two_room"  # home.yaml names its folder
    shutil.copytree(TWO_ROOM, site)
    with System(home, site).running() as found:
        yield found


def status(system: System) -> Json:
    found: Json = system.http("GET", "/v1/robot").body["status"] or {}
    return found


def test_a_fence_is_proposed_read_signed_and_in_force_after_a_new_start(system: System) -> None:
    before = status(system)["fence_hash"]
    changed = {**json.loads((system.site / "fence.json").read_text()), "keep_outs": [KEEP_OUT]}
    wish = system.home / "new.json"
    wish.write_text(json.dumps(changed))
    done = system.pons("fence", "propose", str(wish))
    assert done.returncode == 0, done.stderr
    name = done.stdout.split()[1].rstrip(";")
    assert "forbidden 0.25 m2" in done.stderr
    assert status(system)["fence_hash"] == before, "a proposal changes nothing"

    refused = system.pons("fence", "accept", name)
    assert refused.returncode == 3
    assert "not_disarmed" in refused.stderr, "the robot is armed"

    assert system.pons("disarm").returncode == 0
    until(lambda: status(system).get("mode") == "DISARMED", 5.0, "DISARMED", system.logs)
    accepted = system.pons("fence", "accept", name)
    assert accepted.returncode == 0, accepted.stderr

    def agreed() -> bool:
        try:
            fence = system.http("GET", "/v1/fence").body
        except OSError:
            return False
        return bool(fence.get("agreed")) and fence["fence_hash"] == name

    until(agreed, 40.0, "bridge and planner on the new fence", system.logs)
    assert (system.site / f"fence-{before}.json").is_file()
    line = json.loads((system.home / "fence" / "accepted.jsonl").read_text())
    assert (line["by"], line["old"], line["new"]) == ("cli", before, name)
    until(lambda: status(system).get("owner"), 20.0, "an owner again", system.logs)
    until(lambda: system.pons("arm").returncode == 0, 20.0, "armed again", system.logs)
    assert status(system)["fence_hash"] == name
