"""Pictures come whole with their header, and are sent only while somebody wants them."""

from __future__ import annotations

from pathlib import Path

from tests.waiting import until
from tests.wire.examples import EXAMPLES
from wire import DecodeFailure, Image, ImageHeader
from wire.keys import CAMERA_COLOR, Party
from wire.session import open_session


def test_the_newest_picture_comes_whole_with_its_header(tmp_path: Path) -> None:
    header = EXAMPLES[ImageHeader]
    assert isinstance(header, ImageHeader)
    with (
        open_session(Party.CAMERA, "r1", tmp_path) as camera,
        open_session(Party.PLANNER, "r1", tmp_path) as planner,
    ):
        mouth, ears = camera.image_publisher(CAMERA_COLOR), planner.image_subscriber(CAMERA_COLOR)
        seen: list[Image | DecodeFailure | None] = []

        def heard() -> bool:
            mouth.put(header, b"picture" * 1000)
            seen.append(ears.newest())
            return seen[-1] is not None

        until(heard)
        assert seen[-1] == Image(header, b"picture" * 1000)


def test_a_picture_is_wanted_while_somebody_listens(tmp_path: Path) -> None:
    with open_session(Party.CAMERA, "r1", tmp_path) as camera:
        mouth = camera.image_publisher(CAMERA_COLOR)
        assert not mouth.has_listener
        with open_session(Party.PLANNER, "r1", tmp_path) as planner:
            ears = planner.image_subscriber(CAMERA_COLOR)
            until(lambda: mouth.has_listener)
            assert ears.newest() is None
            ears.close()
            until(lambda: not mouth.has_listener)
            again = planner.image_subscriber(CAMERA_COLOR)
            until(lambda: mouth.has_listener)
            assert again.newest() is None
        until(lambda: not mouth.has_listener)
