"""Break the brain's process or its link: kill, freeze, cut, keep back, flood."""

from __future__ import annotations

import signal
import time
from typing import TYPE_CHECKING, Any

from pons.conformance.driver import mute, pack
from pons.conformance.fault import PATH_S, SILENT, VELOCITY_S, Fault, W, X
from pons.conformance.proxy import Proxy, ProxyWay
from pons.conformance.worker_processes import FLOODER

if TYPE_CHECKING:
    from collections.abc import Callable

    from pons.conformance.fault_context import FaultContext

FLOOD_HZ, JUNK_HZ = 10_000, 1_000
FLOODED_S = 0.1
"""A flood fills its window a moment after it began, and its first messages may be the good ones."""
AFTER_FLOOD_S = 0.2
WINDOWS_S = 1.0
"""Four windows of a flood hold even where the command's own key is quiet."""
STOP_AGAIN_S = 0.25
"""A stop is said 20 times a second until it is echoed: a flood pushes some out."""
PULSE_S = 0.05
KEPT_S = 1.0
AFTER_S = 0.6


def _kill(stage: FaultContext) -> None:
    puppet = stage.hand_over()
    stage.begin()
    puppet.process.send_signal(signal.SIGKILL)
    stage.until_standing()


def _frozen(stage: FaultContext) -> None:
    puppet = stage.hand_over()
    stage.begin()
    puppet.process.send_signal(signal.SIGSTOP)
    try:
        stage.until_standing()
        stage.end()
    finally:
        puppet.process.send_signal(signal.SIGCONT)


def _half_open(stage: FaultContext) -> None:
    proxy = Proxy(stage.adapter.door())
    stage.stack.callback(proxy.close)
    stage.hand_over(proxy.address)
    stage.begin()
    proxy.way = ProxyWay.STALLED
    stage.until_standing()


def _buffer(stage: FaultContext) -> None:
    """Keep a second of commands back, and deliver them when who sent them is gone."""
    proxy = Proxy(stage.adapter.door())
    stage.stack.callback(proxy.close)
    puppet = stage.hand_over(proxy.address)
    stage.begin()
    proxy.way = ProxyWay.KEPT
    began_s = time.monotonic()
    stage.until_standing()
    stage.wait(max(0.0, KEPT_S - (time.monotonic() - began_s)))
    puppet.process.send_signal(signal.SIGKILL)
    puppet.process.wait()
    proxy.way = ProxyWay.OPEN
    stage.wait(AFTER_S)


def _flood(task: Callable[[FaultContext], dict[str, Any]]) -> Callable[[FaultContext], None]:
    def play(stage: FaultContext) -> None:
        flooder = stage.borrow()
        stage.until(stage.drives_fast, "driving before the flood")
        stage.begin()
        flooder.go({"be": FLOODER, **task(stage)})
        stage.until_standing()
        stage.wait(AFTER_FLOOD_S)

    return play


def _stop_in_flood(stage: FaultContext) -> None:
    """Say stop, as one does until it is echoed, on a key that is full of junk."""
    flooder = stage.borrow()
    flooder.go({"be": FLOODER, "key": "cmd/stop", "text": '{"id": [[[', "hertz": FLOOD_HZ})
    stage.until(stage.drives_fast, "driving in the flood")
    stop = pack({"id": f"kit-{stage.chance.getrandbits(48):x}", "source": "kit"})
    stage.begin()
    end_s = time.monotonic() + 2.0
    while time.monotonic() < end_s and stage.status.held is None:
        stage.adapter.say("cmd/stop", stop)
        stage.wait(PULSE_S)
    stage.until_standing()


def _valid(stage: FaultContext) -> dict[str, Any]:
    """Return a flood of messages that each look like the owner's newest command."""
    brain, status = stage.brain, stage.status
    _, message = (
        brain.velocity(status, 0, 0.5, 0.0) if stage.external else brain.waypoints(status, 0, [])
    )
    return {"key": stage.command_key, "template": message, "hertz": FLOOD_HZ}


def _heartbeats(stage: FaultContext) -> dict[str, Any]:
    key, message = stage.brain.heartbeat(stage.status)
    return {"key": key, "template": message, "hertz": FLOOD_HZ, "numbered": "used"}


def _malformed_task(stage: FaultContext) -> dict[str, Any]:
    return {"key": stage.command_key, "text": '{"v_mps": NaN, "points": 7}', "hertz": JUNK_HZ}


def _silent(stage: FaultContext) -> None:
    stage.begin(mute)
    stage.until_standing()


_FLOOD = {X: VELOCITY_S + FLOODED_S, W: PATH_S + FLOODED_S}

FAULTS = (
    Fault("silent", "the brain says no more", _silent, SILENT, quick=(W,)),
    Fault("killed", "SIGKILL of the brain's process", _kill, SILENT, quick=(X,)),
    Fault("frozen", "SIGSTOP of the brain's process", _frozen, SILENT),
    Fault("half_open", "the link accepts and is never read", _half_open, SILENT, quick=(W,)),
    Fault("buffered", "1 s of commands kept back, then delivered at once", _buffer, SILENT),
    Fault("flood", f"{FLOOD_HZ} valid-looking commands a second", _flood(_valid), _FLOOD,
          quick=(X,)),
    Fault("heartbeat_flood", f"{FLOOD_HZ} heartbeats a second in the owner's name",
          _flood(_heartbeats), {X: WINDOWS_S + FLOODED_S, W: WINDOWS_S + FLOODED_S}),
    Fault("stop_in_flood", f"a stop among {FLOOD_HZ} pieces of junk a second on its own key",
          _stop_in_flood, {X: STOP_AGAIN_S, W: STOP_AGAIN_S}),
    Fault("junk_flood", f"{JUNK_HZ} malformed messages a second", _flood(_malformed_task), _FLOOD),
)  # fmt: skip
