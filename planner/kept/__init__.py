"""Keep a child process: spawn it, hand it requests, bury it. One door, for both ends of its pipes.

The route search and the eyes each have such a process and say here only what it is, and what its
failures are called. The recogniser is started by whoever speaks and given up at the first oddity,
so it takes the pipes and the child's end from here, and no :class:`KeptProcess`.
"""

from planner.kept.bound import bind_to_parent
from planner.kept.child import Parent, run
from planner.kept.failure import Codes, Failure
from planner.kept.frames import Frame, pack
from planner.kept.life import STREAM_ERRORS, command_of, exchange, reap, spawn
from planner.kept.process import KeptProcess

__all__ = [
    "STREAM_ERRORS",
    "Codes",
    "Failure",
    "Frame",
    "KeptProcess",
    "Parent",
    "bind_to_parent",
    "command_of",
    "exchange",
    "pack",
    "reap",
    "run",
    "spawn",
]
