"""Read how long an order lasts: rounds, whom to follow how long, a search, a wait. Pure.

Laws: no eye tells who is who, so one who is waited for by name is anybody who comes, and hears the
name; whatever else is to be done then is not read, for it may be somebody else. What ends
somebody's being followed is a word that stops the robot, or is asked about as a stop.
"""

from __future__ import annotations

from planner.language.grammar.branch_orders import call_by_name, tell_them
from planner.language.grammar.compound_forms import CompoundForms, PartReaders
from planner.language.numbers import seconds
from planner.language.sentence import parse
from planner.language.stop import StopReading, is_stop
from planner.plan import MAX_FOLLOW_S, Ask, Find, Follow, GoTo, Repeat, Say, Step, WaitFor


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


def read_follow_until(
    said: str, forms: CompoundForms, read: PartReaders
) -> tuple[Step, ...] | None:
    """Read whom to follow until the robot is told to stop, for as long as a step may last."""
    found = forms.follows_until.fullmatch(said) if forms.follows_until is not None else None
    if found is None or not _ends_it(found["word"].strip(" ,.!\"'"), forms):
        return None
    steps = read.steps(found["main"].strip(" ,"))
    if not steps or not isinstance(steps[-1], Follow) or steps[-1].seconds is not None:
        return None
    return (*steps[:-1], steps[-1].model_copy(update={"seconds": MAX_FOLLOW_S}))


def _ends_it(word: str, forms: CompoundForms) -> bool:
    if forms.ends is not None and forms.ends.fullmatch(word):
        return True
    return parse(word).reading is not StopReading.NONE


def read_hunt(said: str, forms: CompoundForms, read: PartReaders) -> tuple[Step, ...] | None:
    """Read a search that goes on "until you find" it: a search goes through the rooms by itself."""
    for pattern in forms.hunts:
        found = pattern.fullmatch(said)
        if found is None:
            continue
        what = _find_hunted(found["what"].strip(), (found["for"] or "").strip(), forms)
        at = f" {found['at'].strip()}" if found["at"] else ""
        search = read.steps(forms.find.format(what=what, at=at)) if what is not None else None
        if not search or not _is_search(search, placed=bool(at)):
            continue
        then = forms.find_and.format(what=what, at=at, rest=(found["rest"] or "").strip(" ,"))
        steps = read.steps(then) if found["rest"] else search
        before = read.steps(found["before"].strip(" ,")) if found["before"] else ()
        if steps and before is not None and steps[: len(search)] == search:
            return (*before, *steps)
    return None


def _find_hunted(what: str, sought: str, forms: CompoundForms) -> str | None:
    """Return what is searched, which both ends of the sentence may name; None where none does."""
    names = [
        name
        for name in (what, sought)
        if name and not (forms.any_hunted is not None and forms.any_hunted.fullmatch(name))
    ]
    return names[0] if len(set(names)) == 1 else None


def _is_search(steps: tuple[Step, ...], *, placed: bool) -> bool:
    last = steps[-1]
    if not isinstance(last, Find) or (last.place is None) is placed:
        return False
    return all(isinstance(step, GoTo | Find) for step in steps)


def read_wait(said: str, forms: CompoundForms, read: PartReaders) -> tuple[Step, ...] | None:
    """Read whom, which word or which hour is waited for, and what comes before and after it."""
    for pattern in forms.waits:
        found = pattern.fullmatch(said)
        if found is None:
            continue
        parts = found.groupdict()
        name = _who_comes(parts.get("named"), forms, read)
        wait = _wait(parts, forms) if name is None else WaitFor(object="person")
        at = parts.get("at")
        there = read.steps(forms.wait_at.format(at=at.strip())) if at else ()
        first, then = parts.get("before"), parts.get("rest")
        before = read.steps(first.strip(" ,")) if first else ()
        rest = read.steps(tell_them(then, forms).strip(" ,")) if then else ()
        if wait is None or there is None or before is None or rest is None:
            continue
        if at and not (there and all(isinstance(step, GoTo) for step in there)):
            continue
        if name is not None:
            if not all(isinstance(step, Say | Ask) for step in rest):
                continue
            rest = call_by_name(rest, name, forms)
        return (*before, *there, wait, *rest)
    return None


def _who_comes(words: str | None, forms: CompoundForms, read: PartReaders) -> str | None:
    """Return how one is called who is waited for: by name, or by what they are."""
    if not words:
        return None
    bare = forms.mine.sub("", words) if forms.mine is not None else words
    name = read.person(words) or read.person(bare)
    if name is None and not (forms.folk is not None and forms.folk.fullmatch(bare)):
        return None
    name = name or bare
    return name[:1].upper() + name[1:]


def _wait(parts: dict[str, str | None], forms: CompoundForms) -> WaitFor | None:
    who, word, time = parts.get("who"), parts.get("word"), parts.get("time")
    if time:
        hour = forms.time(time)
        return WaitFor(time=hour) if hour is not None else None
    if word:  # a stop word stops: nobody could say it for anything else
        return None if is_stop(word) else WaitFor(word=word)
    return WaitFor(object="person") if who else None
