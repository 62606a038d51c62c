"""Install the wheel where no checkout is, and drive by a sentence from an empty folder."""

from __future__ import annotations

import signal
import socket
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import cv2
import fastapi
import numpy as np
import pytest

from pons.robot_processes import free_port
from scripts.wheel import build_wheel
from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import HOME_SITE, ROOT, System, new_home

pytestmark = [pytest.mark.home, pytest.mark.timeout(300), pytest.mark.nightly(keep=2)]

PACKAGES = {"bridge", "localization", "planner", "pons", "pons_assets", "sim", "wire"}
"""What a wheel must hold; a new room of the product may come, a folder of the workshop may not."""
WORKSHOP = {"tools", "tests", "scripts", "examples", "web", "docs", "deploy", "build", "setup.py"}
DRIVE_LIMIT_S = 120.0


class InstalledSystem(System):
    """Run Pons from an environment that holds the wheel, in a folder that holds nothing."""

    def __init__(self, folder: Path, python: Path) -> None:
        super().__init__(folder / ".pons", HOME_SITE)
        self.python, self.folder = str(python), folder

    @property
    def environment(self) -> dict[str, str]:
        """Return a person's environment: neither a site nor a path to a checkout is told."""
        hidden = ("PONS_SITE", "PYTHONPATH")
        return {name: text for name, text in super().environment.items() if name not in hidden}

    def run(self, *words: str) -> subprocess.CompletedProcess[str]:
        """Run this environment's Python in the empty folder."""
        return subprocess.run(
            [self.python, *words], cwd=self.folder, env=self.environment,
            capture_output=True, text=True, check=False, timeout=60,
        )  # fmt: skip


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the wheel of this checkout."""
    if not (ROOT / "web" / "dist" / "index.html").is_file():
        pytest.skip("the page is not built; `make page` builds it")
    return build_wheel(tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module")
def python(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the Python of an environment with the wheel; what it depends on is lent by ours."""
    folder = tmp_path_factory.mktemp("installed")
    made = folder / "bin" / "python"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(folder)], check=True)
    subprocess.run(
        [sys.executable, "-m", "pip", "--python", str(made), "--disable-pip-version-check",
         "install", "--quiet", "--no-deps", "--no-index", "--no-compile", str(wheel)],
        check=True,
    )  # fmt: skip
    (packages,) = (folder / "lib").glob("python*/site-packages")
    # A path in a .pth file is only appended: an editable install of Pons there is not followed.
    lent = Path(str(fastapi.__file__)).parents[1]
    (packages / "lent.pth").write_text(f"{lent}\n", "utf-8")
    return made


@pytest.fixture
def installed(python: Path) -> Iterator[InstalledSystem]:
    """Return a system in a new empty folder; nothing of it is left running."""
    with new_home() as folder:
        system = InstalledSystem(Path(folder), python)
        try:
            yield system
        finally:
            system.destroy()


def test_the_wheel_holds_the_product_and_nothing_of_the_workshop(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    tops = {name.split("/")[0] for name in names}
    assert tops >= PACKAGES
    assert not tops & WORKSHOP
    assert not [name for name in names if "/test_" in name or "__pycache__" in name]
    assets = {
        "page/index.html", "prompts/plan.md", "sites/home/map.pgm", "sites/two_room/map.yaml",
        "robot.toml", "requirements.lock", "pons_ros2/package.xml",
    }  # fmt: skip
    assert {f"pons_assets/{name}" for name in assets} <= set(names)
    assert [name for name in names if name.endswith(".onnx")]


def test_up_in_an_empty_folder_drives_by_a_sentence(installed: InstalledSystem) -> None:
    robot = Robot(installed.home, HOME_SITE)
    robot.system = installed
    try:
        robot.start()
        assert b"/assets/index-" in installed.http("GET", "/").body
        robot.rest()
        place = robot.elsewhere()
        done = installed.pons("say", f"go to the {place.name.en}", timeout_s=DRIVE_LIMIT_S)
        assert done.returncode == 0, (done.stdout, done.stderr, installed.logs())
        robot.assert_there(place)
        assert installed.pons("stop").returncode == 0
        robot.judge.assert_never_moves(0.5)
        assert {path.name for path in installed.folder.iterdir()} == {".pons"}
        refused = installed.pons("calibrate", "--yes")
        assert "shipped_robot_toml" in refused.stderr
    finally:
        robot.close()


def test_what_looks_at_machine_plans_and_pictures_works_without_a_checkout(
    installed: InstalledSystem,
) -> None:
    where = installed.run("-c", "import planner, pons_assets as a; print(a.ROOT, planner.__path__)")
    assert str(ROOT) not in where.stdout, where
    looked = installed.pons("doctor")
    assert "FAIL" not in looked.stdout, looked.stdout
    assert "home, 15 rooms" in looked.stdout
    scored = installed.pons("eval", "home_en", timeout_s=120)
    assert "home_en" in scored.stdout, (scored.stdout, scored.stderr)
    assert cv2.imwrite(str(installed.folder / "grey.png"), np.full((120, 160, 3), 128, np.uint8))
    seen = installed.pons("detect", "grey.png")
    assert "pons_home.onnx" in seen.stdout, (seen.stdout, seen.stderr)


def test_what_needs_a_checkout_says_so(installed: InstalledSystem) -> None:
    for module in (
        "wire.docs",
        "planner.openapi",
        "bridge.core.safety_page",
        "planner.mission.docs",
    ):
        asked = installed.run("-m", module, "--check")
        assert asked.returncode == 1
        assert asked.stderr.startswith("needs_checkout: "), asked.stderr
        assert not list(installed.folder.iterdir())


def test_the_fleet_serves_from_the_wheel(wheel: Path, installed: InstalledSystem) -> None:
    metadata = zipfile.ZipFile(wheel)
    (name,) = (each for each in metadata.namelist() if each.endswith(".dist-info/METADATA"))
    assert b"Provides-Extra: fleet" in metadata.read(name)
    port = free_port()
    environment = {**installed.environment, "PONS_FLEET_PORT": str(port)}
    environment.pop("PONS_FLEET_DB", None)
    service = subprocess.Popen(
        [str(installed.python), "-m", "pons", "fleet", "up"],
        cwd=installed.folder, env=environment, start_new_session=True,
    )  # fmt: skip
    try:
        until(lambda: is_answering(port), 60.0, "the fleet")
        listed = subprocess.run(
            [str(installed.python), "-m", "pons", "fleet", "say", "everybody go home"],
            cwd=installed.folder, env=environment, capture_output=True, text=True, check=False,
            timeout=60,
        )  # fmt: skip
        assert listed.returncode == 3, listed
        assert "no_robots" in listed.stderr
        assert (installed.home / "fleet" / "fleet.sqlite").is_file()
    finally:
        service.terminate()
        service.wait(30)
    assert service.returncode in (0, -signal.SIGTERM)


def is_answering(port: int) -> bool:
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0
