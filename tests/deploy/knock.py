"""Be one process of a deployed robot, or a hostile one, under a user of its own.

``hear PARTY HOME`` prints each thing that a hostile process said; ``knock USER HOME`` tries every
door in every way and prints as JSON what the kernel let it do. Run by ``tests.as_user``.
"""

from __future__ import annotations

import json
import os
import socket
import sys
import time
from contextlib import closing, suppress
from pathlib import Path
from typing import Any

import zenoh

from tests.wire.test_strangers import everything, stranger
from wire.doors import DOORS, Door
from wire.keys import KEYS, Party
from wire.session import open_session
from wire.sockets import Endpoints

MARK = b"spoofed "
SHOUTS, PAUSE_S = 40, 0.02


def main(arguments: list[str]) -> int:
    """Do one of both."""
    what, who, home = arguments
    if what == "hear":
        return hear(Party(who), Path(home))
    print(json.dumps(knock(who, Path(home))), flush=True)
    return 0


def hear(party: Party, home: Path) -> int:
    """Hear all keys at all doors until the input ends; print who said what, once each."""
    os.set_blocking(sys.stdin.fileno(), False)
    with open_session(party, "r1", home) as session:
        ears = everything(session._links)
        print("ready", flush=True)
        told: set[str] = set()
        while sys.stdin.buffer.read(1) is None:
            for text in spoofs(ears) - told:
                told.add(text)
                print(text, flush=True)
            time.sleep(0.01)
    return 0


def spoofs(ears: dict[str, list[Any]]) -> set[str]:
    found = set()
    for subscribers in ears.values():
        for subscriber in subscribers:
            while (sample := subscriber.try_recv()) is not None:
                payload = sample.payload.to_bytes()
                if payload.startswith(MARK):
                    path = str(sample.key_expr).removeprefix("pons/r1/")
                    found.add(f"{payload.removeprefix(MARK).decode()} {path}")
    return found


def knock(user: str, home: Path) -> dict[str, dict[str, Any]]:
    """Try every door: connect and say every key, then take its place."""
    return {
        door.name: {"in": enters(user, home, door), "took": takes(home, door)}
        for door in DOORS
        if not ours(home, door)  # it has that place as it is
    }


def ours(home: Path, door: Door) -> bool:
    with suppress(OSError):
        return Endpoints(home).socket(door).parent.stat().st_uid == os.geteuid()
    return False


def enters(user: str, home: Path, door: Door) -> bool:
    """Say every key at a door in both zenoh modes, if the kernel lets us connect."""
    with closing(socket.socket(socket.AF_UNIX)) as probe:
        try:
            probe.connect(str(Endpoints(home).socket(door)))
        except OSError:
            return False
    for mode in ("client", "peer"):
        with suppress(zenoh.ZError), stranger(mode, Endpoints(home).locator(door)) as session:
            for _ in range(SHOUTS):
                for key in KEYS:
                    session.put(key.expression("r1"), MARK + f"{user} {door.name}".encode())
                time.sleep(PAUSE_S)
    return True


def takes(home: Path, door: Door) -> list[str]:
    """Try to rename, remove, replace and forestall a door's socket and its folder."""
    path = Endpoints(home).socket(door)
    folder, done = path.parent, []
    for name, act in (
        ("renamed the socket", lambda: path.rename(path.with_name("gone"))),
        ("removed the socket", path.unlink),
        ("made a file beside it", (folder / "mine").touch),
        ("renamed the folder", lambda: folder.rename(folder.with_name("gone"))),
        ("made a folder beside it", (home / "run" / f"mine-{door.name}").mkdir),
        ("renamed run", lambda: (home / "run").rename(home / "gone")),
        ("took the lock", lambda: (folder / f"{door.listener.value}.lock").open("a").close()),
    ):
        with suppress(OSError):
            act()
            done.append(name)
    return done
