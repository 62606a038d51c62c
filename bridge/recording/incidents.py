"""Find the incidents of a recording: the stops and faults for whose sake a black box is kept.

Reads the events alone; chunks without any are not unpacked.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bridge.recording.mcap_reader import McapReader, Raw

EVENT = "/pons/event"
_READY = {"ACTIVE", "TELEOP", "HOLD"}
_STOPPED = {"STOPPING", "ESTOPPED", "FAULT", "DISARMED"}
_UNPROVEN = ["SELFTEST", "FAULT"]


def is_incident(data: bytes) -> bool:
    """Return whether an event tells of a stop or a fault: a mode that drives was left for none."""
    event = json.loads(data)
    if event["code"] != "mode":
        return False
    words = str(event["detail"]).split(" ", 2)
    if words[:2] == _UNPROVEN:
        return True  # it never was ready, and a person wants to know why
    return words[0] in _READY and words[1:2] != [] and words[1] in _STOPPED


def incidents_of(box: McapReader) -> Iterator[Raw]:
    """Yield the events of a recording that are incidents, in order."""
    for chunk in box.chunks:
        if chunk.topics and EVENT not in chunk.topics:
            continue  # one without any index may be the last of a file cut short
        yield from (raw for raw in box.read(chunk) if raw.topic == EVENT and is_incident(raw.data))
