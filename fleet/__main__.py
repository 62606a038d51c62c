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
    given = _parser().parse_args(words)
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


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="pons fleet", description="Give orders to several robots as to one (docs/fleet.md)."
    )
    parser.add_argument("--json", action="store_true", help="print the answer as it came")
    acts = parser.add_subparsers(required=True, metavar="COMMAND")
    up = acts.add_parser("up", help="serve until stopped")
    up.add_argument("--host", default="127.0.0.1")
    up.add_argument("--port", type=int, default=_port())
    up.add_argument("--tls-cert", type=Path)
    up.add_argument("--tls-key", type=Path)
    up.set_defaults(act=_serve)
    demo = acts.add_parser("demo", help="try it: three simulated robots and their fleet")
    demo.set_defaults(act=_become_demo)
    add = acts.add_parser("add", help="take a robot in: read its card, pin its certificate")
    add.add_argument("url", help="https://ROBOT[:PORT]")
    add.add_argument("--token", default="", help="of the role dispatcher; - reads it from stdin")
    add.add_argument("--name", help="what it is called here; else its own id")
    add.add_argument("--sha256", help="of its authority, as `pons tls` says there")
    add.add_argument("--again", action="store_true", help="renew its token and certificate")
    add.set_defaults(act=_add)
    listed = acts.add_parser("list", help="show robots and missions")
    listed.set_defaults(act=_list)
    said = acts.add_parser("say", help='give an order: pons fleet say "everybody go home"')
    said.add_argument("text")
    said.add_argument("--confirm", action="store_true", help="show the plan and wait for a yes")
    said.add_argument("--key", help="the same key and order make the same missions")
    said.set_defaults(act=_say)
    stop = acts.add_parser("stop", help="stop robots; without names all")
    stop.add_argument("robots", nargs="*")
    stop.set_defaults(act=_stop)
    answer = acts.add_parser("answer", help="answer what a mission asks")
    answer.add_argument("mission")
    answer.add_argument("text")
    answer.set_defaults(act=_answer)
    cancel = acts.add_parser("cancel", help="end a mission")
    cancel.add_argument("mission")
    cancel.add_argument("--give-up", action="store_true", help="end one whose robot is silent")
    cancel.set_defaults(act=_cancel)
    _add_house_commands(acts)
    return parser


def _add_house_commands(acts: Any) -> None:
    """Add house | every | orders | resume | pause | to."""

    def add(name: str, act: Act, about: str, *words: str) -> argparse.ArgumentParser:
        made: argparse.ArgumentParser = acts.add_parser(name, help=about)
        made.set_defaults(act=act)
        for word in words:
            made.add_argument(word)
        return made

    def house(given: argparse.Namespace, _: Path) -> int:
        changes = dict(_read_rule(each) for each in given.rules)
        told = _ask("PATCH", "/v1/house", changes) if changes else _ask("GET", "/v1/house")
        for name, value in told.items():
            print(f"{name:<14} {json.dumps(value, ensure_ascii=False)}")
        return EXIT_DONE

    def every(given: argparse.Namespace, _: Path) -> int:
        body = {"text": given.text, "when": given.when, "timezone": given.timezone}
        _print_order(_ask("POST", "/v1/orders", body))
        return EXIT_DONE

    def on_mission(name: str) -> Act:
        def act(given: argparse.Namespace, _: Path) -> int:
            body = {"to": given.robot} if name == "to" else {}
            _print_mission(_ask("POST", f"/v1/missions/{given.mission}/{name}", body))
            return EXIT_DONE

        return act

    about = "show the rules of the house, or set some: quiet=22:00-07:00 rooms=kitchen,bath money="
    add("house", house, about).add_argument("rules", nargs="*", metavar="NAME=VALUE")
    about = 'keep an order: every 19:00 "somebody check the door"; or by cron: every "0 19 * * 1-5"'
    add("every", every, about, "when", "text").add_argument("--timezone", help="else the house's")
    listed = add("orders", _on_orders, "list the standing orders of the house")
    listed.add_argument("--remove", metavar="ID")
    listed.add_argument("--skip", nargs=2, metavar=("ID", "DAY"), help="leave 2026-12-24 out")
    add("resume", on_mission("resume"), "go on with a mission that its robot paused", "mission")
    add("pause", on_mission("pause"), "keep a mission's place at its robot, standing", "mission")
    add("to", on_mission("to"), "give an order that waits to another robot", "mission", "robot")


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


def _list(given: argparse.Namespace, _: Path) -> int:
    robots, missions = _ask("GET", "/v1/robots"), _ask("GET", "/v1/missions")
    if given.json:
        print(json.dumps({**robots, **missions}, ensure_ascii=False))
        return EXIT_DONE
    for robot in robots["robots"]:
        place = robot["room"] or robot["site"] or "-"
        print(f"{robot['name']:<16} {robot['state']:<16} {place:<16} {robot['mission'] or 'free'}")
    for mission in missions["missions"]:
        _print_mission(mission)
    return EXIT_DONE


def _say(given: argparse.Namespace, _: Path) -> int:
    headers = {"idempotency-key": given.key} if given.key else {}
    body = {"text": given.text, "confirm": given.confirm}
    told = _ask("POST", "/v1/missions", body, headers)
    if given.json:
        print(json.dumps(told, ensure_ascii=False))
        return EXIT_DONE
    for mission in told["missions"]:
        _print_mission(mission)
    return _tell_stop(told["stop"]) if told["stop"] else EXIT_DONE


def _stop(given: argparse.Namespace, _: Path) -> int:
    told = _ask("POST", "/v1/stop", {"robots": given.robots} if given.robots else {})
    return _tell_stop(told)


def _answer(given: argparse.Namespace, _: Path) -> int:
    _print_mission(_ask("POST", f"/v1/missions/{given.mission}/answer", {"text": given.text}))
    return EXIT_DONE


def _cancel(given: argparse.Namespace, _: Path) -> int:
    body = {"give_up": given.give_up}
    _print_mission(_ask("POST", f"/v1/missions/{given.mission}/cancel", body))
    return EXIT_DONE


def _on_orders(given: argparse.Namespace, _: Path) -> int:
    if given.remove:
        _print_order(_ask("DELETE", f"/v1/orders/{given.remove}", {}))
    elif given.skip:
        order_id, day = given.skip
        _print_order(_ask("POST", f"/v1/orders/{order_id}/skip", {"day": day}))
    else:
        for order in _ask("GET", "/v1/orders")["orders"]:
            _print_order(order)
    return EXIT_DONE


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


def _tell_stop(told: dict[str, Any]) -> int:
    print(_pick(told["message"]))
    return EXIT_DONE if not told["not_reached"] else EXIT_REFUSED


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
