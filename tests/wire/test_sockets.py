"""Sockets have room, locks tell the living from the dead."""

from __future__ import annotations

import os
import resource
import socket
import stat
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from wire import ConfigError, Unwritable
from wire.doors import BRIDGE_DOOR, DRIVE_DOOR, SENSES_DOOR
from wire.keys import Party
from wire.session import open_session
from wire.sockets import (
    MAX_SOCKET_PATH,
    Claim,
    Endpoints,
    is_listening,
    misplaced_listener,
    unreachable,
)

BRIDGE, SIM, OPERATOR = 61_001, 61_003, 61_004
"""Users of nobody's."""
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
    with pytest.raises(ConfigError) as refused:
        Endpoints(home).locator(BRIDGE_DOOR)
    assert refused.value.code == "socket_path_too_long"
    assert "PONS_HOME" in refused.value.detail


def test_the_longest_path_passes() -> None:
    room = MAX_SOCKET_PATH - len("/run/bridge/bridge.sock")
    locator = Endpoints(Path("/" + "x" * (room - 1))).locator(BRIDGE_DOOR)
    assert len(locator.removeprefix("unixsock-stream/")) == MAX_SOCKET_PATH


def test_tcp_takes_the_place_of_the_socket() -> None:
    where = Endpoints(Path("/home"), {DRIVE_DOOR: "10.0.0.2:7447"})
    assert where.locator(DRIVE_DOOR) == "tcp/10.0.0.2:7447"


def test_a_second_claim_names_the_first(tmp_path: Path) -> None:
    first = Claim(tmp_path, Party.BRIDGE)
    with pytest.raises(ConfigError) as refused:
        Claim(tmp_path, Party.BRIDGE)
    assert refused.value.code == "already_running"
    assert str(os.getpid()) in refused.value.detail
    first.close()
    Claim(tmp_path, Party.BRIDGE).close()


def test_a_home_that_cannot_be_written_is_refused_by_its_path(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("a file where a folder should be")
    with pytest.raises(Unwritable) as refused:
        Claim(file, Party.BRIDGE)
    assert refused.value.code == "home_unwritable"
    assert str(file) in refused.value.detail


def test_a_lock_that_finds_no_room_is_refused_by_its_path(tmp_path: Path) -> None:
    Claim(tmp_path, Party.BRIDGE).close()
    most = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, most[1]))
    try:
        with pytest.raises(Unwritable, match=r"home_unwritable: .*/bridge/bridge\.lock: "):
            Claim(tmp_path, Party.BRIDGE)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, most)
    Claim(tmp_path, Party.BRIDGE).close()


def test_what_lies_in_a_sockets_way_and_cannot_be_removed_is_named(tmp_path: Path) -> None:
    path = Endpoints(tmp_path).socket(BRIDGE_DOOR)
    path.mkdir(parents=True)
    with closing(Claim(tmp_path, Party.BRIDGE)) as claim:
        with pytest.raises(Unwritable, match=f"home_unwritable: {path}: "):
            claim.make_way(path)
        path.rmdir()
        claim.make_way(path)


def test_only_what_may_pass_ends_a_process_so_that_it_is_started_again() -> None:
    """2 is what ``RestartPreventExitStatus`` says in each unit of deploy/systemd."""
    assert ConfigError("robot_toml_invalid", "a wrong key").exit_status == 2
    assert Unwritable("home_unwritable", "read-only at present").exit_status == 1


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
    with pytest.raises(ConfigError):
        Claim(tmp_path, Party.BRIDGE)
    holder.kill()
    holder.wait()
    holder.stdout.close()
    Claim(tmp_path, Party.BRIDGE).close()


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def test_a_door_has_a_folder_for_its_listener_alone(tmp_path: Path) -> None:
    with open_session(Party.BRIDGE, "r1", tmp_path):
        for door in (BRIDGE_DOOR, SENSES_DOOR):
            path = Endpoints(tmp_path).socket(door)
            assert (mode(path.parent), mode(path)) == (0o700, 0o600)
    assert mode(tmp_path / "run") == 0o700


def test_a_folder_that_a_group_may_enter_lets_it_connect_and_nothing_else(tmp_path: Path) -> None:
    """As tmpfiles.d makes it for users of their own, whatever the umask of the listener is."""
    folder = Endpoints(tmp_path).socket(BRIDGE_DOOR).parent
    folder.mkdir(parents=True)
    folder.chmod(0o2770)
    before = os.umask(0o077)
    try:
        with open_session(Party.BRIDGE, "r1", tmp_path):
            assert mode(folder) & 0o777 == 0o750, "its own folder is shut against others' writing"
            assert mode(Endpoints(tmp_path).socket(BRIDGE_DOOR)) == 0o660
            assert mode(folder / "bridge.lock") == 0o600
    finally:
        os.umask(before)


@contextmanager
def acting_as(uid: int) -> Iterator[None]:
    """Be another user in this process for a moment; root comes back."""
    os.setegid(uid)
    os.seteuid(uid)
    try:
        yield
    finally:
        os.seteuid(0)
        os.setegid(0)


@pytest.fixture
def home() -> Iterator[Path]:
    """Give a folder that any user may enter: pytest's own are for one user."""
    with TemporaryDirectory(prefix="pw-") as folder:
        Path(folder).chmod(0o777)
        yield Path(folder)


ROOT_ONLY = pytest.mark.skipif(os.geteuid() != 0, reason="only root may become another user")


@ROOT_ONLY
@pytest.mark.parametrize("name", ["run", "run/bridge"])
@pytest.mark.parametrize(
    ("owner", "bits", "exposed"),
    [(SIM, 0o755, True), (SIM, 0o700, True), (0, 0o777, True), (0, 0o1777, False)],
)
def test_a_folder_in_which_others_could_replace_a_socket_is_refused(
    home: Path, name: str, owner: int, bits: int, exposed: bool
) -> None:
    folder = home / name
    with acting_as(BRIDGE):
        folder.mkdir(parents=True)
    os.chown(folder, owner, owner)
    folder.chmod(bits)
    with acting_as(BRIDGE), ExitStack() as stack:
        if not exposed:
            stack.callback(Claim(home, Party.BRIDGE).close)
            return
        with pytest.raises(ConfigError) as refused:
            Claim(home, Party.BRIDGE)
    assert refused.value.code == "socket_folder_exposed"
    assert str(folder) in refused.value.detail


@ROOT_ONLY
@pytest.mark.parametrize(
    ("listener", "folder", "run", "mode", "believed"),
    [
        (BRIDGE, BRIDGE, 0, 0o755, True),
        (SIM, BRIDGE, 0, 0o755, False),
        (0, BRIDGE, 0, 0o755, True),
        (OPERATOR, OPERATOR, OPERATOR, 0o755, True),
        (BRIDGE, BRIDGE, SIM, 0o755, False),  # who owns run/ may have put any folder there
        (SIM, SIM, SIM, 0o755, False),
        (SIM, SIM, 0, 0o1777, False),  # sticky: who came first made the folder
        (SIM, SIM, 0, 0o3770, False),
        (OPERATOR, OPERATOR, 0, 0o1777, True),
        (0, SIM, 0, 0o1777, True),
    ],
)
def test_a_listener_is_believed_where_it_owns_the_folder_that_nobody_could_replace(
    home: Path, listener: int, folder: int, run: int, mode: int, believed: bool
) -> None:
    path = Endpoints(home).socket(BRIDGE_DOOR)
    path.parent.mkdir(parents=True)
    for place, owner in ((path.parent, folder), (home / "run", run)):
        os.chown(place, owner, owner)
        place.chmod(0o755)
    with closing(socket.socket(socket.AF_UNIX)) as listening:
        path.parent.chmod(0o777)
        with acting_as(listener):
            listening.bind(str(path))
            path.chmod(0o777)
            listening.listen()
        path.parent.chmod(0o755)
        os.chown(home / "run", run, OPERATOR)
        (home / "run").chmod(mode)
        with acting_as(OPERATOR):
            trouble = misplaced_listener(home, BRIDGE_DOOR)
    assert (trouble is None) is believed
    if trouble is not None:
        assert trouble.startswith(f"wrong_listener: user {listener} listens at {path}, expected ")


def test_who_cannot_be_asked_is_not_believed(tmp_path: Path) -> None:
    trouble = misplaced_listener(tmp_path, BRIDGE_DOOR)
    assert trouble is not None
    assert trouble.startswith("wrong_listener: ")
    assert trouble.endswith("can't be told: No such file or directory")


def test_whether_a_door_can_be_reached_is_told(tmp_path: Path) -> None:
    path = Endpoints(tmp_path).socket(BRIDGE_DOOR)
    assert unreachable(tmp_path, BRIDGE_DOOR) == f"{path}: No such file or directory"
    with open_session(Party.BRIDGE, "r1", tmp_path):
        assert unreachable(tmp_path, BRIDGE_DOOR) is None
        assert misplaced_listener(tmp_path, BRIDGE_DOOR) is None


def test_where_the_kernel_does_not_tell_who_listens_nothing_is_checked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delattr("socket.SO_PEERCRED")
    assert misplaced_listener(tmp_path, BRIDGE_DOOR) is None


def test_a_lock_that_cannot_be_opened_is_named(tmp_path: Path) -> None:
    lock = tmp_path / "run" / "bridge" / "bridge.lock"
    lock.mkdir(parents=True)
    with pytest.raises(Unwritable, match=f"home_unwritable.*{lock}"):
        Claim(tmp_path, Party.BRIDGE)


def test_a_socket_is_listened_at_from_the_listeners_start_to_its_end(tmp_path: Path) -> None:
    path = tmp_path / "some.sock"
    assert not is_listening(path)
    with closing(socket.socket(socket.AF_UNIX)) as listener:
        listener.bind(str(path))
        assert not is_listening(path), "bound only"
        listener.listen(0)
        with ExitStack() as stack:
            while fills_the_queue(path, stack):
                pass
            assert is_listening(path), "a listener that takes nobody in, its queue full"
    assert path.is_socket()
    assert not is_listening(path), "what a dead process left"


def fills_the_queue(path: Path, stack: ExitStack) -> bool:
    waiting = stack.enter_context(socket.socket(socket.AF_UNIX))
    waiting.setblocking(False)
    return waiting.connect_ex(str(path)) == 0


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may become another user")
def test_a_socket_that_this_user_may_not_enter_counts_as_silent(home: Path) -> None:
    path = home / "some.sock"
    with closing(socket.socket(socket.AF_UNIX)) as listener:
        listener.bind(str(path))
        path.chmod(0o600)
        listener.listen()
        assert is_listening(path)
        with acting_as(OPERATOR):
            assert not is_listening(path)
