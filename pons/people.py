"""Let people use the robot: ``pons people [list] | add NAME [--role viewer] | remove ID``.

The token is printed once, as a link for a telephone and as a QR code where a terminal is.
"""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from pons.http import PlannerDown, PlannerProblem, call, tell_unreached

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_USAGE, EXIT_REFUSED, EXIT_DOWN = 0, 2, 3, 6
PATH = "/v1/people"
ROLES = {
    "operator": "may use the robot",
    "viewer": "may look and stop",
    "dispatcher": "may give the robot work, and stop it",
    "agent": "may give the robot work of its own, and stop it",
}
_BLOCKS = {(False, False): " ", (True, False): "▀", (False, True): "▄", (True, True): "█"}
"""Two modules of a QR code, one above the other, in one character; True is light."""


def run(
    settings: LaunchSettings, act: str, name: str | None, *, role: str, as_json: bool = False
) -> int:
    """Do one of the acts; 0 done, 2 bad order, 3 refused, 6 nobody answers."""
    if act != "list" and name is None:
        print(f"no_name: say whom to {act}", file=sys.stderr)
        return EXIT_USAGE
    try:
        if act == "add":
            _add(settings, name or "", role, as_json=as_json)
        elif act == "remove":
            gone = call(settings, "DELETE", f"{PATH}/{quote(name or '', safe='')}")
            print(f"removed {gone['id']}: {gone['name']}; the token opens nothing any more")
        else:
            _list(settings, as_json=as_json)
    except PlannerProblem as refused:
        told = " ".join(refused.told.values())
        print(f"refused: {refused}" + (f"\n{told}" if told else ""), file=sys.stderr)
        return EXIT_REFUSED
    except PlannerDown as trouble:
        print(tell_unreached(trouble), file=sys.stderr)
        return EXIT_DOWN
    return EXIT_DONE


def _list(settings: LaunchSettings, *, as_json: bool) -> None:
    people = call(settings, "GET", PATH)["people"]
    if as_json:
        print(json.dumps(people, ensure_ascii=False))
        return
    for person in people:
        print(f"{person['id']:<24} {person['role']:<9} since {person['since']}  {person['name']}")
    if not people:
        print("nobody yet: pons people add NAME makes a token for a person or a telephone")


def _add(settings: LaunchSettings, name: str, role: str, *, as_json: bool) -> None:
    made: dict[str, Any] = call(settings, "POST", PATH, {"name": name, "role": role})
    link = f"{settings.url}/#token={made['token']}"
    if as_json:
        print(json.dumps({**made, "link": link}, ensure_ascii=False))
        return
    print(f"{made['id']} {ROLES[role]}.")
    if role == "agent":
        print(f"This token is told once (docs/mcp.md); who has it is {made['name']}:")
        print(made["token"])
        return
    print(f"This link is told once; who has it is {made['name']}:\n{link}")
    if sys.stdout.isatty():
        print(qr_text(link))


def qr_text(text: str) -> str:
    """Return a QR code in half blocks, white on black whatever the terminal's colours are."""
    import cv2  # a tenth of a second that nothing else here needs

    dark = cv2.QRCodeEncoder.create().encode(text) == 0
    rows = [[not module for module in row] for row in dark.tolist()]
    light = [True] * (len(rows[0]) + 4)
    framed = [light, light, *([True, True, *row, True, True] for row in rows), light, light]
    framed += [light] * (len(framed) % 2)
    pairs = zip(framed[::2], framed[1::2], strict=True)
    return "\n".join(
        "\x1b[97;40m"
        + "".join(_BLOCKS[above, below] for above, below in zip(upper, lower, strict=True))
        + "\x1b[0m"
        for upper, lower in pairs
    )
