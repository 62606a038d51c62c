"""Serve MCP for one robot: ``pons mcp``, a client of the HTTP API in a process of its own.

Knows HTTP and the SDK, and nothing of the planner; the only package that imports ``mcp``
(docs/adr/0086).
"""
