"""Write commands to our relay node and read its state (examples/ros2_relay). Pure.

Both are JSON in a std_msgs/String, which each ROS has and ``ros2 topic echo`` shows. A command ends
at the relay's own clock: ``seen`` is the time in the newest state that its sender had, and what is
older than ``ttl`` moves nothing, however it was delayed on its way.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import ValidationError

from ros2 import robot_words
from ros2.robot_words import RelayCommand, RelayState, Unreadable

if TYPE_CHECKING:
    from ros2.operations import Message

__all__ = ["STRING", "RelayCommand", "RelayState", "decode_state", "encode_command"]

STRING = "std_msgs/msg/String"


def encode_command(command: RelayCommand, key: bytes = b"") -> Message:
    """Return the message of a command."""
    return {"data": robot_words.encode_command(command, key).decode()}


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
