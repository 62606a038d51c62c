"""Check or write every generated file.

Owns the list of generators; each generator owns its text.
"""

from __future__ import annotations

import argparse
import importlib.util
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


@dataclass(frozen=True, slots=True)
class Generator:
    """Name a module that prints a file from code, and the file.

    Every generator takes no argument to write its file and `--check` to exit 1 when it is stale.
    """

    module: str
    makes: str


GENERATORS = (
    Generator("wire.docs", "docs/wire.md"),
    Generator("bridge.core.safety_page", "docs/safety.md"),
    Generator("planner.mission.docs", "docs/missions.md"),
    Generator("sim.site", "sites/"),
    Generator("planner.openapi", "openapi.json"),
    Generator("scripts.page_words", "web/src/i18n/"),
    Generator("scripts.locked_extra", "pyproject.toml, extra locked"),
    Generator("scripts.model_prices", "planner/settings/model_prices.json"),
    Generator("scripts.sbom", "sbom.cdx.json, docs/licences.md"),
    Generator("scripts.reference", "docs/http.md, robot-toml.md, settings-toml.md, codes.md, adr/"),
    Generator("scripts.assistant_pages", "AGENTS.md, llms.txt"),
)


def exists(module: str) -> bool:
    """Tell whether a module can be found, without running it."""
    try:
        return importlib.util.find_spec(module) is not None
    except ModuleNotFoundError:
        return False


def run(generator: Generator, *, check: bool) -> bool:
    """Run one generator and tell whether its file is now true."""
    if not exists(generator.module):
        print(f"{generator.makes}: missing generator {generator.module}", flush=True)
        return False
    command = [sys.executable, "-m", generator.module, *(["--check"] if check else [])]
    ok = subprocess.run(command, cwd=ROOT, check=False).returncode == 0
    verdict = "fresh" if ok else "STALE: run `make docs` and commit the result"
    print(f"{generator.makes}: {verdict if check else 'written' if ok else 'FAILED'}", flush=True)
    return ok


def main() -> int:
    """Run all generators and return 0 only if each file is true."""
    parser = argparse.ArgumentParser(description=__doc__)
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--check", action="store_true", help="exit 1 if a file is stale")
    what.add_argument("--write", action="store_true", help="write the files anew")
    options = parser.parse_args()
    results = [run(generator, check=options.check) for generator in GENERATORS]
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
