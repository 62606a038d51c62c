"""The kit's parts: good words are good, broken ones are broken, and metal is refused."""

from __future__ import annotations

import json
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING, Any, cast

import pytest

from pons.conformance import matrix
from pons.conformance.adapter import CannotTest
from pons.conformance.catalogue import FAULTS, choose_faults
from pons.conformance.command import EXIT_BROKEN, EXIT_HELD, EXIT_UNTESTED, status_of
from pons.conformance.driver import pack, plain
from pons.conformance.fault import W, X
from pons.conformance.flooder import halves
from pons.conformance.proxy import Proxy, ProxyWay
from pons.conformance.reference_client import ReferenceBrain
from pons.conformance.retry_policy import Try
from pons.conformance.runner import COLUMNS, NAMES, MatrixRow
from pons.conformance.site_track import find_track
from pons.conformance.system_under_test import unfit
from pons.conformance.verdict import NOT_ASKED, MatrixCell
from tests.wire.examples import STATUS
from wire import GrantLeft, Mode, Owner, Pose2, Record, Status, decode
from wire.keys import COMMANDS

if TYPE_CHECKING:
    from wire import OwnerKind
    from wire.keys import Key

LONG_S = 20.0
SITES = Path(__file__).resolve().parents[3] / "sites"
KEYS: dict[str, Key[Record]] = {key.path: cast("Key[Record]", key) for key in COMMANDS}


def status(**more: Any) -> Status:
    return STATUS.model_copy(update={"held": None, "base_in_map": Pose2(1.5, 2.0, 1.5), **more})


def brain(kind: OwnerKind, site: str = "two_room") -> ReferenceBrain:
    return ReferenceBrain(kind, "kit", find_track(SITES / site, 0.3))


def owned(kind: OwnerKind, **more: Any) -> Status:
    grant = GrantLeft(mission="line-0", metres=50.0, seconds=600.0)
    owner = Owner(planner_id="kit", kind=kind)
    return status(**{"owner": owner, "grant": grant, "mode": Mode.ACTIVE, **more})


@pytest.mark.parametrize("kind", [X, W])
def test_a_good_brain_says_what_the_wire_takes(kind: OwnerKind) -> None:
    good = brain(kind)
    said = [
        *good.answer(status(owner=None), 0.0, 1),
        *good.answer(owned(kind, grant=None), 1.0, 2),
        *good.answer(owned(kind), 2.0, 3),
    ]
    command = "cmd/external" if kind == X else "cmd/waypoints"
    assert {key for key, _ in said} == {"cmd/hello", "cmd/heartbeat", "cmd/grant", command}
    for key, payload in plain(said, status()):
        message = decode(KEYS[key], payload)
        assert isinstance(message, KEYS[key].message), (key, message)


def test_a_good_brain_turns_back_at_both_ends_and_asks_for_more() -> None:
    good = brain(W)
    ends = [Pose2(*good.track.at(good.track.length_m), 1.5), Pose2(*good.track.at(0.0), 1.5)]
    speeds = []
    for number, pose in enumerate((*ends, *ends)):
        said = dict(good.answer(owned(W, base_in_map=pose), float(number), number))
        speeds += [point["speed_mps"] for point in said["cmd/waypoints"]["points"][:1]]
    assert [speed > 0.0 for speed in speeds] == [False, True, False, True]
    spent = GrantLeft(mission="line-0", metres=1.0, seconds=600.0)
    said = dict(good.answer(owned(W, grant=spent), 9.0, 9))
    assert said["cmd/grant"]["mission"] != "line-0"


def test_every_fault_has_one_row_for_each_brain_and_knows_when_to_stand() -> None:
    rows = [(fault.name, kind) for fault in FAULTS for kind in fault.kinds]
    assert len(set(rows)) == len(rows)
    assert not [fault.name for fault in FAULTS if fault.rest and fault.noticed_s]
    short = choose_faults([], quick=True)
    assert 10 <= sum(len(fault.kinds) for fault in short) <= 16
    assert {kind for fault in short for kind in fault.kinds} == {X, W}
    assert len(choose_faults([], quick=False)) == len(FAULTS)
    assert [fault.name for fault in choose_faults(["flood"], quick=False)] == ["flood"]
    with pytest.raises(CannotTest, match=r"fault_unknown: nonesuch; there are: .*two_brains"):
        choose_faults(["nonesuch"], quick=False)


def test_a_flood_looks_valid() -> None:
    good = brain(X)
    first, last = halves(good.velocity(status(), 0, 0.5, 0.0)[1], owned(X))
    message = decode(KEYS["cmd/external"], first + b"17" + last)
    assert isinstance(message, KEYS["cmd/external"].message)


@pytest.mark.parametrize("site", ["two_room", "home"])
def test_each_site_has_a_line_to_drive_on(site: str) -> None:
    track = find_track(SITES / site, 0.3)
    assert 1.6 <= track.length_m <= 3.5
    along_m, left_m = track.along(track.middle)
    assert along_m == pytest.approx(track.length_m / 2)
    assert left_m == pytest.approx(0.0, abs=1e-9)


def test_a_robot_too_wide_is_told_so() -> None:
    with pytest.raises(CannotTest, match=r"no_track: .* the longest has"):
        find_track(SITES / "two_room", 1.3)


def test_metal_is_refused_and_so_is_another_robot_or_one_that_somebody_owns() -> None:
    virtual = status(owner=None)
    known = (virtual.robot_hash, virtual.map_id or "")
    assert unfit(virtual, *known) is None
    metal = virtual.model_copy(
        update={"drive": virtual.drive.model_copy(update={"virtual": False})}
    )
    assert (unfit(metal, *known) or "").startswith("metal: ")
    assert (unfit(owned(W), *known) or "").startswith("owned: planner kit")
    assert (unfit(virtual, "f" * 16, known[1]) or "").startswith("other_robot: ")
    assert (unfit(virtual, known[0], "f" * 16) or "").startswith("other_site: ")


@contextmanager
def link(path: Path) -> Iterator[tuple[Proxy, socket.socket, socket.socket]]:
    """Yield a proxy, the brain's end of a link through it, and the bridge's."""
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(str(path))
        listener.listen()
        listener.settimeout(LONG_S)
        proxy = Proxy(str(path))
        try:
            host, port = proxy.address.split(":")
            with socket.create_connection((host, int(port))) as near, listener.accept()[0] as far:
                near.settimeout(LONG_S)
                far.settimeout(LONG_S)
                yield proxy, near, far
        finally:
            proxy.close()


def nothing_comes(hearer: socket.socket) -> None:
    hearer.settimeout(0.1)
    with pytest.raises(TimeoutError):
        hearer.recv(9)
    hearer.settimeout(LONG_S)


def test_a_proxy_delivers_keeps_back_and_delivers_late(tmp_path: Path) -> None:
    with link(tmp_path / "s") as (proxy, near, far):
        near.sendall(b"one")
        assert far.recv(9) == b"one"
        far.sendall(b"two")
        assert near.recv(9) == b"two"
        proxy.way = ProxyWay.KEPT
        near.sendall(b"three")
        nothing_comes(far)
        far.sendall(b"heard")
        assert near.recv(9) == b"heard", "the other way stays open"
        near.shutdown(socket.SHUT_WR)
        proxy.way = ProxyWay.OPEN
        assert far.recv(9) == b"three", "delivered though its sender is gone"


def test_a_stalled_proxy_holds_both_ways(tmp_path: Path) -> None:
    with link(tmp_path / "s") as (proxy, near, far):
        proxy.way = ProxyWay.STALLED
        for sender, hearer in ((near, far), (far, near)):
            sender.sendall(b"x")
            nothing_comes(hearer)


def lines() -> list[MatrixRow]:
    good = dict.fromkeys(COLUMNS, MatrixCell(True, "1")) | {"stands": NOT_ASKED}
    bad = good | {"speed": MatrixCell(False, "3.00 m/s")}
    tried = Try({"ticks": "90 of 180"}, "40 of 90 naps late", kept_time=False, excused=True)
    return [
        MatrixRow("nan", "NaN", "velocity", good, (tried,)),
        MatrixRow("flood", "much", "waypoints", bad),
    ]


def test_the_matrix_says_what_failed_in_every_form() -> None:
    origin = matrix.Origin("bridge", "two_room", "abc", "2026-01-01", "a machine", 1)
    assert "FAIL 3.00 m/s" in matrix.table(lines())
    failed_try = "- velocity nan, try 1: ticks: 90 of 180 (the machine did not keep time: 40 of 90"
    assert matrix.tries(lines()).startswith(failed_try)
    assert matrix.tries(lines()[1:]) == ""
    assert "2 rows, 1 failed; 12 cells measured, 1 failed: FAIL" in matrix.summary(lines())
    assert matrix.summary(lines()[:1]).endswith("PASS")
    assert matrix.summary([]).endswith("FAIL"), "nothing played is nothing proven"
    told = json.loads(pack(matrix.record(lines(), origin)))
    assert [row["passed"] for row in told["rows"]] == [True, False]
    assert told["passed"] is False
    page = matrix.into_page(f"a\n{matrix.BEGIN}\nold\n{matrix.END}\nb\n",
                            matrix.markdown(lines(), origin))  # fmt: skip
    assert page.startswith("a\n")
    assert page.endswith("\nb\n")
    assert "old" not in page
    assert failed_try in page
    assert told["rows"][0]["tried"][0]["excused"] is True
    assert "| waypoints | `flood` | much | FAIL 3.00 m/s |" in page


def test_a_row_that_could_not_be_judged_is_no_pass_and_no_failure() -> None:
    good, bad = lines()
    unsure = MatrixCell(False, "446 + 586 missed of 1032, the host took 400", judged=False)
    open_row = replace(good, cells=good.cells | {"ticks": unsure})
    assert not open_row.has_passed
    assert not open_row.has_failed
    assert bad.has_failed
    both = replace(bad, cells=bad.cells | {"ticks": unsure})
    assert both.has_failed, "what else failed has failed"
    assert "NOT JUDGED 446 + 586" in matrix.table([open_row])
    assert "FAIL" not in matrix.one_line(open_row, 1, 2, 3.0)
    assert "NOT JUDGED" in matrix.one_line(open_row, 1, 2, 3.0)
    said = matrix.summary([good, open_row])
    assert said == "2 rows, 0 failed, 1 not judged; 12 cells measured, 0 failed: NOT JUDGED"
    assert matrix.summary([open_row, bad]).endswith(": FAIL")
    told = matrix.record([open_row], matrix.Origin("b", "s", "c", "d", "m", 1))
    assert (told["passed"], told["rows"][0]["passed"], told["rows"][0]["failed"]) == (False,) * 3
    assert [status_of(some) for some in ([good], [good, open_row], [open_row, bad], [])] == [
        EXIT_HELD,
        EXIT_UNTESTED,
        EXIT_BROKEN,
        EXIT_BROKEN,
    ]


def test_a_page_without_marks_takes_no_matrix() -> None:
    with pytest.raises(ValueError, match="no <!-- matrix"):
        matrix.into_page("a page", "x")


def test_the_matrix_in_the_docs_has_every_row_and_none_failed() -> None:
    page = (SITES.parent / "docs" / "conformance.md").read_text("utf-8")
    rows = [line for line in page.splitlines() if line.startswith(("| velocity", "| waypoints"))]
    told = {(line.split("|")[1].strip(), line.split("`")[1]) for line in rows}
    assert told == {(NAMES[kind], fault.name) for fault in FAULTS for kind in fault.kinds}
    assert not [line for line in rows if "FAIL" in line]


def test_chance_is_seeded() -> None:
    junk = choose_faults(["junk"], quick=False)[0]
    assert junk.noticed_s == {X: 0.25, W: 0.5}
    assert Random("1 external").random() == Random("1 external").random()
