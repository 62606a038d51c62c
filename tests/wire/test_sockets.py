"""Sockets have room, locks tell the living from the dead."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from wire import Misconfigured
from wire.keys import Party
from wire.sockets import MAX_SOCKET_PATH, Claim, Endpoints

HOLDER = """
import sys, time
from pathlib import Path
from wire.keys import Party
from wire.sockets import Claim
claim = Claim(Path(sys.argv[1]), Party.BRIDGE)
print("held", flush=True)
time.sleep(60)
"""


def test_a_path_too_long_is_refused_before_anything_is_opened() -> None:
    home = Path("/" + "x" * MAX_SOCKET_PATH)
    with pytest.raises(Misconfigured) as refused:
        Endpoints(home).locator(Party.BRIDGE)
    assert refused.value.code == "socket_path_too_long"
    assert "PONS_HOME" in refused.value.detail


def test_the_longest_path_passes() -> None:
    room = MAX_SOCKET_PATH - len("/run/bridge.sock")
    locator = Endpoints(Path("/" + "x" * (room - 1))).locator(Party.BRIDGE)
    assert len(locator.removeprefix("unixsock-stream/")) == MAX_SOCKET_PATH


def test_tcp_takes_the_place_of_the_socket() -> None:
    where = Endpoints(Path("/home"), {Party.ROBOT: "10.0.0.2:7447"})
    assert where.locator(Party.ROBOT) == "tcp/10.0.0.2:7447"


def test_a_second_claim_names_the_first(tmp_path: Path) -> None:
    first = Claim(tmp_path, Party.BRIDGE)
    with pytest.raises(Misconfigured) as refused:
        Claim(tmp_path, Party.BRIDGE)
    assert refused.value.code == "already_running"
    assert str(os.getpid()) in refused.value.detail
    first.close()
    Claim(tmp_path, Party.BRIDGE).close()


def test_a_home_that_cannot_be_written_is_refused_by_its_path(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("a file where a folder should be")
    with pytest.raises(Misconfigured) as refused:
        Claim(file, Party.BRIDGE)
    assert refused.value.code == "home_unwritable"
    assert str(file) in refused.value.detail


def test_different_parties_do_not_disturb_each_other(tmp_path: Path) -> None:
    claims = [Claim(tmp_path, party) for party in (Party.BRIDGE, Party.PLANNER, Party.ROBOT)]
    for claim in claims:
        claim.close()


def test_a_killed_holder_leaves_no_lock(tmp_path: Path) -> None:
    holder = subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(tmp_path)], stdout=subprocess.PIPE, text=True
    )
    assert holder.stdout is not None
    assert holder.stdout.readline() == "held\n"
    with pytest.raises(Misconfigured):
        Claim(tmp_path, Party.BRIDGE)
    holder.kill()
    holder.wait()
    holder.stdout.close()
    Claim(tmp_path, Party.BRIDGE).close()
