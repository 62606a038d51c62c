"""Decide when the eyes look, take pictures in, newest only, and judge them.

They look at their full rate while a step, a page or a question needs them, now and then else: twice
a second while the robot moves, for what is passed, every other second while it stands, and after a
minute of that every five minutes, so that the detector's process may rest. After a failure of the
detector they rest. A picture is fresh, paired with its depth, and not one again. Its age is what
our own clock has seen pass since it came, or what its stamp says where that is older and on our
clock; no stamp makes it younger. Knows the wire's pictures; opens none.
"""

from __future__ import annotations

from collections import Counter
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

from planner.perception.interfaces import Picture
from wire import DecodeFailure, Image
from wire import keys as k

if TYPE_CHECKING:
    from collections.abc import Iterator

    from wire.image_transport import ImageSubscriber
    from wire.session import Session

POLL_S, IDLE_POLL_S = 0.01, 0.03
PASSING_HZ, STANDING_HZ, RESTING_HZ = 2.0, 0.5, 1 / 300
"""Nobody asks, yet what is passed is remembered, and what comes before a robot that stands."""
RESTS_AFTER_S = 60.0
"""Of standing where nobody needs eyes."""
EARLY_S = 0.02
"""A picture that comes so much before its time is taken: cameras and clocks jitter."""
SHOWN_S = 3.0
"""A page that asked for the picture is taken to look on for so long."""
REST_S = 1.0
"""After a failure of the detector."""


class Attention:
    """Keep the eyes' users, since when they look and until when they rest."""

    def __init__(self, rate_hz: float, camera_hz: float) -> None:
        """Take the rate of looks while somebody needs eyes, and that of the camera."""
        self._rate_hz = rate_hz
        self._idle_poll_s = min(IDLE_POLL_S, max(POLL_S, 0.5 / camera_hz))
        self._wanted: set[str] = set()
        self._wide: set[str] = set()
        self._waiting = 0
        self._shown_s = self._began_s = self._rest_until_s = float("-inf")
        self._awake_s: float | None = None

    def attend(self, who: str, wanted: bool, *, wide: bool = False) -> None:
        """Take down that somebody needs eyes now, or no longer; ``wide``: for all kinds."""
        (self._wanted.add if wanted else self._wanted.discard)(who)
        (self._wide.add if wanted and wide else self._wide.discard)(who)

    @property
    def wide(self) -> bool:
        """Tell whether somebody needs wide looks."""
        return bool(self._wide)

    def note_shown(self, now_s: float) -> None:
        """Take down that a page was shown the picture."""
        self._shown_s = now_s

    @contextmanager
    def waiting(self) -> Iterator[None]:
        """Take down that somebody waits for a picture, as long as this lasts."""
        self._waiting += 1
        try:
            yield
        finally:
            self._waiting -= 1

    def began(self, now_s: float) -> None:
        """Take down that a look has begun."""
        self._began_s = now_s

    def rest(self, now_s: float) -> None:
        """Begin no look for a while."""
        self._rest_until_s = now_s + REST_S

    def poll_s(self, now_s: float) -> float:
        """Return how long to wait between two rounds [s]."""
        return POLL_S if self._is_needed(now_s) else self._idle_poll_s

    def due(self, now_s: float, *, moving: bool) -> bool:
        """Tell whether it is time for a look."""
        if moving or self._awake_s is None or self._is_needed(now_s):
            self._awake_s = now_s
        rests = now_s - self._awake_s > RESTS_AFTER_S
        idle_hz = PASSING_HZ if moving else RESTING_HZ if rests else STANDING_HZ
        rate_hz = min(self._rate_hz if self._is_needed(now_s) else idle_hz, self._rate_hz)
        return now_s >= self._rest_until_s and now_s - self._began_s >= 1.0 / rate_hz - EARLY_S

    def listens(self, now_s: float, *, glance: bool) -> bool:
        """Tell whether pictures are wanted: by somebody, or for the ``glance`` that is due."""
        return glance or self._waiting > 0 or self._is_needed(now_s)

    def _is_needed(self, now_s: float) -> bool:
        return bool(self._wanted) or now_s - self._shown_s <= SHOWN_S


OLDEST_S = 0.5
"""An older picture is not thought upon."""
SILENT_S = 1.0
FROZEN_AFTER = 5
"""Pictures with new stamps, each the bytes of the one before: no sensor is so free of noise. After
so many the camera is called frozen; none of them is thought upon."""
SAME_CLOCK_S = 60.0
"""A stamp farther from our clock is of another host's: it tells nothing here."""
DEPTH_WAIT_S = 0.05
"""Longest time that depth may lag behind its picture."""
LIES_S = 0.035
"""However fast the camera, a picture may lie so long: nobody asks more often when at rest."""
AS_GOOD_S = 0.25
"""A picture with depth is handed out rather than one newer by so little without."""
FIRST_S = 1.0
"""Who wants a picture waits so long for the first of a camera that nobody listened to."""
DEPTH_GONE_S = 2.0
"""Without depth for so long, pictures no longer wait for theirs."""


class Camera(Protocol):
    """Hand out pictures that were not taken yet."""

    def listen(self, wanted: bool) -> None:
        """Say whether pictures are wanted; a camera may rest while nobody wants any."""

    def color(self) -> Image | DecodeFailure | None: ...

    def depth(self) -> Image | DecodeFailure | None: ...


class WireCamera:
    """Hear the camera on the wire, while somebody wants pictures: it draws for its hearers only."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._ears: tuple[ImageSubscriber, ImageSubscriber] | None = None

    def listen(self, wanted: bool) -> None:
        ears, self._ears = self._ears, None
        for ear in ears or ():
            ear.close()
        if wanted:
            hear = self._session.image_subscriber
            with ExitStack() as stack:
                depth = hear(k.CAMERA_DEPTH)  # first: no picture comes without its depth
                stack.callback(depth.close)
                self._ears = hear(k.CAMERA_COLOR), depth
                stack.pop_all()

    def color(self) -> Image | DecodeFailure | None:
        return None if self._ears is None else self._ears[0].newest()

    def depth(self) -> Image | DecodeFailure | None:
        return None if self._ears is None else self._ears[1].newest()


@dataclass(frozen=True, slots=True)
class _PendingPicture:
    """Hold a picture that was neither handed out nor passed over."""

    picture: Picture
    heard_s: float
    whole_s: float | None = None
    """When its depth was there too."""


class Pictures:
    """Keep the newest pictures and the report on their kind."""

    def __init__(self, camera: Camera, rate_hz: float = 10.0) -> None:
        """Take pictures of a camera that is to send so many a second."""
        self._camera = camera
        self._silent_s, self._lies_s = max(SILENT_S, 2.5 / rate_hz), max(LIES_S, 0.5 / rate_hz)
        self._heard: list[_PendingPicture] = []
        """The newest last: those before it wait for their depth, which lags behind."""
        self._depth: tuple[Image, float] | None = None
        self._last: Picture | None = None
        self._whole: Picture | None = None
        self._before: Image | None = None
        """What came last, whenever that was."""
        self._repeats = 0
        self._since_s: float | None = None
        """When listening began; None while nobody wants pictures."""
        self._first_s: float | None = None
        self._fresh_s = float("-inf")
        self.skipped: Counter[str] = Counter()
        """Pictures that were not thought upon, by reason."""

    def listen(self, wanted: bool, now_s: float) -> None:
        """Begin or end to listen. What came before only tells a frozen camera."""
        if wanted != (self._since_s is not None):
            self._camera.listen(wanted)
            self._since_s, self._fresh_s = now_s if wanted else None, now_s
            self._heard = []
            self._depth = self._last = self._whole = self._first_s = None

    def is_settled(self, now_s: float) -> bool:
        """Return whether the camera's kind is known by now: no use in waiting longer."""
        if self._since_s is None or now_s - self._since_s >= FIRST_S or self._whole is not None:
            return True
        return self._first_s is not None and now_s - self._first_s >= DEPTH_WAIT_S

    @property
    def newest(self) -> Picture | None:
        """Return the newest picture since listening began; with its depth where that is as good."""
        last, whole = self._last, self._whole
        if last is None or whole is None:
            return last
        return whole if last.taken_s - whole.taken_s <= AS_GOOD_S else last

    def blind(self, now_s: float) -> str | None:
        """Say why there is nothing to look at, or None. Whoever does not listen has no reason."""
        if self._since_s is None:
            return None
        if not now_s - self._fresh_s <= self._silent_s:
            return "camera_silent"
        return "camera_frozen" if self._repeats >= FROZEN_AFTER else None

    def poll(self, now_s: float, *, busy: bool) -> None:
        """Take the messages. ``busy``: a look is under way, so a picture may be passed."""
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
        self._join(now_s)

    def ready(self, now_s: float) -> Picture | None:
        """Hand out, once, the newest picture that is whole, if it is worth thinking upon.

        One that lies here for half a period already is left: the next comes sooner than that one
        is as old again.
        """
        ripe = [number for number, one in enumerate(self._heard) if self._ripe(one, now_s)]
        if not ripe:
            return None
        newest = self._heard[ripe[-1]]
        if not now_s - self._ripe_s(newest, now_s) <= self._lies_s:
            return None
        self.skipped["rate"] += ripe[-1]
        self._heard = self._heard[ripe[-1] + 1 :]
        if not now_s - newest.picture.taken_s <= OLDEST_S:
            self.skipped["stale"] += 1
            return None
        return newest.picture

    def _join(self, now_s: float) -> None:
        """Put the newest depth and its picture together, once both are there."""
        for number, heard in enumerate(self._heard):
            depth = self._depth_of(heard.picture.color)
            if depth is not None and heard.whole_s is None:
                self._whole = replace(heard.picture, depth=depth)
                self._heard[number] = replace(heard, picture=self._whole, whole_s=now_s)

    def _take(self, color: Image, now_s: float, *, busy: bool) -> None:
        header = color.header
        old, self._before = self._before, color
        if old is not None and (old.header.boot_id, old.header.seq) == (header.boot_id, header.seq):
            self.skipped["repeated"] += 1
            return
        self._pass("busy" if busy else "rate", now_s)
        self._first_s = now_s if self._first_s is None else self._first_s
        again = old is not None and old.data == color.data
        self._repeats = self._repeats + 1 if again else 0
        if again:
            self._count_again(color, now_s)
            return
        self._last = Picture(color, None, _taken_s(color, now_s))
        if now_s - self._last.taken_s <= OLDEST_S:
            self._fresh_s = now_s
        self._heard.append(_PendingPicture(self._last, now_s))

    def _count_again(self, color: Image, now_s: float) -> None:
        """Pass over a picture that repeats the one before, at any stamp."""
        self.skipped["frozen"] += 1
        if now_s - _taken_s(color, now_s) <= OLDEST_S:
            self._fresh_s = now_s  # it is frozen, not silent
        if self._repeats >= FROZEN_AFTER:
            self.skipped["frozen"] += len(self._heard)
            self._heard = []

    def _pass(self, reason: str, now_s: float) -> None:
        """Pass over pictures that could have been handed out; one waiting for its depth stays."""
        waiting = [heard for heard in self._heard if not self._ripe(heard, now_s)]
        self.skipped[reason] += len(self._heard) - len(waiting)
        self._heard = waiting

    def _depth_of(self, color: Image) -> Image | None:
        if self._depth is None:
            return None
        depth = self._depth[0]
        same = (depth.header.boot_id, depth.header.seq) == (color.header.boot_id, color.header.seq)
        return depth if same else None

    def _ripe(self, heard: _PendingPicture, now_s: float) -> bool:
        """Tell whether a picture can be handed out: its depth is there, or comes no more."""
        return now_s >= self._ripe_s(heard, now_s)

    def _ripe_s(self, heard: _PendingPicture, now_s: float) -> float:
        if heard.whole_s is not None:
            return heard.whole_s
        if self._depth is None:
            speaks = heard.heard_s == self._first_s  # the first waits for it, whoever sends none
        else:
            speaks = now_s - self._depth[1] <= DEPTH_GONE_S
        return heard.heard_s + (DEPTH_WAIT_S if speaks else 0.0)


def _taken_s(color: Image, now_s: float) -> float:
    """Return when a picture was taken: now, if its stamp is of another clock or the future."""
    stamp_s = color.header.stamp_s
    return stamp_s if 0.0 <= now_s - stamp_s <= SAME_CLOCK_S else now_s
