"""Read what goes on until something is seen or it is that late: looks now and then, a turn. Pure.

Laws: eyes or people's clock tell the end, each as a condition of its own; one by name is no end,
for no eye tells who is who. The rounds are bounded: what never came is told as such at the end.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi

from planner.language.grammar.compound_forms import CompoundForms, PartReaders
from planner.language.numbers import seconds
from planner.plan import ClockTime, If, Look, Repeat, Step, Turn, Wait
from planner.plan.steps import MAX_LOOP_S, MAX_PATIENCE_S, MAX_ROUNDS

ReadLook = Callable[[str], Look | None]
"""Return the look that tells a condition by its yes; None of any other."""
_POLLED = frozenset({"go_to", "look", "patrol", "say", "count"})
_TURN_RAD = pi / 6
"""Less than a camera sees at once."""


def read_poll(
    said: str, forms: CompoundForms, read: PartReaders, look_of: ReadLook
) -> tuple[Step, ...] | None:
    """Read an order that is done again after a while, until something is seen or it is so late."""
    found = next((hit for each in forms.polls if (hit := each.fullmatch(said))), None)
    pause_s = seconds(found["number"], found["unit"]) if found is not None else None
    if found is None or pause_s is None or not 1.0 <= pause_s <= MAX_PATIENCE_S:
        return None
    main = read.steps(found["main"].strip(" ,"))
    if not main or any(step.kind not in _POLLED for step in main):
        return None
    rounds, pause = min(MAX_ROUNDS, int(MAX_LOOP_S // pause_s)), Wait(seconds=pause_s)
    if found["time"]:
        hour = forms.time(found["time"])
        late = ClockTime(after=hour) if hour is not None else None
        return (Repeat(steps=(*main, pause), until=late, times=rounds),) if late else None
    until = found["until"].strip(" ,")
    last = main[-1]
    seen = look_of(until)
    if (seen is None or seen.place is None) and isinstance(last, Look) and last.place is not None:
        seen = look_of(forms.poll_there.format(place=read.name(last.place), until=until))
    if seen is None:
        return None
    if isinstance(last, Look) and last.place == seen.place and len(main) <= len(("go", "look")):
        waits = Repeat(steps=(pause,), until=seen, times=rounds)
        return (If(when=seen, otherwise=(waits,)),)
    return (Repeat(steps=(*main, pause), until=seen, times=rounds),)


def read_spin(said: str, forms: CompoundForms, look_of: ReadLook) -> tuple[Step, ...] | None:
    """Read a turn on the spot until something is seen: once about, part by part."""
    found = forms.spins.fullmatch(said) if forms.spins is not None else None
    until = found["until"].strip(" ,") if found is not None else ""
    seen = look_of(forms.spun_to.format(until=until)) if until else None
    if found is None or seen is None or seen.place is not None:
        return None
    turn = Turn(angle_rad=-_TURN_RAD if found["right"] else _TURN_RAD)
    return (Repeat(steps=(turn,), until=seen, times=round(2 * pi / _TURN_RAD)),)
