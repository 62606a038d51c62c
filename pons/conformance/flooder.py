"""Send far too much: ``python -m pons.conformance.flooder HOME ROBOT`` in a process of its own.

One line of JSON on standard input: the key, the template of a message (its ``seq``, ``seen`` and
``epoch`` are kept up to date, so that each looks valid) or bytes that are none, and messages per
second. Ends with its standard input and then says how many it has sent.
"""

from __future__ import annotations

import json
import sys
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pons.conformance.brain import number
from pons.conformance.mouth import Mouth, dial, read_task
from wire.keys import STATUS, Party

if TYPE_CHECKING:
    from wire import Status

PULSE_S = 0.001
MARK = 0.123456789
"""Stands for the number in a template: replacing text is ten times quicker than writing JSON."""


def halves(template: dict[str, Any], status: Status | None) -> tuple[bytes, bytes]:
    """Return the message's bytes before and after its number."""
    message = {**template, "seq": MARK}
    if status is not None:
        message |= {"seen": status.seq, "epoch": status.epoch}
    first, last = json.dumps(message).encode().split(str(MARK).encode())
    return first, last


def _await_end(ended: threading.Event) -> None:
    sys.stdin.read()
    ended.set()


def main(arguments: list[str]) -> int:
    """Flood until standard input ends."""
    home, robot_id = Path(arguments[0]), arguments[1]
    with dial(Party.OPERATOR, robot_id, home, None) as session:
        ears, mouth = session.subscriber(STATUS), Mouth(session)
        print("ready", flush=True)
        task = read_task(sys.stdin.readline())
        if not task:
            return 0
        ended = threading.Event()
        threading.Thread(target=_await_end, args=(ended,), daemon=True).start()
        print("going", flush=True)
        count, began_s, template = 0, time.monotonic(), task.get("template")
        first, last = task.get("text", "").encode(), b""
        while not ended.wait(PULSE_S):
            status = ears.newest()
            if template is not None and (status is not None or not first):
                first, last = halves(template, status)
            now_s = time.monotonic()
            seq = number(now_s)
            for index in range(int((now_s - began_s) * task["hertz"]) - count):
                text = b"%s%d%s" % (first, seq + index, last) if template is not None else first
                mouth.say(task["key"], text)
                count += 1
        print(json.dumps({"sent": count, "seconds": time.monotonic() - began_s}), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
