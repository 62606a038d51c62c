"""A socket whose name was removed is found again under it, by whoever connects."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from pons.kept_sockets import KeptSockets
from wire.doors import BRIDGE_DOOR, SENSES_DOOR
from wire.sockets import Endpoints


@pytest.fixture
def home() -> Iterator[Path]:
    with TemporaryDirectory(prefix="pk-") as folder:
        yield Path(folder)


def listening(path: Path) -> socket.socket:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)
    made = socket.socket(socket.AF_UNIX)
    made.bind(str(path))
    made.listen()
    return made


def answered(listener: socket.socket, path: Path) -> bool:
    """Tell whether a connection to a path reaches this very listener."""
    listener.settimeout(2.0)
    with closing(socket.socket(socket.AF_UNIX)) as client:
        try:
            client.connect(str(path))
            connection, _ = listener.accept()
        except OSError:
            return False
        connection.close()
    return True


def test_a_removed_socket_is_brought_back_and_reaches_its_listener(home: Path) -> None:
    path = Endpoints(home).socket(BRIDGE_DOOR)
    kept = KeptSockets(home)
    with closing(listening(path)) as bridge:
        assert not kept.is_kept("bridge")
        assert kept.look_after("bridge") == []
        for _ in range(3):
            path.unlink()
            assert not answered(bridge, path)
            assert kept.look_after("bridge") == [str(path)]
            assert answered(bridge, path)
            assert kept.look_after("bridge") == []


def test_only_what_is_gone_is_brought_back(home: Path) -> None:
    where = Endpoints(home)
    orders, senses = where.socket(BRIDGE_DOOR), where.socket(SENSES_DOOR)
    kept = KeptSockets(home)
    with closing(listening(orders)), closing(listening(senses)):
        kept.look_after("bridge")
        senses.unlink()
        assert kept.look_after("sim") == []
        assert kept.look_after("bridge") == [str(senses)]


def test_after_a_death_nothing_of_it_comes_back(home: Path) -> None:
    """A dead listener's socket in the way would keep the next one from starting."""
    path = Endpoints(home).socket(BRIDGE_DOOR)
    kept = KeptSockets(home)
    with closing(listening(path)):
        kept.look_after("bridge")
    kept.forget("bridge")
    kept.look_after("bridge")
    path.unlink()
    assert kept.look_after("bridge") == []
    assert not path.exists()


def test_the_socket_of_the_next_life_is_the_one_that_is_kept(home: Path) -> None:
    path = Endpoints(home).socket(BRIDGE_DOOR)
    kept = KeptSockets(home)
    with closing(listening(path)):
        kept.look_after("bridge")
    kept.forget("bridge")
    with closing(listening(path)) as second:
        kept.look_after("bridge")
        path.unlink()
        kept.look_after("bridge")
        assert answered(second, path)


def test_a_home_without_sockets_is_left_alone(home: Path) -> None:
    kept = KeptSockets(home)
    assert kept.look_after("bridge") == kept.look_after("planner") == []
    kept.forget("bridge")
    assert list(home.iterdir()) == []
