"""Write the extra ``locked`` of pyproject.toml from requirements.lock, or check that it is fresh.

``pip install 'pons_robot-….whl[locked]'`` then takes exactly the versions that were tested; without
the extra pip chooses within the ranges of ``dependencies`` (docs/adr/0035). Run by ``make lock``.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BEGIN, END = "# locked: begin, by scripts/locked_extra.py\n", "# locked: end\n"
_PIN = re.compile(r"^([a-z0-9._-]+==\S+?)(?: ; (.*?))? \\$", re.MULTILINE)
_BUILD_ONLY = "setuptools=="
"""In the lock for ``pip install -e .`` alone."""


def pins(lock: str) -> list[str]:
    """Return the requirements that a lock file pins, hashes left out."""
    return [
        f"{pin}; {marker}" if marker else pin
        for pin, marker in _PIN.findall(lock)
        if not pin.startswith(_BUILD_ONLY)
    ]


def render(project: str, lock: str) -> str:
    """Return pyproject.toml with the extra made anew."""
    before, rest = project.split(BEGIN)
    after = rest.split(END)[1]
    lines = "".join(f'  "{pin}",\n' for pin in pins(lock))
    return f"{before}{BEGIN}locked = [\n{lines}]\n{END}{after}"


def main(arguments: list[str]) -> int:
    """Write the extra, or with ``--check`` say whether the committed one is fresh."""
    path = ROOT / "pyproject.toml"
    project = path.read_text("utf-8")
    made = render(project, (ROOT / "requirements.lock").read_text("utf-8"))
    if "--check" not in arguments:
        path.write_text(made, "utf-8")
        return 0
    if made != project:
        print("the extra `locked` of pyproject.toml is stale: run `make docs`", file=sys.stderr)
    return int(made != project)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
