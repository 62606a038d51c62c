"""What docs/sites.md shows is accepted, and it names every class, colour, key and refusal."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from sim.site import parse_home
from sim.site.classes import CLASSES, COLORS
from tests.known import known
from wire import CameraConfig, SimFault

FRAME = """version: 1
site: flat
name: {en: flat, zh: 公寓}
dock: dock
rooms: {hall: {name: {en: hall, zh: 厅}, box: [0, 0, 5, 4], pose: [2.5, 2.0, 0]}}
places: {dock: {name: {en: dock, zh: 充电桩}, pose: [1.0, 2.0, 0]}}
"""


@pytest.fixture(scope="module")
def page(repository: Path) -> str:
    """Return the page."""
    return (repository / "docs" / "sites.md").read_text("utf-8")


def test_its_home_is_one(page: str) -> None:
    block = known(re.search(r"```yaml\n(.*?)```", page, re.DOTALL))
    made = parse_home(FRAME + block.group(1), "docs/sites.md")
    assert set(made.objects) == {"red_cup", "ball", "front_door"}


def test_it_names_all_that_exists(page: str, repository: Path) -> None:
    assert f"Classes: {', '.join(CLASSES)}." in page.replace("\n", " ")
    assert f"{', '.join(COLORS)}." in page.replace("\n", " ")
    shown = set(re.findall(r"`([a-z_]+)`", page))
    # docs/sensors.md
    of_metal = {"device", "url", "serial", "fourcc", "upside_down", "delay_s", "topic"}
    assert set(CameraConfig.model_fields) - {"kind"} - of_metal <= shown
    assert all(fault in page for fault in SimFault if fault.startswith("camera_"))
    source = (repository / "sim" / "site" / "object_checks.py").read_text("utf-8")
    assert set(re.findall(r'yield "([a-z_]+)"', source)) <= shown
