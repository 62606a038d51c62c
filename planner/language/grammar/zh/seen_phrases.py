"""Own the Chinese ways to ask for a look and, in the same breath, for what hangs on its answer.

Pure text to text, on a normalised sentence. 看看大门开着没有,开着就叫我 is the look: its own answer
tells the person. Law: only a report to the person hangs on a state that no eye is sure of; any
other order upon it stays, and is refused as a condition.
"""

from __future__ import annotations

import re

from planner.language.grammar.zh.drive_phrases import LOOKS

_LEAD = r"(?:请|麻烦|帮我|给我|你|您|先|快)*"
_STATE = r"(?:反锁|上锁|[关开锁亮灭熄停拔盖睡醒])"
_SO = r"(?:好|上|住|掉|紧|严)?"
_TELL = (
    r"(?:你|就|马上|赶紧|立刻|再|要)*(?:(?:告诉|通知|叫|喊|提醒)我们?|[跟和给对向]我们?[说讲])"
    r"(?:一声|一下|声)?"
)
_STATE_THEN_TELL = re.compile(
    rf"^(?P<q>{_LEAD}(?:去)?{LOOKS}[^,。;就有几谁]{{1,12}}?{_STATE}{_SO}[着了])(?:没有?|吗)?"
    rf"(?:[,。?]*(?:要是|如果|万一)?(?:还|没有?|不)*(?:{_STATE}{_SO}[着了]?|有|是)的?(?:的话)?)?,?{_TELL}$"
)
_STATE_OR_NOT = re.compile(rf"{_STATE}{_SO}[着了](?:没有?|吗)[,。?]")
_THEN = re.compile(r"[着了](?:的话)?(?:你|就)")
_SEEN_THEN = re.compile(
    rf"^{_LEAD}(?:去)?{LOOKS}(?P<p>[^,。;有没在就]{{1,8}}?)(?P<h>没有|没|有)(?P<t>[^,。;就没]{{1,6}}?)(?:的话)?,?(?:你)?就(?P<r>.+)$"
)


def looks_first(said: str) -> str:
    """Return a look that something hangs on as the look alone, or as a condition in full."""
    state = _STATE_THEN_TELL.fullmatch(said)
    if state is not None and (_STATE_OR_NOT.search(said) or _THEN.search(said)):
        return f"{state['q']}没有"
    seen = _SEEN_THEN.fullmatch(said)
    if seen is not None and not seen["t"].endswith(("没", "吗", "了", "着")):
        return f"如果{seen['p']}{seen['h']}{seen['t']},就{seen['r']}"
    return said
