"""List and call the tools of the owner's MCP servers: bounded, counted, tainted (ADR 0094)."""

from planner.tool_servers.desk import ToolDesk

__all__ = ["ToolDesk"]
