"""Write or check the generated files of every site: ``python -m sim.site [--check] [FOLDER …]``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from sim.site import stale, write
from wire import ConfigError


def main(arguments: list[str] | None = None) -> int:
    """Return 0 when every site is as declared, 1 when stale under --check, 2 when refused."""
    parser = argparse.ArgumentParser(prog="python -m sim.site", description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing; fail when stale")
    parser.add_argument("folders", nargs="*", type=Path, help="sites (default: all of sites/)")
    options = parser.parse_args(arguments)
    folders = options.folders or sorted(p.parent for p in Path("sites").glob("*/home.yaml"))
    if not folders:
        print("no_sites: found no sites/*/home.yaml below the working directory", file=sys.stderr)
        return 2
    try:
        changed = {folder: (stale if options.check else write)(folder) for folder in folders}
    except ConfigError as error:
        print(error, file=sys.stderr)
        return 2
    for folder, names in changed.items():
        verdict = ("stale: " if options.check else "wrote ") + ", ".join(names)
        print(f"{folder}: {verdict if names else 'fresh'}")
    return 1 if options.check and any(changed.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
