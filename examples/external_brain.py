"""Drive a robot through the bridge with zenoh and JSON alone: none of this project is imported.

``python examples/external_brain.py --home .pons --v 0.2 --w 0.4 --seconds 10`` runs beside a bridge
that no planner owns (``pons up --no-planner``). docs/external-velocity.md explains each part.
"""

from __future__ import annotations

import argparse
import json
import time
import uuid
from pathlib import Path
from typing import Any

import zenoh

ME, MISSION = f"example-{uuid.uuid4().hex[:8]}", f"drive-{uuid.uuid4().hex[:8]}"
PERIOD_S = 0.05  # 20 Hz: over 28 a second is a flood, what is older than 0.25 s is not obeyed


class Bridge:
    """Hold the link to one bridge: what it said last, and a way to say something."""

    def __init__(self, home: Path, robot: str) -> None:
        config = zenoh.Config()  # as it comes it would listen on all interfaces and multicast
        socket = f"unixsock-stream/{home.absolute()}/run/bridge/bridge.sock"
        config.insert_json5("listen/endpoints", "[]")
        config.insert_json5("connect/endpoints", json.dumps([socket]))
        config.insert_json5("scouting/multicast/enabled", "false")
        config.insert_json5("scouting/gossip/enabled", "false")
        self.session, self.keys = zenoh.open(config), f"pons/{robot}/"
        newest: Any = zenoh.handlers.RingChannel(1)  # the default blocks when nobody drains it
        self.ears: Any = self.session.declare_subscriber(self.keys + "bridge/status", newest)

    def news(self) -> dict[str, Any] | None:
        """Return the status that came since the last call, if one did."""
        sample = self.ears.try_recv()
        return json.loads(sample.payload.to_bytes()) if sample is not None else None

    def say(self, key: str, message: dict[str, Any]) -> None:
        """Send and forget: DROP, for a command that waits in a queue is an old one."""
        drop = zenoh.CongestionControl.DROP
        text = json.dumps(message)
        self.session.put(self.keys + key, text, express=True, congestion_control=drop)


def answer(bridge: Bridge, status: dict[str, Any]) -> bool:
    """Say on each status what keeps the robot ours; tell whether it may be driven."""
    if (status["owner"] or {}).get("planner_id") != ME:  # a brain with its own map compares first
        echoed = ("protocol", "robot_hash", "fence_hash", "map_id")
        believed = {name: status[name] for name in echoed}
        who = {"planner_id": ME, "kind": "external", "seen": status["seq"]}
        bridge.say("cmd/hello", {**who, **believed})
        return False
    now = {"planner_id": ME, "epoch": status["epoch"], "seen": status["seq"]}
    bridge.say("cmd/heartbeat", {**now, "used": status["seq"]})
    if status["grant"] is None and status["held"] is None and status["mode"] == "HOLD":
        bridge.say("cmd/grant", {**now, "mission": MISSION, "metres": 10.0, "seconds": 60.0})
    return status["grant"] is not None


def main() -> None:
    """Own, be granted, send a velocity on a clock of our own, let go."""
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("--home", type=Path, default=Path(".pons"))
    words.add_argument("--robot", default="r1")
    for name, default in (("--v", 0.2), ("--w", 0.0), ("--seconds", 10.0)):
        words.add_argument(name, type=float, default=default)
    said = words.parse_args()
    bridge, status, may_drive, seq, next_s, was = (
        Bridge(said.home, said.robot),
        {},
        False,
        0,
        0.0,
        "",
    )
    end_s = float("inf")  # begins to run with the first velocity
    while (now_s := time.monotonic()) < end_s + 0.5:
        if (news := bridge.news()) is not None:
            status, may_drive = news, answer(bridge, news)
            if (line := f"{status['mode']}, held {status['held']}") != was:
                print(was := line, flush=True)
        if may_drive and now_s >= next_s:
            next_s, seq, end_s = now_s + PERIOD_S, seq + 1, min(end_s, now_s + said.seconds)
            moment = {"epoch": status["epoch"], "seq": seq, "seen": status["seq"]}
            order = {"v_mps": said.v, "w_radps": said.w, "dead_man": now_s < end_s}
            bridge.say("cmd/external", {"source_id": ME, **moment, **order})
        time.sleep(0.002)


if __name__ == "__main__":
    main()
