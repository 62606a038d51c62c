"""Own the owner's settings about tools: servers that speak MCP, which a brain with a model may ask.

Data only. What is not listed here is never called; a key never shows.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, SecretStr, StringConstraints

from planner.outbound import Address
from wire import ConfigError

Url = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=2000)]
Names = Annotated[
    tuple[Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9_./-]{1,64}$")], ...],
    Field(max_length=64),
]


class ToolServerSettings(BaseModel):
    """Name one server, what of it may be asked, and how often."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True
    )

    url: Url
    """Where it speaks MCP by Streamable HTTP, whole: ``http://127.0.0.1:8500/mcp``."""
    key: SecretStr | None = None
    """Sent to the host of ``url`` and nowhere else, as a bearer's token."""
    allow: Names | None = None
    """The tools that only read, in the owner's judgement; None: those that the server marks so."""
    may_write: Names = ()
    """The tools that may change something: a person says yes to each call."""
    timeout_s: float = Field(default=10.0, ge=0.5, le=60.0)
    """For one call, from the connection to the last byte."""
    max_bytes: int = Field(default=200_000, ge=1_000, le=1_000_000)
    """Of one answer; a longer one is none."""
    goal_calls: int = Field(default=4, ge=0, le=50)
    """Calls that one goal may make."""
    day_calls: int = Field(default=200, ge=0, le=100_000)
    """Calls of one day (UTC), all goals together."""
    allow_offhost: bool = False
    """Let what people say leave this machine, in arguments: for every host but loopback."""

    @property
    def address(self) -> Address:
        """Return where it is asked. Raises ConfigError: ``tools_url``."""
        return Address.parse(self.url, "", "tools")


def judge_servers(servers: Mapping[str, ToolServerSettings]) -> None:
    """Judge the owner's servers together.

    Raises:
        ConfigError: ``tools_url``, ``tools_offhost``, ``tools_twice``.
    """
    known: dict[str, str] = {}
    for name, server in servers.items():
        address = server.address
        if not address.local and not server.allow_offhost:
            raise ConfigError(
                "tools_offhost",
                f"what people say would be sent to {address.host}; if that is meant, set "
                f"allow_offhost = true in [tools.{name}]",
            )
        if (first := known.setdefault(address.url, name)) != name:
            raise ConfigError("tools_twice", f"[tools.{first}] and [tools.{name}] are one server")
        if both := set(server.allow or ()) & set(server.may_write):
            told = ", ".join(sorted(both))
            raise ConfigError("tools_twice", f"[tools.{name}] lists under both: {told}")


def server_tables(tables: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Return the tables below [tools] of a settings.toml, by the owner's names."""
    tools = tables.get("tools")
    found = tools.items() if isinstance(tools, dict) else ()
    return {name: server for name, server in found if isinstance(server, dict)}
