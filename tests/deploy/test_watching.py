"""Alert rules fire when they should; rules and dashboard name figures that the planner gives."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from collections.abc import Callable

import pytest

from pons.settings import CHECKOUT
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of

RULES = CHECKOUT / "deploy" / "prometheus" / "pons.rules.yml"
STORIES = RULES.with_name("pons.test.yml")
DASHBOARD = CHECKOUT / "deploy" / "grafana" / "pons.json"
_NAME = re.compile(r"\bpons_[a-z0-9_]+")
_OF_SERIES = re.compile(r"_(bucket|sum|count|total)$")
AGES = {"pons_localization_age_seconds", "pons_scan_age_seconds", "pons_status_age_seconds"}


def test_the_rules_fire_when_they_should() -> None:
    promtool = shutil.which("promtool")
    if promtool is None:
        pytest.skip("promtool is not installed (apt install prometheus)")
    for words in (["check", "rules", str(RULES)], ["test", "rules", str(STORIES)]):
        done = subprocess.run([promtool, *words], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr


def given() -> set[str]:
    """Return the names of the figures that a planner gives, and those of its series' families."""
    services = FakeServices()
    services.figures.model_call("g1", 1.0, 2, 3)
    text = client_of(services).get("/metrics").text
    families = set(re.findall(r"^# TYPE (\S+)", text, re.MULTILINE))
    return families | {_OF_SERIES.sub("", name) for name in families} | AGES


def asked_by_dashboard() -> str:
    panels = json.loads(DASHBOARD.read_text())["panels"]
    return " ".join(target["expr"] for panel in panels for target in panel["targets"])


@pytest.mark.parametrize("read", [RULES.read_text, asked_by_dashboard], ids=["rules", "dashboard"])
def test_what_is_asked_for_is_there(read: Callable[[], str]) -> None:
    named = {_OF_SERIES.sub("", name) for name in _NAME.findall(read())}
    assert named
    assert named <= given(), named - given()


def test_every_alert_says_what_to_do() -> None:
    alerts = RULES.read_text().count("- alert:")
    assert alerts == RULES.read_text().count("cure:") == RULES.read_text().count("summary:")
    stories = STORIES.read_text()
    named = re.findall(r"- alert: (\w+)", RULES.read_text())
    assert not [name for name in named if name not in stories]
