"""Print openapi.json, the API's contract: ``python -m planner.openapi [--check]``."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, cast

from planner.api import Access, build
from planner.site import Site
from pons_assets import ROOT, SITES, checkout

if TYPE_CHECKING:
    from planner.api import Services

TARGET = ROOT / "openapi.json"


class _EmptyServices:
    """Stand where services would: the contract is read, no route is called."""

    goals = None
    rehearser = rehearsal_drives = None
    robot = None
    ears = None
    fences = None
    eyes = None
    orders = None
    people = None

    def __init__(self) -> None:
        self.site = Site.load(SITES / "two_room")


def render() -> str:
    """Return the contract as text."""
    app = build(cast("Services", _EmptyServices()), Access("127.0.0.1"))
    return json.dumps(app.openapi(), ensure_ascii=False, indent=1, sort_keys=True) + "\n"


def main(arguments: list[str]) -> int:
    """Write the contract, or with ``--check`` say whether the committed one is fresh."""
    checkout("writing openapi.json")
    text = render()
    if "--check" in arguments:
        fresh = TARGET.is_file() and TARGET.read_text("utf-8") == text
        if not fresh:
            sys.stderr.write("openapi.json is stale: run `make docs`\n")
        return 0 if fresh else 1
    TARGET.write_text(text, "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
