"""Read how the robot moved during a mission from the black box: way, speeds, rows and stops.

Asks no process. Files of any stage are read; what was thinned out is missing, and said so. The
planner, which knows nothing of recordings, runs it as ``HOME SINCE_UNIX_S UNTIL_UNIX_S`` and reads
the JSON that it prints.
"""

from __future__ import annotations

import json
import sys
from itertools import pairwise
from math import hypot
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from bridge.recording.mcap_reader import BadRecording, McapReader
from bridge.recording.rotation import SUFFIX

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bridge.recording.mcap_reader import Raw

_STATUS, _EVENT = "/pons/status", "/pons/event"
SAMPLE_S: Final = 0.2
"""Between two samples: a person scrubs through them."""
MOST_SAMPLES: Final = 2_000
GAP_S: Final = 2.0
"""A longer silence of the record is told as a gap."""


def read_track(folder: Path, since_unix_s: float, until_unix_s: float) -> dict[str, Any]:
    """Return samples, events and gaps between two times; what can't be read is left out.

    Times are since the beginning; a pose is in ``map``, None where the robot did not know it.
    """
    samples: list[dict[str, Any]] = []
    events: list[dict[str, Any]] = []
    gaps: list[list[float]] = []
    every_s = max(SAMPLE_S, (until_unix_s - since_unix_s) / MOST_SAMPLES)
    last_s = None
    for raw in _messages(folder, since_unix_s, until_unix_s):
        at_s = raw.at_ns / 1e9 - since_unix_s
        if raw.topic == _EVENT:
            event = json.loads(raw.data)
            events.append({"s": round(at_s, 2), "code": event["code"], "detail": event["detail"]})
        elif last_s is None or at_s - last_s >= every_s:
            if last_s is not None and at_s - last_s > GAP_S + every_s:
                gaps.append([round(last_s, 1), round(at_s, 1)])
            last_s = at_s
            samples.append(_sample(at_s, json.loads(raw.data)))
    return {"samples": samples, "events": events, "gaps": gaps, "way_m": round(_way(samples), 2)}


def _messages(folder: Path, since_unix_s: float, until_unix_s: float) -> Iterator[Raw]:
    """Yield the statuses and events of a time, file by file in the order of their names."""
    for path in sorted(folder.glob(f"*{SUFFIX}")):
        try:
            if path.stat().st_mtime < since_unix_s:
                continue
            with McapReader(path) as box:
                yield from _of_file(box, since_unix_s * 1e9, until_unix_s * 1e9)
        except (BadRecording, OSError):
            continue  # one that is damaged hides no other


def _of_file(box: McapReader, since_ns: float, until_ns: float) -> Iterator[Raw]:
    for chunk in box.chunks:
        begin_ns, end_ns = box.span_ns(chunk)
        if end_ns < since_ns or begin_ns > until_ns:
            continue
        yield from (
            raw
            for raw in box.read(chunk)
            if raw.topic in (_STATUS, _EVENT) and since_ns <= raw.at_ns <= until_ns
        )


def _sample(at_s: float, status: dict[str, Any]) -> dict[str, Any]:
    pose = status.get("base_in_map") or {}
    return {
        "s": round(at_s, 2),
        **{name: round(pose[name], 3) if pose else None for name in ("x_m", "y_m", "yaw_rad")},
        "asked_mps": round(status["asked"]["v_mps"], 3),
        "measured_mps": round(status["measured"]["v_mps"], 3),
        "mode": status["mode"],
        "rows": [row["row"] for row in status["rows"]],
    }


def _way(samples: list[dict[str, Any]]) -> float:
    known = [(one["x_m"], one["y_m"]) for one in samples if one["x_m"] is not None]
    return sum(hypot(there[0] - here[0], there[1] - here[1]) for here, there in pairwise(known))


def main(arguments: list[str]) -> int:
    """Print the track of a home's recordings between two times as JSON; 0."""
    home, since, until = arguments
    track = read_track(Path(home) / "recordings", float(since), float(until))
    print(json.dumps(track, ensure_ascii=False))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
