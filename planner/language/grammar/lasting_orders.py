"""Read how long an order lasts: rounds, a time to follow somebody, what is waited for. Pure."""

from __future__ import annotations

from planner.language.grammar.compound_forms import CompoundForms, PartReaders
from planner.language.numbers import seconds
from planner.language.stop import is_stop
from planner.plan import MAX_FOLLOW_S, Follow, Repeat, Step, WaitFor


def read_rounds(said: str, forms: CompoundForms, read: PartReaders) -> tuple[Step, ...] | None:
    """Read how many times an order is to be carried out."""
    found = forms.rounds.fullmatch(said)
    if found is None:
        return None
    times, again = forms.count(found["times"]), read.steps(found["main"].strip(" ,"))
    if times is None or not again:
        return None
    return (Repeat(times=times, steps=again),) if 1 <= times <= 20 else None


def read_follow(said: str, forms: CompoundForms, read: PartReaders) -> tuple[Step, ...] | None:
    """Read a time for which somebody is followed; longer than a step may last it is not read."""
    found = forms.follows.fullmatch(said)
    steps = read.steps(found["main"].strip(" ,")) if found is not None else None
    if found is None or not steps or not isinstance(steps[-1], Follow):
        return None
    far_s = seconds(found["number"], found["unit"])
    if far_s is None or not 0.0 < far_s <= MAX_FOLLOW_S:
        return None
    return (*steps[:-1], steps[-1].model_copy(update={"seconds": far_s}))


def read_wait(said: str, forms: CompoundForms, read: PartReaders) -> tuple[Step, ...] | None:
    """Read whom, which word or which hour is waited for, and what comes before and after it."""
    for pattern in forms.waits:
        found = pattern.fullmatch(said)
        if found is None:
            continue
        parts = found.groupdict()
        wait = _wait(parts, forms)
        before, rest = (
            read.steps(parts[name].strip(" ,")) if parts.get(name) else ()
            for name in ("before", "rest")
        )
        if wait is not None and before is not None and rest is not None:
            return (*before, wait, *rest)
    return None


def _wait(parts: dict[str, str | None], forms: CompoundForms) -> WaitFor | None:
    who, word, time = parts.get("who"), parts.get("word"), parts.get("time")
    if time:
        hour = forms.time(time)
        return WaitFor(time=hour) if hour is not None else None
    if word:  # a stop word stops: nobody could say it for anything else
        return None if is_stop(word) else WaitFor(word=word)
    return WaitFor(object="person") if who else None
