"""Add the commands of the house to ``pons fleet``: house | every | orders | resume | pause | to."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable
    from pathlib import Path

    Ask = Callable[..., Any]
    Pick = Callable[[dict[str, Any]], str]
    Act = Callable[[argparse.Namespace, Path], int]

TUPLES = frozenset({"rooms"})
MAPS = frozenset({"homes"})


def add_commands(acts: Any, ask: Ask, pick: Pick, show: Callable[[dict[str, Any]], None]) -> None:
    """Add them to a parser's commands."""

    def add(name: str, act: Act, about: str, *words: str) -> argparse.ArgumentParser:
        made: argparse.ArgumentParser = acts.add_parser(name, help=about)
        made.set_defaults(act=act)
        for word in words:
            made.add_argument(word)
        return made

    def house(given: argparse.Namespace, _: Path) -> int:
        changes = dict(_read_rule(each) for each in given.rules)
        told = ask("PATCH", "/v1/house", changes) if changes else ask("GET", "/v1/house")
        for name, value in told.items():
            print(f"{name:<14} {json.dumps(value, ensure_ascii=False)}")
        return 0

    def every(given: argparse.Namespace, _: Path) -> int:
        body = {"text": given.text, "when": given.when, "timezone": given.timezone}
        _print_order(ask("POST", "/v1/orders", body), pick)
        return 0

    def orders(given: argparse.Namespace, _: Path) -> int:
        return _on_orders(given, ask, pick)

    def on_mission(name: str) -> Act:
        def act(given: argparse.Namespace, _: Path) -> int:
            body = {"to": given.robot} if name == "to" else {}
            show(ask("POST", f"/v1/missions/{given.mission}/{name}", body))
            return 0

        return act

    about = "show the rules of the house, or set some: quiet=22:00-07:00 rooms=kitchen,bath money="
    add("house", house, about).add_argument("rules", nargs="*", metavar="NAME=VALUE")
    about = 'keep an order: every 19:00 "somebody check the door"; or by cron: every "0 19 * * 1-5"'
    add("every", every, about, "when", "text").add_argument("--timezone", help="else the house's")
    listed = add("orders", orders, "list the standing orders of the house")
    listed.add_argument("--remove", metavar="ID")
    listed.add_argument("--skip", nargs=2, metavar=("ID", "DAY"), help="leave 2026-12-24 out")
    add("resume", on_mission("resume"), "go on with a mission that its robot paused", "mission")
    add("pause", on_mission("pause"), "keep a mission's place at its robot, standing", "mission")
    add("to", on_mission("to"), "give an order that waits to another robot", "mission", "robot")


def _on_orders(given: argparse.Namespace, ask: Ask, pick: Pick) -> int:
    if given.remove:
        _print_order(ask("DELETE", f"/v1/orders/{given.remove}", {}), pick)
    elif given.skip:
        order_id, day = given.skip
        _print_order(ask("POST", f"/v1/orders/{order_id}/skip", {"day": day}), pick)
    else:
        for order in ask("GET", "/v1/orders")["orders"]:
            _print_order(order, pick)
    return 0


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


def _print_order(order: dict[str, Any], pick: Pick) -> None:
    print(f"{order['id']} {order['cron']:<14} {order['next'] or '-':<22} {order['text']}")
    for told in (order["warning"], (order["last"] or {}).get("message")):
        if told:
            print(f"    {pick(told)}")
