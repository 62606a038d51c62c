"""Be the planner process: ``python -m planner --home … --robot … --site … --host … --port …``."""

from __future__ import annotations

import argparse
import os
import signal
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import uvicorn

from planner import tls
from planner.api import Access
from planner.api.access import LOOPBACK_NAMES, is_loopback
from planner.api.connections import protocol
from planner.app import Planner, PlannerPaths, application
from planner.orders.zone import set_local_zone
from processes.log_lines import begin_log
from processes.priority import add_nice
from processes.standby import Standby
from wire import ConfigError

if TYPE_CHECKING:
    from types import FrameType

NICE = -10
"""Nine times the weight of others. The loop needs little, but soon: beside sixteen busy processes
it waited for a processor for 25 to 65 % of the time, and the bridge called it late (docs/adr/0026).
A real-time rank is not for a loop that may hang; a share keeps nobody else from running."""
REFUSED = ConfigError.exit_status
MIN_TOKEN_CHARACTERS = 16


def main(arguments: list[str] | None = None) -> int:
    """Serve until told to end; 1 home unwritable at present, 2 refused, 4 set-up, 5 for a map."""
    begin_log()
    given = _options(arguments)
    try:
        secure = tls.context(given.tls_cert, given.tls_key)
        authority = tls.authority(given.tls_ca)
        access = _access(given.host, speaks_tls=secure is not None)
        planner = Planner(
            PlannerPaths(
                given.home,
                given.robot,
                given.site,
                may_set_up=given.may_set_up,
                may_take_robot=given.may_take_robot,
                may_map=given.may_map,
            )
        )
    except ConfigError as wrong:  # a SiteError is one
        print(f"planner: {wrong}", file=sys.stderr)
        return wrong.exit_status
    access = replace(access, find_person=planner.people.find)
    set_local_zone(planner.settings.orders.timezone)
    server = uvicorn.Server(
        uvicorn.Config(
            application(planner, access, authority),
            host=given.host,
            port=given.port,
            loop="planner.tls:ServerLoop",
            ssl_context_factory=(lambda _config, _default: secure) if secure is not None else None,
            log_level="warning",
            access_log=False,
            server_header=False,
            http=protocol(),
            timeout_graceful_shutdown=2,
            ws_max_size=4_096,
            ws_per_message_deflate=False,  # squeezing small frames costs more than sending them
        )
    )
    tls.mark(given.home, "https" if secure is not None else "http", given.host, given.port)
    signal.signal(signal.SIGTERM, partial(_end, planner))
    server.run()
    if planner.detector.refused is not None:
        print(f"planner: {planner.detector.refused}", file=sys.stderr)
        return REFUSED
    if planner.thrown_switch is not None and planner.thrown_switch.exit_status is not None:
        return planner.thrown_switch.exit_status
    return 0 if server.started else 1


def _end(planner: Planner, number: int, _: FrameType | None) -> None:
    """Die of a signal as anybody does, but where the set-up is refused: that is told first.

    The server shuts down on a signal of its own, and then raises it again here.
    """
    thrown = planner.thrown_switch
    if planner.detector.refused is None and (thrown is None or thrown.exit_status is None):
        signal.signal(number, signal.SIG_DFL)
        signal.raise_signal(number)


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m planner", description=__doc__)
    parser.add_argument("--home", type=Path, required=True, help="$PONS_HOME")
    parser.add_argument("--robot", type=Path, required=True, help="robot.toml")
    parser.add_argument("--site", type=Path, required=True, help="folder of a site")
    parser.add_argument("--host", default="127.0.0.1")
    parser.add_argument("--port", type=int, default=8420)
    parser.add_argument("--tls-cert", type=Path, metavar="FILE", help="serve https with this (PEM)")
    parser.add_argument(
        "--tls-key", type=Path, metavar="FILE", help="its key; may be the same file"
    )
    parser.add_argument("--tls-ca", type=Path, metavar="FILE", help="given out as /ca.crt")
    parser.add_argument(
        "--may-set-up", action="store_true", help="end with 4 when an operator asks for set-up"
    )
    parser.add_argument(
        "--may-take-robot", action="store_true",
        help="end with 4 when the owner asks for the robot.toml that a page has written",
    )  # fmt: skip
    parser.add_argument(
        "--may-map", action="store_true",
        help="end with 5 when the owner asks to map this home, or for the map that was saved",
    )  # fmt: skip
    return parser.parse_args(arguments)


def _access(host: str, *, speaks_tls: bool) -> Access:
    """Read the access rules from the owner's environment.

    Raises:
        ConfigError: reachable from outside without a token, or with a short one.
    """
    # Taken out, so that no worker process inherits them.
    operator = os.environ.pop("PONS_OPERATOR_TOKEN", "")
    viewer = os.environ.pop("PONS_VIEWER_TOKEN", "")
    for name, token in (("PONS_OPERATOR_TOKEN", operator), ("PONS_VIEWER_TOKEN", viewer)):
        given = len("".join(token.split()))
        if token and (token != token.strip() or given < MIN_TOKEN_CHARACTERS):
            detail = (
                f"{name} has {given} characters that are no blanks, expected at least "
                f"{MIN_TOKEN_CHARACTERS} and no blank at either end"
            )
            raise ConfigError("token_too_short", detail)
    if not is_loopback(host) and not operator:
        detail = f"{host} can be reached from outside; set PONS_OPERATOR_TOKEN, or bind 127.0.0.1"
        raise ConfigError("token_needed", detail)
    named = {host} if host not in ("0.0.0.0", "::") else set()
    return Access(
        bind_host=host,
        hosts=frozenset(LOOPBACK_NAMES | named | _read_names("PONS_ALLOWED_HOSTS")),
        origins=frozenset(_read_names("PONS_ALLOWED_ORIGINS")),
        operator_token=operator,
        viewer_token=viewer,
        speaks_tls=speaks_tls,
    )


def _read_names(name: str) -> set[str]:
    return {word.strip() for word in os.environ.get(name, "").split(",") if word.strip()}


if __name__ == "__main__":
    add_nice(NICE)  # before any thread, so that all have it; never in who only calls main
    sys.exit(Standby(main).run())
