"""Put page, prompts, sites, robot.toml and the lock into the wheel; pyproject.toml says the rest.

A wheel can only hold packages, and these files lie beside ours because people edit them there. So a
build copies them into ``pons_assets``, the one module that knows where they are (docs/adr/0035).
"""

from __future__ import annotations

import contextlib
import shutil
import subprocess
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py

ROOT = Path(__file__).resolve().parent
ASSETS = {
    "robot.toml": "robot.toml",
    "requirements.lock": "requirements.lock",
    "prompts": "prompts",
    "robots": "robots",
    "sites": "sites",
    "ros2/pons_ros2": "pons_ros2",
    "web/dist": "page",
}
"""What a checkout has, and its name in the wheel."""


class BuildWithAssets(build_py):
    """Copy the assets beside the packages, and refuse to build without a page."""

    def run(self) -> None:
        super().run()
        if self.editable_mode:  # the checkout's own files serve
            return
        if not (ROOT / "web" / "dist" / "index.html").is_file():
            raise SystemExit("page_missing: web/dist has no index.html; `make page` builds it")
        package = Path(self.build_lib) / "pons_assets"
        for source, name in ASSETS.items():
            if (ROOT / source).is_dir():
                without = shutil.ignore_patterns("__pycache__")
                shutil.copytree(ROOT / source, package / name, ignore=without, dirs_exist_ok=True)
            else:
                shutil.copyfile(ROOT / source, package / name)
        asked = ["git", "-C", str(ROOT), "rev-parse", "--short=12", "HEAD"]
        with contextlib.suppress(OSError):
            told = subprocess.run(asked, capture_output=True, text=True, check=False)
            if told.returncode == 0:
                (package / "commit").write_text(told.stdout)


setup(cmdclass={"build_py": BuildWithAssets})
