"""Run the real bridge process and note when stops arrive: ``python -m tools.bench.stop_probe …``.

Takes the bridge's own arguments; writes ``stops.json`` into the home folder at its end.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any
from unittest.mock import patch

import bridge.__main__ as bridge_main
from wire.keys import STOP
from wire.session import open_session

if TYPE_CHECKING:
    from wire.keys import Party
    from wire.session import Session

ARRIVALS_S: list[float] = []
EARS: list[Any] = []
"""Kept here: a subscriber is undeclared with its last reference."""


def note_arrival(_: Any) -> None:
    """Note a stop's arrival, from the transport's own thread."""
    ARRIVALS_S.append(time.monotonic())


def listening_session(party: Party, robot_id: str, home: Path) -> Session:
    """Open the bridge's session and listen to its stops a second time, with a callback."""
    session = open_session(party, robot_id, home)
    links = session.links_inward(STOP)  # the loop's own ring can't be stamped at arrival
    EARS.extend(link.declare_subscriber(STOP.expression(robot_id), note_arrival) for link in links)
    return session


def main(arguments: list[str]) -> int:
    """Be the bridge; write on the way out."""
    home = Path(arguments[arguments.index("--home") + 1])
    with patch.object(bridge_main, "open_session", listening_session):
        try:
            return bridge_main.main(arguments)
        finally:
            (home / "stops.json").write_text(json.dumps(ARRIVALS_S), "utf-8")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
