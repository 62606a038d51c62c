"""Send far too much, for as long as standard input stays open.

Messages that are kept up to date (``seq``, ``seen``, ``epoch``), so that each looks valid, or bytes
that are none.
"""

from __future__ import annotations

import json
import sys
import threading
import time
from typing import TYPE_CHECKING, Any

from pons.conformance.raw_publisher import Mouth
from pons.conformance.reference_client import number
from wire.keys import STATUS

if TYPE_CHECKING:
    from wire import Status
    from wire.session import Session

PULSE_S = 0.001
MARK = 0.123456789
"""Stands for the number in a template: replacing text is ten times quicker than writing JSON."""


def halves(
    template: dict[str, Any], status: Status | None, numbered: str = "seq"
) -> tuple[bytes, bytes]:
    """Return a message's bytes before and after its number."""
    message = {**template, numbered: MARK}
    if status is not None:
        message |= {"seen": status.seq, "epoch": status.epoch}
    first, last = json.dumps(message).encode().split(str(MARK).encode())
    return first, last


def flood(session: Session, task: dict[str, Any]) -> None:
    """Flood ``key`` at ``hertz`` with messages made of ``template``, or with ``text``; count."""
    ears, mouth = session.subscriber(STATUS), Mouth(session)
    ended = threading.Event()
    threading.Thread(target=_await_end, args=(ended,), daemon=True).start()
    print("going", flush=True)
    count, began_s, template = 0, time.monotonic(), task.get("template")
    first, last = task.get("text", "").encode(), b""
    while not ended.wait(PULSE_S):
        status = ears.newest()
        if template is not None and (status is not None or not first):
            first, last = halves(template, status, task.get("numbered", "seq"))
        now_s = time.monotonic()
        seq = number(now_s)
        for index in range(int((now_s - began_s) * task["hertz"]) - count):
            whole = b"%s%d%s" % (first, seq + index, last) if template is not None else first
            mouth.say(task["key"], whole)
            count += 1
    print(json.dumps({"sent": count, "seconds": time.monotonic() - began_s}), flush=True)


def _await_end(ended: threading.Event) -> None:
    sys.stdin.read()
    ended.set()
