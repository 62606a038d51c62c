"""Act as our relay node (examples/ros2_relay) inside the simulator: a second implementation."""

from __future__ import annotations

import hmac
import json
import secrets
from dataclasses import dataclass
from math import isfinite
from typing import Any

TTL_S = (0.05, 0.5)
FASTEST_MPS, FASTEST_RADPS = 10.0, 20.0


@dataclass(frozen=True, slots=True)
class RelayOrder:
    """Hold a command that may move the base until a time on the relay's clock."""

    boot: str
    seq: int
    until_s: float
    v_mps: float
    w_radps: float
    on: bool


class RelayFirmware:
    """Obey one Pons, say which command, and stop by itself."""

    def __init__(self, cmd_vel: str, boot: str | None = None, key: bytes = b"") -> None:
        self._key = key
        self.boot = boot or f"twin-{secrets.token_hex(4)}"
        self._cmd_vel = cmd_vel
        self.order: RelayOrder | None = None
        """The newest that was taken; it may have ended."""
        self._seq = 0

    def hear(self, text: object, now_s: float) -> bool:
        """Take a command; False where it counts for nothing."""
        order = self._order_of(text, now_s)
        if order is None:
            return False
        last = self.order
        if last is not None and order.boot == last.boot and order.seq <= last.seq:
            return False
        self.order = order
        return True

    def twist(self, now_s: float) -> tuple[float, float, bool]:
        """Return forward [m/s], turning [rad/s], and whether a command holds."""
        order = self.order
        if order is None or not now_s < order.until_s:
            return 0.0, 0.0, False
        return (order.v_mps, order.w_radps, True) if order.on else (0.0, 0.0, True)

    def state(self, now_s: float, ros_s: float) -> str:
        """Return the state that is due."""
        self._seq += 1
        order = self.order
        return json.dumps(
            {
                "relay": self.boot,
                "seq": self._seq,
                "t": now_s,
                "ros": ros_s,
                "echo_boot": order.boot if order else None,
                "echo_seq": order.seq if order else 0,
                "timed_out": not self.twist(now_s)[2],
                "on": bool(order and order.on),
                "cmd_vel": self._cmd_vel,
                "others": 0,
                "keyed": bool(self._key),
            }
        )

    def has_torque(self, now_s: float) -> bool:
        """Return whether the command that holds asks for torque."""
        return self.twist(now_s)[2] and self.order is not None and self.order.on

    def _order_of(self, text: object, now_s: float) -> RelayOrder | None:
        said = str(text)
        if self._key:
            said, _, mac = said.rpartition(" ")
            right = hmac.new(self._key, said.encode("utf-8", "replace"), "sha256").hexdigest()
            if mac != right:
                return None
        try:
            raw: dict[str, Any] = json.loads(said)
            seen_s, ttl_s = float(raw["seen"]), float(raw["ttl"])
            order = RelayOrder(
                boot=raw["boot"],
                seq=raw["seq"],
                until_s=seen_s + ttl_s,
                v_mps=float(raw["v"]),
                w_radps=float(raw["w"]),
                on=raw["on"] is True,
            )
        except (ValueError, KeyError, TypeError, OverflowError, RecursionError):
            return None
        within = (
            raw.get("relay") == self.boot
            and isinstance(raw["boot"], str)
            and isinstance(raw["seq"], int)
            and 0 <= raw["seq"] < 1 << 53
            and TTL_S[0] <= ttl_s <= TTL_S[1]
            and 0.0 <= now_s - seen_s < ttl_s
            and isfinite(order.v_mps)
            and abs(order.v_mps) < FASTEST_MPS
            and abs(order.w_radps) < FASTEST_RADPS
        )
        return order if within else None
