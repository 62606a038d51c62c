"""Own the owner's settings about a smart home's broker: where it is, and as who the robot comes.

Data only, read by the planner so that a wrong key is told when it starts; ``pons.mqtt`` uses it.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, StringConstraints

from planner.plan import Language

Word = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=200)]
TopicPrefix = Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9_.-]+(/[A-Za-z0-9_.-]+)*$")]


class MqttSettings(BaseModel):
    """Say which broker the robot joins; the table alone makes ``pons up`` start its process."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True
    )

    host: Word
    port: Annotated[int, Field(ge=1, le=65_535)] | None = None
    """None: 8883 with TLS, 1883 without."""
    tls: bool = True
    ca_file: Path | None = None
    """Of the authority that signed the broker's certificate; None: the system's authorities."""
    username: Word | None = None
    password_file: Path | None = None
    """Relative to the home folder, as are the other files; read by this user alone."""
    token_file: Path | None = None
    """Holds a person's token (``pons people add``); needed where the planner wants tokens."""
    prefix: TopicPrefix = "pons"
    """Of the robot's own topics: ``pons/ROBOT/state`` and so on."""
    discovery_prefix: TopicPrefix = "homeassistant"
    name: Word | None = None
    """What the home calls the robot; None: its id."""
    language: Language = Language.EN
    """Of the rooms' names and of what the sensors say."""
    picture_s: float = Field(default=10.0, ge=0.0, le=3600.0)
    """Between two pictures of the camera; 0: none leave the robot."""

    @property
    def port_to_dial(self) -> int:
        """Return the broker's port."""
        return self.port or (8883 if self.tls else 1883)
