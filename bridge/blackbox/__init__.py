"""Keep recordings on disk: the process that writes them as MCAP, and the walk through such a file.

Nothing in here imports the bridge's core, pydantic or the loop: the writing process stays small. It
is started by bridge.recorder and spoken to in ``frames``; what a recording means is told there.
"""
