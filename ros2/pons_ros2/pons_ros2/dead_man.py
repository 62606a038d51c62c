"""Give cmd_vel the dead-man that it lacks. Told words and the time; knows no ROS and no socket.

A command moves the base until ``seen`` + ``ttl`` on this computer's clock, however late it came;
then the base gets zeros. ``seen`` is the time in the newest state that its sender had, so no sender
can look younger than what it heard.
"""

from __future__ import annotations

import hashlib
import hmac
import json
from pathlib import Path
from typing import Any

TTL_S = (0.05, 0.5)
FASTEST_MPS, FASTEST_RADPS = 10.0, 20.0
MIN_KEY_BYTES = 16
MOST_SEQ = 2**53


def sign(text: str, key: bytes) -> str:
    """Return words as they are sent: with a key, their HMAC-SHA-256 follows after a blank."""
    return f"{text} {hmac.new(key, text.encode(), hashlib.sha256).hexdigest()}" if key else text


def strip_signature(words: str, key: bytes) -> str | None:
    """Return words without their signature; None where a key is held and did not sign them."""
    if not key:
        return words
    text, _, mac = words.rpartition(" ")
    right = hmac.new(key, text.encode("utf-8", "replace"), hashlib.sha256).hexdigest()
    return text if hmac.compare_digest(right.encode(), mac.encode("utf-8", "replace")) else None


def key_of(path: str) -> bytes:
    """Return the key in a file; empty where none is named.

    Raises:
        ValueError: it is short.
        OSError: it can't be read.
    """
    key = Path(path).read_bytes().strip() if path else b""
    if path and len(key) < MIN_KEY_BYTES:
        raise ValueError(f"{path} holds {len(key)} bytes, expected at least {MIN_KEY_BYTES}")
    return key


class CmdVelDeadMan:
    """Decide what the base is told now."""

    def __init__(self, boot: str, key: bytes = b"") -> None:
        """Begin with nothing commanded; ``boot`` names this run."""
        self.boot, self.key = boot, key
        self.seq, self.until_s = 0, 0.0
        self.command: dict[str, Any] | None = None

    def hear(self, words: str, now_s: float) -> bool:
        """Take a command; False where it is unreadable, unsigned, old, long-lived or another's."""
        text = strip_signature(words, self.key)
        if text is None:
            return False
        try:
            raw = json.loads(text)
            boot, seq, seen_s, ttl_s = raw["boot"], raw["seq"], raw["seen"], raw["ttl"]
            raw["v"], raw["w"] = float(raw["v"]), float(raw["w"])
            fresh = raw["relay"] == self.boot and 0.0 <= now_s - seen_s < ttl_s
            slow = abs(raw["v"]) < FASTEST_MPS and abs(raw["w"]) < FASTEST_RADPS
            last = self.command
            newer = last is None or boot != last["boot"] or seq > last["seq"]
            named = isinstance(boot, str) and isinstance(seq, int) and 0 <= seq < MOST_SEQ
            if not (named and fresh and slow and newer and TTL_S[0] <= ttl_s <= TTL_S[1]):
                return False
        except (ValueError, KeyError, TypeError, OverflowError, RecursionError):
            return False
        self.command, self.until_s = raw, seen_s + ttl_s
        return True

    def twist(self, now_s: float) -> tuple[float, float, bool]:
        """Return forward [m/s], turning [rad/s], and whether the dead-man has fired."""
        if self.command is None or not now_s < self.until_s:
            return 0.0, 0.0, True
        on = self.command.get("on") is True
        return (self.command["v"], self.command["w"], False) if on else (0.0, 0.0, False)

    def state(self, now_s: float, ros_s: float, **more: object) -> str:
        """Return what Pons is told; ``more`` is what the graph says."""
        self.seq += 1
        obeyed = self.command or {"boot": None, "seq": 0, "on": False}
        return json.dumps(
            {
                "relay": self.boot, "seq": self.seq, "t": now_s, "ros": ros_s,
                "echo_boot": obeyed["boot"], "echo_seq": obeyed["seq"],
                "timed_out": self.twist(now_s)[2], "on": obeyed.get("on") is True,
                "keyed": bool(self.key), **more,
            }
        )  # fmt: skip
