"""Hold a page's stick in a lockstep world: the page's frames, the planner's judge, the bridge."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

from lockstep.latencies import TICK_S
from planner.api.hand import Hand, HandFrame, is_taken, relay
from planner.robot_service import LinkedRobot

if TYPE_CHECKING:
    from tools.lockstep.together import LockstepWorld

BEAT_TICKS = FRAME_TICKS = 5
IDLE_TICKS = 25
"""As the page sends them: 20 frames a second while held, 4 while not."""


class PageHand:
    """Be one page with a stick, some ticks of network away."""

    def __init__(
        self, world: LockstepWorld, robot: LinkedRobot, source: str = "page-1", way_ticks: int = 2
    ) -> None:
        """Open the socket; ``robot`` is the planner's, one for all pages."""
        self.forward = self.left = 0.0
        self.held = False
        self.lost = False
        """The network carries nothing any more, and neither end knows."""
        self.hand = Hand()
        self._world, self._robot, self._source, self._way = world, robot, source, way_ticks
        self._seq = self._beat = 0
        self._heard_tick = world.tick_count
        self._down: deque[tuple[int, int]] = deque()
        self._up: deque[tuple[int, HandFrame]] = deque()

    def tick(self) -> None:
        """Do what page and planner do before the world's next tick."""
        tick = self._world.tick_count
        if tick % BEAT_TICKS == 0:
            self._down.append((tick + self._way, self.hand.next_beat(tick * TICK_S)))
        while self._down and self._down[0][0] <= tick:
            self._beat = self._down.popleft()[1]
        if tick % (FRAME_TICKS if self.held else IDLE_TICKS) == 0:
            self.send()
        while self._up and self._up[0][0] <= tick:
            self._hear(self._up.popleft()[1])
            self._heard_tick = tick
        if (tick - self._heard_tick) * TICK_S > self.hand.patience_s:
            relay(self._robot, self._source, "", self.hand.refuse("hand_late"))

    def send(self) -> None:
        """Send a frame now, as a page does at once when the stick is let go."""
        if self.lost:
            return
        self._seq += 1
        frame = HandFrame(
            seq=self._seq,
            beat=self._beat,
            forward=self.forward if self.held else 0.0,
            left=self.left if self.held else 0.0,
            held=self.held,
        )
        self._up.append((self._world.tick_count + self._way, frame))

    def let_go(self) -> None:
        """Let the stick go."""
        self.held = False
        self.send()

    def close(self) -> None:
        """Close the socket, as the planner hears it."""
        self.lost = True
        self._up.clear()
        relay(self._robot, self._source, "", self.hand.let_go())

    def _hear(self, frame: HandFrame) -> None:
        taken = is_taken(self._robot, self._source)
        order = self.hand.hear(frame, self._world.tick_count * TICK_S, is_taken=taken)
        relay(self._robot, self._source, self._source, order)
