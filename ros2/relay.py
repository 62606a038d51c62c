"""Write commands to our relay node and read its state (examples/ros2_relay). Pure.

Both are JSON in a std_msgs/String, which each ROS has and ``ros2 topic echo`` shows. A command ends
at the relay's own clock: ``seen`` is the time in the newest state that its sender had, and what is
older than ``ttl`` moves nothing, however it was delayed on its way.
"""

from __future__ import annotations

import hashlib
import hmac
import json
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pydantic import ConfigDict, ValidationError

from ros2.messages import Unreadable
from wire.base import Record
from wire.bounded_types import Count, Name, Seconds, Text

if TYPE_CHECKING:
    from ros2.operations import Message
    from wire import DriveCommand

STRING = "std_msgs/msg/String"


class RelayState(Record):
    """Say what the relay does: which command it obeys, and whether its dead-man has fired."""

    model_config = ConfigDict(extra="ignore", frozen=True)  # a newer relay may say more

    relay: Name
    """Which run of the relay this is."""
    seq: Count
    t: Seconds
    """On the relay's monotonic clock."""
    ros: float
    """The same instant on the robot's ROS clock."""
    echo_boot: Name | None
    echo_seq: Count
    timed_out: bool
    on: bool
    """Whether the obeyed command asked for torque."""
    cmd_vel: Text
    """The type that it publishes; empty while nobody listens there."""
    others: Count
    """Who else publishes there: any at all is one too many."""
    keyed: bool = False
    """It obeys only commands signed with the key that it shares with Pons."""


@dataclass(frozen=True, slots=True)
class RelayCommand:
    """Hold what one command carries."""

    command: DriveCommand
    relay: str
    seen_s: float
    ttl_s: float
    v_mps: float
    w_radps: float


def encode_command(command: RelayCommand, key: bytes = b"") -> Message:
    """Return the message of a command; with a key, its HMAC-SHA-256 follows after a blank.

    The words bind the relay's run, its clock and a number, so that none counts a second time.
    """
    on = command.command.enable
    words = {
        "boot": command.command.boot,
        "seq": command.command.seq,
        "relay": command.relay,
        "seen": command.seen_s,
        "ttl": command.ttl_s,
        "on": on,
        "v": command.v_mps if on else 0.0,
        "w": command.w_radps if on else 0.0,
    }
    text = json.dumps(words, separators=(",", ":"), allow_nan=False)
    if key:
        text += " " + hmac.new(key, text.encode(), hashlib.sha256).hexdigest()
    return {"data": text}


def decode_state(message: Message) -> RelayState:
    """Return the relay's state.

    Raises:
        Unreadable: it is none.
    """
    data = message.get("data")
    if not isinstance(data, str):
        raise Unreadable(f"data holds {repr(data)[:40]}, expected a string of JSON")
    try:
        return RelayState.model_validate_json(data, strict=True)
    except (ValidationError, RecursionError) as error:
        raise Unreadable(f"no state of our relay: {str(error).splitlines()[0][:120]}") from None
