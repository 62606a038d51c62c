"""Keep what a model wrote about the newest goals, for an owner whom a plan surprised.

In this process's memory and nowhere else: a person's words and words out of a picture may stand in
a reply, and they must not outlive the process. Nothing is done by what is kept here. Keys are cut
out of it, those that are set and whatever looks like one. Knows no model and no network.
"""

from __future__ import annotations

import re
import unicodedata
from collections import OrderedDict, deque
from collections.abc import Callable, Iterable
from datetime import UTC, datetime
from enum import StrEnum

from planner.plan import Frozen

MOST_REPLIES = 8
"""Of one goal, the newest."""
MOST_CHARACTERS = 4_000
"""Of one reply, the mark of the cut included."""
MOST_READ = 65_536
"""Of a reply are cleaned, so that a server's megabyte can't hold up who waits for a plan."""
CUT_OFF = " … [cut]"
KEY_CUT = "[key cut]"
MIN_KEY = 6
"""Characters; a shorter key protects nothing, and cutting it would break every reply."""
_UNSEEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})
_LOOKS_LIKE_A_KEY = re.compile(
    r"(?i:\bbearer\s+[a-z0-9._~+/=-]{8,})"
    r"|(?<![A-Za-z0-9])sk-[A-Za-z0-9_-]{6,}"
    r"|[A-Za-z0-9+/_-]{32,}={0,2}"
)
_ESCAPED = re.compile(r"\\(?:u00([2-7][0-9a-fA-F])|(/))")
_BROKEN_OFF = re.compile(r"[!-~]{1,8192}\Z")


class ReplyTurn(StrEnum):
    """Name what a model was asked for."""

    PLAN = "plan"
    """The first plan of a goal, or one after an answer to its question."""
    REPAIR = "repair"
    """The reply before it could not be used."""
    DECIDE = "decide"
    """How to go on, from what the steps so far have shown."""
    REPLAN = "replan"
    """Another plan after a step that failed."""
    LOOK = "look"
    """What is in a picture."""


class KeptReply(Frozen):
    """Show one reply of a model: plain text, without its keys."""

    at: datetime
    model: str
    turn: ReplyTurn
    text: str
    cut: bool
    """Its end was left out."""
    used: bool
    """It could be read as what was asked for; else it was sent back, given up, or left aside for
    doing something else than the thought that was shown no words of a picture."""


class GoalReplies(Frozen):
    """Show what a model wrote about one goal, oldest first."""

    kept: int
    """How many goals' replies are kept at most, the newest; 0: ``keep_replies`` is not set."""
    replies: tuple[KeptReply, ...] = ()


def read_clock() -> datetime:
    """Return the time of a reply."""
    return datetime.now(UTC)


class ReplyCollector:
    """Collect replies of a bounded number of goals."""

    def __init__(
        self, most_goals: int, keys: Iterable[str] = (), clock: Callable[[], datetime] = read_clock
    ) -> None:
        """Begin empty.

        Args:
            most_goals: goals whose replies are kept, those that a model wrote about last; 0: none.
            keys: of this robot's services; longest first, so that none is left as another's rest.
            clock: the time of a reply.
        """
        self._most_goals, self._clock = most_goals, clock
        whole = {key for key in keys if len(key) >= MIN_KEY}
        self._keys = sorted(whole, key=len, reverse=True)
        self._replies: OrderedDict[str, deque[KeptReply]] = OrderedDict()

    def keep(self, goal: str, text: str, *, model: str, turn: ReplyTurn, used: bool) -> None:
        """Keep one reply, where any is kept and a goal is thought about."""
        if not self._most_goals or not goal:
            return
        shown, cut = self._clean(text)
        reply = KeptReply(at=self._clock(), model=model, turn=turn, text=shown, cut=cut, used=used)
        self._replies.setdefault(goal, deque(maxlen=MOST_REPLIES)).append(reply)
        self._replies.move_to_end(goal)
        while len(self._replies) > self._most_goals:
            self._replies.popitem(last=False)

    def replies_of(self, goal: str) -> GoalReplies:
        """Return what is kept of a goal."""
        return GoalReplies(kept=self._most_goals, replies=tuple(self._replies.get(goal, ())))

    def _clean(self, text: str) -> tuple[str, bool]:
        """Return a reply as a person is shown it, and whether its end was left out."""
        seen = _visible(text[:MOST_READ])
        begun = len(text) > MOST_READ
        if begun:  # what stands at the edge may be the beginning of a key
            seen = _BROKEN_OFF.sub("", seen)
        plain = self._without_keys(seen)
        if not begun and len(plain) <= MOST_CHARACTERS:
            return plain, False
        return plain[: MOST_CHARACTERS - len(CUT_OFF)] + CUT_OFF, True

    def _without_keys(self, text: str) -> str:
        """Return a text without keys, which may stand in it as JSON escapes them."""
        spelt = _ESCAPED.sub(lambda found: found[2] or chr(int(found[1], 16)), text)
        plain = self._cut_keys(spelt)
        return self._cut_keys(text) if plain == spelt else plain

    def _cut_keys(self, text: str) -> str:
        for key in self._keys:
            text = text.replace(key, KEY_CUT)
            for size in range(len(key) - 1, MIN_KEY - 1, -1):  # a model is cut off anywhere
                if text.endswith(key[:size]):
                    text = text[:-size] + KEY_CUT
                    break
        return _LOOKS_LIKE_A_KEY.sub(KEY_CUT, text)


def _visible(text: str) -> str:
    """Return a text without control, hidden, turning or broken characters; its lines stay."""
    lines = text.replace("\r\n", "\n").replace("\r", "\n").replace("\t", "  ")
    return "".join(
        each for each in lines if each == "\n" or unicodedata.category(each) not in _UNSEEN
    ).strip()
