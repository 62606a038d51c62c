"""Build the wheel of this checkout into a folder: ``python -m scripts.wheel [FOLDER]``.

Everything that a build leaves lies in a temporary folder: in ``build/`` of the checkout a module
that was since deleted would stay, and come along into the next wheel. Fetches nothing.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

ROOT = Path(__file__).resolve().parents[1]
_BUILD = "import sys; from setuptools.build_meta import build_wheel; build_wheel(sys.argv[1])"


def build_wheel(folder: Path) -> Path:
    """Build the wheel and return its path.

    Raises:
        SystemExit: ``page_missing``, or what the build itself says.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory(prefix="pons-wheel-") as place:
        made = Path(place, "made")
        made.mkdir()
        # setuptools reads this beside pyproject.toml; nothing else tells it where to build.
        settings = Path(place, "places.cfg")
        settings.write_text(
            f"[build]\nbuild_base = {place}/build\n[egg_info]\negg_base = {place}\n"
        )
        done = subprocess.run(
            [sys.executable, "-c", _BUILD, str(made)],
            cwd=ROOT,
            env={**os.environ, "DIST_EXTRA_CONFIG": str(settings)},
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode != 0:
            raise SystemExit(f"wheel_not_built:\n{done.stdout[-1000:]}{done.stderr[-3000:]}")
        (wheel,) = made.glob("*.whl")
        target = folder / wheel.name
        target.write_bytes(wheel.read_bytes())
        return target


if __name__ == "__main__":
    print(build_wheel(Path(sys.argv[1] if len(sys.argv) > 1 else "dist")))
