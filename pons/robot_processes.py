"""Run the processes of one robot in a home of their own, and end them all.

For kits and measurements, which put a module of theirs in the place of one process, or start only
some; ``pons up`` is what a person runs. Owns processes, their command lines and logs; opens no
session, judges nothing and starts none of them again.
"""

from __future__ import annotations

import socket
import time
from contextlib import ExitStack
from types import MappingProxyType
from typing import TYPE_CHECKING, Self

from pons.supervisor import Child
from processes.standby import find_server

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from types import TracebackType

    from pons.settings import LaunchSettings

PATIENCE_S = 4.0
"""A process that has not ended by itself so long after SIGTERM is killed."""
BODY = ("sim", "localization", "bridge")
"""A simulated robot without its brain, in the order of its start."""
NOTHING: Mapping[str, Sequence[str]] = MappingProxyType({})


class ProcessGone(Exception):
    """A process that is needed does not run; the message holds the end of its log."""


class RobotProcesses:
    """Hold one robot's processes; each dies with this process, and with the context."""

    def __init__(
        self,
        settings: LaunchSettings,
        names: Sequence[str],
        *,
        modules: Mapping[str, str] = MappingProxyType({}),
        arguments: Mapping[str, Sequence[str]] = NOTHING,
        before: Mapping[str, Sequence[str]] = NOTHING,
    ) -> None:
        """Describe them; entering the context starts them, and the caller may change one before.

        Args:
            settings: home, robot, site and the planner's address.
            names: the processes, in the order of their start; each is a module's name too.
            modules: run in the place of the process of that name.
            arguments: more of each, after those that all have.
            before: of each process that is to be another user's, the words that make it so.
        """
        self._logs = settings.home / "logs"
        common = common_arguments(settings)
        address = {"planner": address_arguments(settings)}
        self.children = {
            name: Child(
                name,
                [
                    *before.get(name, ()),
                    modules.get(name, name),
                    *common,
                    *address.get(name, ()),
                    *arguments.get(name, ()),
                ],
                self._logs / f"{name}.log",
                knows_tokens=name == "planner",
            )
            for name in names
        }
        self._stack = ExitStack()

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            self._logs.mkdir(parents=True, exist_ok=True)
            for child in self.children.values():
                child.start(time.monotonic())
                stack.callback(child.stop, PATIENCE_S)
            self._stack = stack.pop_all()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stack.close()

    def pid(self, name: str) -> int:
        """Return the id of the process that serves.

        Raises:
            ProcessGone: it does not run.
        """
        child = self.children[name]
        if child.process is None or child.process.poll() is not None:
            raise ProcessGone(f"{name} does not run; its log ends:\n{child.last_words()}")
        return find_server(child.process.pid)

    def find_ended(self) -> Child | None:
        """Return a process that was started and runs no more, if there is one."""
        for child in self.children.values():
            if child.process is not None and child.process.poll() is not None:
                return child
        return None

    def logs(self, lines: int = 3) -> str:
        """Return the ends of all logs."""
        return "\n".join(f"{c.name}: {c.last_words(lines)}" for c in self.children.values())


def common_arguments(settings: LaunchSettings) -> list[str]:
    """Return the command line that every process of a robot takes."""
    words = ["--home", str(settings.home), "--robot", str(settings.robot)]
    return [*words, "--site", str(settings.site)]


def address_arguments(settings: LaunchSettings) -> list[str]:
    """Return where the planner listens, as its command line says it."""
    return ["--host", settings.host, "--port", str(settings.port)]


def free_port() -> int:
    """Return a TCP port of the loopback that nothing listens on now."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])
