"""Let people use the robot: ``pons people [list] | add NAME [--role viewer] | remove ID | pair``.

The token is printed once, as a link for a telephone and as a QR code where a terminal is.
"""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any
from urllib.parse import quote, urlencode

from bridge.operator_key import FILE as KEY_FILE
from pons.http import PlannerDown, PlannerProblem, call, tell_unreached
from pons.settings import allowed_hosts
from pons.supervisor import TOKENS
from pons.terminal import pick

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

LOOPBACK = ("127.0.0.1", "localhost", "::1")
PAIRING = (
    "Who opens this link is the owner: show it to nobody else, and clear the terminal after.",
    "打开此链接的人就是主人：不要给别人看，用后请清除终端内容。",
)
KEY_STAYS = (
    "Without the operator's key: pages without https take none. Start with `pons up --tls`.",
    "不含操作员密钥：没有 https 的网页不接受密钥。请用 `pons up --tls` 启动。",
)
ONLY_HERE = (
    "Here alone; for others PONS_ALLOWED_HOSTS=NAME pons up --tls --host 0.0.0.0 (docs/tls.md)",
    "仅限本机；手机请用 PONS_ALLOWED_HOSTS=主机名 pons up --tls --host 0.0.0.0（docs/tls.md）",
)
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
    if act == "pair":
        return pair_owner(settings)
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


def pair_owner(settings: LaunchSettings) -> int:
    """Print the owner's own link: with the operator's token and key, as far as they are set.

    They stand behind the address's #, which no browser sends; a page that came without https takes
    no key. Nothing is asked of the planner, and nothing new is made.
    """
    import os

    key_file = settings.home / KEY_FILE
    try:
        key = key_file.read_text("ascii").strip()
    except FileNotFoundError:
        key = ""
    except (OSError, ValueError) as error:
        print(f"operator_key_unreadable: {key_file}: {error}", file=sys.stderr)
        return EXIT_REFUSED
    secrets = {
        "token": os.environ.get(TOKENS[0], ""),
        "key": key if may_carry_key(settings) else "",
    }
    told = {name: value for name, value in secrets.items() if value}
    base = _url_from_elsewhere(settings)
    link = f"{base}/#{urlencode(told)}" if told else base
    print(pick(*PAIRING))
    print(link)
    if key and "key" not in told:
        print(pick(*KEY_STAYS))
    if base == settings.url and settings.host_to_dial in LOOPBACK:
        print(pick(*ONLY_HERE))
    if sys.stdout.isatty():
        print(qr_text(link))
    return EXIT_DONE


def _url_from_elsewhere(settings: LaunchSettings) -> str:
    """Return the address that a telephone opens: by a name that the planner answers to."""
    named = sorted(allowed_hosts())
    if settings.host not in ("0.0.0.0", "::") or not named:
        return settings.url
    return f"{'https' if settings.tls else 'http'}://{named[0]}:{settings.port}"


def may_carry_key(settings: LaunchSettings) -> bool:
    """Tell whether a page under this robot's address may take the operator's key."""
    return settings.tls or settings.host in LOOPBACK


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
