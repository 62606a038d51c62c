"""Take pictures in, newest only, and judge them: fresh, paired with their depth, not one again.

A picture's age is what our own clock has seen pass since it came, or what its stamp says where that
is older and on our clock; no stamp makes it younger. Knows the wire's pictures; opens none.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

from planner.vision.ports import Picture
from wire import Image, Rejected
from wire import keys as k

if TYPE_CHECKING:
    from wire.session import Session

OLDEST_S = 0.5
"""An older picture is not thought upon."""
SILENT_S = 1.0
FROZEN_AFTER = 5
"""Pictures with new stamps, each the bytes of the one before: no sensor is so free of noise."""
SAME_CLOCK_S = 60.0
"""A stamp farther from our clock is of another host's: it tells nothing here."""
DEPTH_WAIT_S = 0.03
AS_GOOD_S = 0.25
"""A picture with depth is handed out rather than one newer by so little without."""
DEPTH_GONE_S = 2.0
"""Without depth for so long, pictures no longer wait for theirs."""


class Camera(Protocol):
    """Hand out pictures that were not taken yet."""

    def color(self) -> Image | Rejected | None: ...

    def depth(self) -> Image | Rejected | None: ...


class WireCamera:
    """Hear the camera on the wire."""

    def __init__(self, session: Session) -> None:
        self._color = session.image_subscriber(k.CAMERA_COLOR)
        self._depth = session.image_subscriber(k.CAMERA_DEPTH)

    def color(self) -> Image | Rejected | None:
        return self._color.newest()

    def depth(self) -> Image | Rejected | None:
        return self._depth.newest()


@dataclass(frozen=True, slots=True)
class _Heard:
    """Hold the newest picture with when it came."""

    picture: Picture
    heard_s: float
    offered: bool = False
    """It was handed out, or counted as skipped."""


class Pictures:
    """Keep the newest picture and what is to be said of its kind."""

    def __init__(self, camera: Camera, rate_hz: float = 10.0) -> None:
        """Take pictures of a camera that is to send so many a second."""
        self._camera = camera
        self._silent_s, self._lies_s = max(SILENT_S, 2.5 / rate_hz), 0.5 / rate_hz
        self._heard: _Heard | None = None
        self._depth: tuple[Image, float] | None = None
        self._whole: Picture | None = None
        self._repeats = 0
        self._fresh_s = float("-inf")
        self.skipped: Counter[str] = Counter()
        """Pictures that were not thought upon, by reason."""
        self.came = 0

    @property
    def newest(self) -> Picture | None:
        """Return the newest picture, however old; one with its depth where that is as good."""
        heard, whole = self._heard, self._whole
        if heard is None or whole is None:
            return None if heard is None else heard.picture
        return whole if heard.picture.taken_s - whole.taken_s <= AS_GOOD_S else heard.picture

    def blind(self, now_s: float) -> str | None:
        """Say why there is nothing to look at, or None."""
        if not now_s - self._fresh_s <= self._silent_s:
            return "camera_silent"
        return "camera_frozen" if self._repeats >= FROZEN_AFTER else None

    def poll(self, now_s: float, *, busy: bool) -> None:
        """Take what came. ``busy``: a look is under way, which is why a picture may be passed."""
        depth = self._camera.depth()
        if isinstance(depth, Image):
            self._depth = (depth, now_s)
        elif depth is not None:
            self.skipped["depth_malformed"] += 1
        color = self._camera.color()
        if isinstance(color, Image):
            self._take(color, now_s, busy=busy)
        elif color is not None:
            self.skipped["malformed"] += 1
        self._join()

    def ready(self, now_s: float) -> Picture | None:
        """Hand out the newest picture, once, if it is worth thinking upon.

        One that lies here for half a period already is left: the next comes sooner than that one
        is as old again.
        """
        heard = self._heard
        if heard is None or heard.offered or self._repeats >= FROZEN_AFTER:
            return None
        if not now_s - heard.heard_s <= self._lies_s:
            return None
        if not now_s - heard.picture.taken_s <= OLDEST_S:
            self._pass("stale")
            return None
        depth = self._depth_of(heard.picture.color)
        if depth is None and self._awaits_depth(now_s, heard):
            return None
        picture = replace(heard.picture, depth=depth)
        self._heard = replace(heard, picture=picture, offered=True)
        return picture

    def _join(self) -> None:
        """Put the newest picture and its depth together, once both are there."""
        heard, whole = self._heard, self._whole
        if heard is None or (whole is not None and whole.color is heard.picture.color):
            return
        depth = self._depth_of(heard.picture.color)
        if depth is not None:
            self._whole = replace(heard.picture, depth=depth)

    def _take(self, color: Image, now_s: float, *, busy: bool) -> None:
        before = self._heard
        if before is not None and not before.offered:
            self._pass("busy" if busy else "rate")
        header = color.header
        old = None if before is None else before.picture.color
        if old is not None and (old.header.boot_id, old.header.seq) == (header.boot_id, header.seq):
            self.skipped["repeated"] += 1
            return
        self.came += 1
        again = old is not None and old.data == color.data
        self._repeats = self._repeats + 1 if again else 0
        stamp_age_s = now_s - header.stamp_s
        on_our_clock = 0.0 <= stamp_age_s <= SAME_CLOCK_S
        taken_s = header.stamp_s if on_our_clock else now_s
        self._heard = _Heard(Picture(color, None, taken_s), now_s)
        if now_s - taken_s <= OLDEST_S:
            self._fresh_s = now_s
        if self._repeats >= FROZEN_AFTER:
            self._pass("frozen")

    def _pass(self, reason: str) -> None:
        """Count the newest picture as passed over."""
        if self._heard is not None and not self._heard.offered:
            self.skipped[reason] += 1
            self._heard = replace(self._heard, offered=True)

    def _depth_of(self, color: Image) -> Image | None:
        if self._depth is None:
            return None
        depth = self._depth[0]
        same = (depth.header.boot_id, depth.header.seq) == (color.header.boot_id, color.header.seq)
        return depth if same else None

    def _awaits_depth(self, now_s: float, heard: _Heard) -> bool:
        """Tell whether the picture's depth may still come."""
        speaks = self._depth is not None and now_s - self._depth[1] <= DEPTH_GONE_S
        return speaks and now_s - heard.heard_s <= DEPTH_WAIT_S
