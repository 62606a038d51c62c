"""The camera on the wire is heard with both ears or with none."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, cast

import pytest

from planner.perception.frame_source import WireCamera
from wire import keys as k
from wire.keys import Key
from wire.session import Session


@dataclass
class Ear:
    key: Key[Any]
    closed: bool = False

    def close(self) -> None:
        self.closed = True


@dataclass
class FakeSession:
    lost: Key[Any] | None = None
    ears: list[Ear] = field(default_factory=list)

    def image_subscriber(self, key: Key[Any]) -> Ear:
        if key is self.lost:
            raise ConnectionError(key.path)
        self.ears.append(Ear(key))
        return self.ears[-1]


def test_what_listens_is_closed() -> None:
    session = FakeSession()
    camera = WireCamera(cast("Session", session))
    camera.listen(True)
    assert [ear.key for ear in session.ears] == [k.CAMERA_DEPTH, k.CAMERA_COLOR]
    camera.listen(False)
    assert all(ear.closed for ear in session.ears)
    assert camera.color() is None is camera.depth()


def test_with_one_ear_lost_the_other_is_closed() -> None:
    session = FakeSession(lost=k.CAMERA_COLOR)
    camera = WireCamera(cast("Session", session))
    with pytest.raises(ConnectionError):
        camera.listen(True)
    assert [(ear.key, ear.closed) for ear in session.ears] == [(k.CAMERA_DEPTH, True)]
    assert camera.color() is None
