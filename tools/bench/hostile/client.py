"""Attack every door: ``python -m tools.bench.hostile.client ROBOT_ID HOME``.

Dials every door that the kernel lets it reach, as zenoh comes, without our access control. Says
``ready DOOR…``, then reads runs from its standard input, one JSON object a line, attacks until the
next line comes, and answers with what it did. Ends with its input.
"""

from __future__ import annotations

import json
import select
import socket
import sys
import time
from contextlib import closing
from pathlib import Path
from random import Random
from typing import Any

import zenoh

from tools.bench.hostile.contents import Liar
from tools.bench.hostile.draw import Mood
from wire.codec import decode
from wire.doors import DOORS, Door
from wire.errors import DecodeFailure
from wire.keys import IMAGE, KEYS
from wire.sockets import Endpoints

LIMIT_S, LONGEST_S = 0.2, 60.0
EVERYTHING = 10
"""In each so many turns all is said that would let a robot move on, or its stop be hidden."""


class HostileClient:
    """Hold a session at each door that may be reached."""

    def __init__(self, robot_id: str, home: Path) -> None:
        """Dial."""
        self._robot_id = robot_id
        self.doors = [door for door in DOORS if may_enter(home, door)]
        self._sessions = [_dial(Endpoints(home).locator(door)) for door in self.doors]
        self._ears = [
            (key, _ear(session, key.expression(robot_id)))
            for session in self._sessions
            for key in KEYS
            if key.max_bytes < IMAGE
        ]  # fmt: skip

    def listen(self, liar: Liar) -> None:
        """Note the newest of every key."""
        for key, ear in self._ears:
            sample = ear.try_recv()
            if sample is not None:
                message = decode(key, sample.payload.to_bytes())
                if not isinstance(message, DecodeFailure):
                    liar.heard[key.path] = message

    def attack(self, run: dict[str, Any]) -> dict[str, Any]:
        """Say a run's worth; return how often and how much."""
        liar = Liar(Random(run["number"]))
        moods = tuple(Mood(mood) for mood in run["moods"])
        period_s, due_s = 1.0 / run["rate_hz"], time.monotonic()
        end_s = due_s + LONGEST_S
        turns = said = 0
        while time.monotonic() < end_s and not select.select([sys.stdin], [], [], 0.0)[0]:
            self.listen(liar)
            turns += 1
            these = EVERY if turns % EVERYTHING == 0 else moods
            for path, payload in liar.say(these):
                for session in self._sessions:
                    session.put(f"pons/{self._robot_id}/{path}", payload)
                    said += 1
            due_s = max(due_s + period_s, time.monotonic() - period_s)  # no burst after a pause
            time.sleep(max(0.0, due_s - time.monotonic()))
        return {"turns": turns, "said": said, "heard": len(liar.heard)}


EVERY = (Mood.PROOFS, Mood.SENSES, Mood.WHEELS, Mood.ANSWERS, Mood.SIMULATOR, Mood.BUTTON)


def may_enter(home: Path, door: Door) -> bool:
    """Tell whether the kernel lets this user connect to a door."""
    with closing(socket.socket(socket.AF_UNIX)) as probe:
        probe.settimeout(LIMIT_S)
        try:
            probe.connect(str(Endpoints(home).socket(door)))
        except OSError:
            return False
    return True


def _ear(session: Any, expression: str) -> Any:
    """Hear what others say, and not what this session says itself."""
    newest: Any = zenoh.handlers.RingChannel(1)
    return session.declare_subscriber(expression, newest, allowed_origin=zenoh.Locality.REMOTE)


def _dial(locator: str) -> Any:
    config = zenoh.Config()
    for path, value in {
        "mode": "client",
        "connect/endpoints": [locator],
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
    }.items():
        config.insert_json5(path, json.dumps(value))
    return zenoh.open(config)


def main(arguments: list[str]) -> int:
    """Attack as often as told."""
    client = HostileClient(arguments[0], Path(arguments[1]))
    print("ready", *(door.name for door in client.doors), flush=True)
    while text := sys.stdin.readline():
        print(json.dumps(client.attack(json.loads(text))), flush=True)
        sys.stdin.readline()  # the line that ended it
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
