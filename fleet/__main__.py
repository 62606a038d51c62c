"""Be the command ``pons fleet``: up | demo | add | list | say | stop | answer | …, by words."""

from __future__ import annotations

import argparse
import asyncio
import json
import logging
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
from sqlalchemy.exc import SQLAlchemyError

from fleet.errors import FleetError, tell
from pons.command_parser import CommandParser

if TYPE_CHECKING:
    from collections.abc import Callable

    Act = Callable[[argparse.Namespace, Path], int]

EXIT_DONE, EXIT_USAGE, EXIT_REFUSED, EXIT_DOWN = 0, 2, 3, 6
DEFAULT_PORT = 8440
TUPLES, MAPS = frozenset({"rooms"}), frozenset({"homes"})
"""Rules of the house that are lists of words, and words by name."""


class ServiceProblem(Exception):
    """The service refused."""


def main(words: list[str] | None = None) -> int:
    """Run one command."""
    given = grammar().parse_args(words)
    home = Path(os.environ.get("PONS_HOME", ".pons")).absolute()
    try:
        return int(given.act(given, home))
    except FleetError as refused:
        print(f"refused: {refused.code}: {_pick(refused.message)}", file=sys.stderr)
        if refused.detail != refused.message["en"]:
            print(refused.detail, file=sys.stderr)
        return EXIT_REFUSED
    except ServiceProblem as refused:
        print(f"refused: {refused}", file=sys.stderr)
        return EXIT_REFUSED
    except SQLAlchemyError as error:
        print(f"store_unavailable: {_pick(tell('store_unavailable'))}\n{error}", file=sys.stderr)
        return EXIT_DOWN
    except httpx.HTTPError as error:
        told = _pick({"en": "is `pons fleet up` running?", "zh": "`pons fleet up` 是否在运行？"})
        print(f"fleet_down: {error}; {told}", file=sys.stderr)
        return EXIT_DOWN
    except KeyboardInterrupt:
        return EXIT_DONE


def grammar() -> CommandParser:
    """Return the words of the command."""
    examples = ("pons fleet demo", 'pons fleet say "everybody go home"', "pons fleet stop")
    about = "Give orders to several robots as to one (docs/fleet.md)."
    parser = CommandParser(prog="pons fleet", description=about, examples=examples)
    as_json = "print the answer as it came"
    parser.add_argument("--json", action="store_true", help=as_json)
    acts = parser.add_subparsers(required=True, metavar="COMMAND")

    def command(act: Act, about: str, *examples: str) -> CommandParser:
        """Add a command that is called as its first example is."""
        name = examples[0].split()[0]
        made: CommandParser = acts.add_parser(
            name, help=about, description=f"{about[0].upper()}{about[1:]}.",
            examples=[f"pons fleet {example}" for example in examples],
        )  # fmt: skip
        kept = argparse.SUPPRESS  # what was said before the command
        made.add_argument("--json", action="store_true", default=kept, help=as_json)
        made.set_defaults(act=act)
        return made

    _add_service_commands(command)
    _add_mission_commands(command)
    _add_house_commands(command)
    return parser


def _add_service_commands(command: Callable[..., CommandParser]) -> None:
    """Add up | demo | add | list."""
    up = command(_serve, "serve page and API until stopped", "up", "up --port 8441")
    up.add_argument("--host", default="127.0.0.1", help="to listen at; others need --tls-cert")
    up.add_argument("--port", type=int, default=_port())
    up.add_argument("--tls-cert", type=Path, help="with the chain")
    up.add_argument("--tls-key", type=Path)
    command(_become_demo, "try it: start three simulated robots and their fleet", "demo")
    about = "take a robot in: read its card and pin its certificate"
    add = command(_add, about, "add https://r3.local --token TOKEN", "add https://r3.local --again")
    add.add_argument("url", help="https://ROBOT[:PORT]")
    add.add_argument("--token", default="", help="of the role dispatcher; - reads it from stdin")
    add.add_argument("--name", help="what it is called here; else its own id")
    add.add_argument("--sha256", help="of its authority, as `pons tls` says there")
    add.add_argument("--again", action="store_true", help="renew its token and certificate")
    command(_list, "show robots and missions", "list", "list --json")


def _add_mission_commands(command: Callable[..., CommandParser]) -> None:
    """Add say | stop | answer | cancel | resume | pause | to."""
    about = "give an order to any, the nearest, named, each or all but some"
    said = command(_say, about, 'say "everybody go home"', 'say "r2: go to the kitchen"')
    said.add_argument("text")
    said.add_argument("--confirm", action="store_true", help="show the plan and wait for a yes")
    said.add_argument("--key", help="the same key and order make the same missions")
    stop = command(_stop, "stop robots; without names all", "stop", "stop r1 r2")
    stop.add_argument("robots", nargs="*")
    answer = command(_on_mission("answer", "text"), "answer what a mission asks", "answer m-1 yes")
    cancel = command(_on_mission("cancel", "give_up"), "end a mission", "cancel m-1")
    cancel.add_argument("--give-up", action="store_true", help="end one whose robot is silent")
    resume = command(
        _on_mission("resume"), "go on with a mission that its robot paused", "resume m-1"
    )
    about = "keep a mission's place at its robot, standing"
    pause = command(_on_mission("pause"), about, "pause m-1")
    to = command(_on_mission("to", "to"), "give an order that waits to another robot", "to m-1 r2")
    for each in (answer, cancel, resume, pause, to):
        each.add_argument("mission")
    answer.add_argument("text")
    to.add_argument("to", metavar="robot")


def _add_house_commands(command: Callable[..., CommandParser]) -> None:
    """Add house | every | orders."""
    about = "show the rules of the house, or set some"
    house = command(_house, about, "house", "house quiet=22:00-07:00 rooms=kitchen,bath money=")
    house.add_argument("rules", nargs="*", metavar="NAME=VALUE")
    examples = ('every 19:00 "somebody check the door"', 'every "0 19 * * 1-5" "r1: go home"')
    every = command(_every, "keep an order for a time of day, or by cron", *examples)
    every.add_argument("when")
    every.add_argument("text")
    every.add_argument("--timezone", help="else the house's")
    about = "list the standing orders of the house, or change one"
    listed = command(_on_orders, about, "orders", "orders --skip 1f2e 2026-12-24")
    listed.add_argument("--remove", metavar="ID")
    listed.add_argument("--skip", nargs=2, metavar=("ID", "DAY"), help="leave one day out")


def _serve(given: argparse.Namespace, home: Path) -> int:
    from fleet.service import serve
    from wire import ConfigError

    logging.basicConfig(level=logging.WARNING, format="%(levelname)s %(name)s %(message)s")
    print(f"fleet at {'https' if given.tls_cert else 'http'}://{given.host}:{given.port}",
          file=sys.stderr)  # fmt: skip
    try:
        serve(home, given.host, given.port, os.environ, given.tls_cert, given.tls_key)
    except ConfigError as wrong:
        print(wrong, file=sys.stderr)
        return EXIT_USAGE
    return EXIT_DONE


def _become_demo(_: argparse.Namespace, __: Path) -> int:
    """Become the process that starts robots, of whom the fleet knows the HTTP API alone."""
    sys.stdout.flush()
    os.execv(sys.executable, [sys.executable, "-m", "pons.fleet_demo"])
    return EXIT_USAGE  # not reached


def _add(given: argparse.Namespace, home: Path) -> int:
    from fleet.robots import add_robot
    from fleet.service import database_url, own_home
    from fleet.store import FleetStore

    folder = own_home(home)
    token = sys.stdin.readline().strip() if given.token == "-" else given.token
    store = FleetStore(database_url(folder, os.environ))
    try:
        adding = add_robot(store, folder, given.url, token, given.name,
                           again=given.again, expected=given.sha256)  # fmt: skip
        robot = asyncio.run(adding)
    finally:
        store.close()
    card = robot.capabilities
    print(f"{robot.name} added: {robot.url}, site {card.get('site')}, Pons {card.get('release')}")
    if robot.pin_sha256:
        shown = ":".join(robot.pin_sha256[at : at + 2] for at in range(0, 64, 2)).upper()
        told = {"en": "compare it with `pons tls` there", "zh": "请与那里的 `pons tls` 对照"}
        print(f"{robot.pin_kind} SHA-256 {shown}; {_pick(told)}")
    return EXIT_DONE


def _show(given: argparse.Namespace, told: Any, tell_it: Callable[[Any], None]) -> int:
    """Print an answer as it came, or as it is told people."""
    if given.json:
        print(json.dumps(told, ensure_ascii=False))
    else:
        tell_it(told)
    return EXIT_DONE


def _list(given: argparse.Namespace, _: Path) -> int:
    return _show(given, {**_ask("GET", "/v1/robots"), **_ask("GET", "/v1/missions")}, _print_fleet)


def _say(given: argparse.Namespace, _: Path) -> int:
    headers = {"idempotency-key": given.key} if given.key else {}
    body = {"text": given.text, "confirm": given.confirm}
    told = _ask("POST", "/v1/missions", body, headers)
    _show(given, told, _print_given)
    return _exit_of(told["stop"]) if told["stop"] else EXIT_DONE


def _stop(given: argparse.Namespace, _: Path) -> int:
    told = _ask("POST", "/v1/stop", {"robots": given.robots} if given.robots else {})
    _show(given, told, _print_stop)
    return _exit_of(told)


def _on_mission(name: str, *fields: str) -> Act:
    """Return what acts on a mission, with the words that its body takes."""

    def act(given: argparse.Namespace, _: Path) -> int:
        body = {field: getattr(given, field) for field in fields}
        path = f"/v1/missions/{given.mission}/{name}"
        return _show(given, _ask("POST", path, body), _print_mission)

    return act


def _house(given: argparse.Namespace, _: Path) -> int:
    changes = dict(_read_rule(each) for each in given.rules)
    told = _ask("PATCH", "/v1/house", changes) if changes else _ask("GET", "/v1/house")
    return _show(given, told, _print_rules)


def _every(given: argparse.Namespace, _: Path) -> int:
    body = {"text": given.text, "when": given.when, "timezone": given.timezone}
    return _show(given, _ask("POST", "/v1/orders", body), _print_order)


def _on_orders(given: argparse.Namespace, _: Path) -> int:
    if given.remove:
        return _show(given, _ask("DELETE", f"/v1/orders/{given.remove}", {}), _print_order)
    if given.skip:
        order_id, day = given.skip
        told = _ask("POST", f"/v1/orders/{order_id}/skip", {"day": day})
        return _show(given, told, _print_order)
    return _show(given, _ask("GET", "/v1/orders"), _print_orders)


def _read_rule(given: str) -> tuple[str, Any]:
    """Return a rule's name and value: words apart by commas, numbers, true, false; empty: none."""
    name, _, text = given.partition("=")
    if name in TUPLES:
        return name, [each for each in text.split(",") if each]
    if name in MAPS:
        return name, dict(each.split(":", 1) for each in text.split(",") if ":" in each)
    try:
        return name, json.loads(text) if text else None
    except ValueError:
        return name, text


def _print_order(order: dict[str, Any]) -> None:
    print(f"{order['id']} {order['cron']:<14} {order['next'] or '-':<22} {order['text']}")
    for told in (order["warning"], (order["last"] or {}).get("message")):
        if told:
            print(f"    {_pick(told)}")


def _ask(
    method: str, path: str, body: dict[str, Any] | None = None, more: dict[str, str] | None = None
) -> Any:
    """Return the service's answer.

    Raises:
        ServiceProblem: it refused.
    """
    url = os.environ.get("PONS_FLEET", f"http://127.0.0.1:{_port()}")
    headers = dict(more or {})
    if token := os.environ.get("PONS_FLEET_TOKEN"):
        headers["authorization"] = f"Bearer {token}"
    verify: Any = True
    if authority := os.environ.get("PONS_CA"):
        import ssl

        verify = ssl.create_default_context(cafile=authority)
    with httpx.Client(base_url=url, verify=verify, trust_env=False, timeout=10.0) as client:
        answer = client.request(method, path, json=body, headers=headers)
    content = answer.json()
    if answer.is_error:
        raise ServiceProblem(f"{content.get('code')}: {_pick(content.get('message') or {})}")
    return content


def _exit_of(stop: dict[str, Any]) -> int:
    return EXIT_DONE if not stop["not_reached"] else EXIT_REFUSED


def _print_stop(told: dict[str, Any]) -> None:
    print(_pick(told["message"]))


def _print_given(told: dict[str, Any]) -> None:
    for mission in told["missions"]:
        _print_mission(mission)
    if told["stop"]:
        _print_stop(told["stop"])


def _print_fleet(told: dict[str, Any]) -> None:
    for robot in told["robots"]:
        place = robot["room"] or robot["site"] or "-"
        print(f"{robot['name']:<16} {robot['state']:<16} {place:<16} {robot['mission'] or 'free'}")
    for mission in told["missions"]:
        _print_mission(mission)


def _print_rules(told: dict[str, Any]) -> None:
    for name, value in told.items():
        print(f"{name:<14} {json.dumps(value, ensure_ascii=False)}")


def _print_orders(told: dict[str, Any]) -> None:
    for order in told["orders"]:
        _print_order(order)


def _print_mission(mission: dict[str, Any]) -> None:
    question = mission["question"] or {}
    told = _pick(question.get("text") or mission["message"] or {})
    print(f"{mission['id']} {mission['state']:<9} {mission['robot'] or '-':<10} {mission['text']}"
          + (f"\n    {told}" if told else ""))  # fmt: skip


def _pick(told: dict[str, Any]) -> str:
    language = os.environ.get("LC_ALL") or os.environ.get("LC_MESSAGES") or os.environ.get("LANG")
    return str(told.get("zh" if (language or "").startswith("zh") else "en") or "")


def _port() -> int:
    return int(os.environ.get("PONS_FLEET_PORT", DEFAULT_PORT))


if __name__ == "__main__":
    sys.exit(main())
