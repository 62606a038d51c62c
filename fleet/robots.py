"""Add robots: read the card, pin the certificate, keep the token in a file of the owner's alone."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING

from fleet.addressee import is_free_name
from fleet.answers import read_card
from fleet.errors import FleetError
from fleet.link import TOKEN_REFUSED, FleetLink, RobotAway, RobotBusy, RobotRefusal
from fleet.pin import Pin, clean_url, take_pin
from fleet.records import RobotRow

if TYPE_CHECKING:
    from pathlib import Path

    from fleet.house_store import HouseStore

ROLE = "dispatcher"


def link_of(robot: RobotRow, home: Path) -> FleetLink:
    """Return the way to a robot that was added."""
    kind = robot.pin_kind
    pin = Pin(kind, robot.pin_sha256, robot.pin_pem)  # type: ignore[arg-type]  # as it was kept
    token = read_token(home, robot.name)
    return FleetLink(robot.name, robot.url, robot.robot_id, pin, token)


async def add_robot(
    store: HouseStore,
    home: Path,
    url: str,
    token: str,
    name: str | None,
    *,
    again: bool = False,
    expected: str | None = None,
) -> RobotRow:
    """Take a robot into the fleet and return it.

    Args:
        store: of the fleet.
        home: the fleet's folder.
        url: of the robot.
        token: of the role dispatcher, made at the robot; empty on loopback without tokens.
        name: by which it is called here; None: the robot's own id.
        again: renew one that is known.
        expected: the SHA-256 that its certificate must have, before the token goes out.

    Raises:
        FleetError: it can't be reached, does not take the token, or is known already.
    """  # fmt: skip
    address = clean_url(url)
    pin = take_pin(address)
    if expected is not None and expected.replace(":", "").strip().lower() != pin.sha256:
        raise FleetError("pin_mismatch", name=address)
    link = FleetLink(name or address, address, "", pin, token)
    try:
        card = read_card(await link.get("/v1/capabilities"), address)
        await _judge_role(link, token)
    except (RobotAway, RobotBusy) as silent:
        raise FleetError("robot_silent", str(silent), name=address) from None
    except RobotRefusal as refused:
        if refused.status in TOKEN_REFUSED:
            raise FleetError("token_refused", str(refused), name=address) from None
        code = refused.code if refused.code == "certificate_dates" else "card_unread"
        raise FleetError(code, str(refused), name=address) from None
    finally:
        await link.close()
    robot_id = str(card["robot_id"])
    called = name or robot_id
    if not is_free_name(called):
        raise FleetError("bad_name", name=called[:40])
    row = RobotRow(called, address, robot_id, pin.kind, pin.sha256, pin.pem,
                   json.dumps(card, ensure_ascii=False))  # fmt: skip
    store.keep_robot(row, again=again)
    write_token(home, called, token)
    return row


async def _judge_role(link: FleetLink, token: str) -> None:
    """Accept a dispatcher's token, and on loopback none at all.

    Raises:
        FleetError: ``role_refused``: a lost token of this one would let others arm and steer.
    """
    if not token:
        return
    told = await link.get("/v1/people")
    you = (told.get("you") or {}) if isinstance(told, dict) else {}
    if you.get("role") != ROLE:
        raise FleetError("role_refused", role=str(you.get("role", "operator"))[:20])


def write_token(home: Path, name: str, token: str) -> None:
    """Keep a robot's token where nobody else can read it at any moment."""
    folder = home / "tokens"
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    new, file = folder / f"{name}.new", folder / name
    new.unlink(missing_ok=True)
    descriptor = os.open(new, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o600)
    with os.fdopen(descriptor, "w") as opened:
        opened.write(token)
        opened.flush()
        os.fsync(descriptor)
    new.replace(file)


def read_token(home: Path, name: str) -> str:
    """Return a robot's token; empty where none is kept."""
    try:
        return (home / "tokens" / name).read_text("utf-8").strip()
    except OSError:
        return ""
