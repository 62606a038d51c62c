"""Write steps as a sentence that reads back as the same steps: what a button of a question says."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees

from planner.language.catalogue import join, say
from planner.language.grammar.lexicon import Lexicon
from planner.plan import (
    Bilingual,
    ComeBack,
    Count,
    Find,
    Follow,
    GoTo,
    Language,
    Move,
    Option,
    Patrol,
    ReturnHome,
    Say,
    Step,
    Turn,
    Vocabulary,
    Wait,
    same,
)


def sentence(steps: Sequence[Step], vocabulary: Vocabulary, lexicon: Lexicon) -> Bilingual:
    """Return the order of these steps in both languages."""
    kept = [step for at, step in enumerate(steps) if not _goes_without_saying(steps, at)]
    said = [_step(step, vocabulary, lexicon) for step in kept]
    return join(said, "joint.then")


def _goes_without_saying(steps: Sequence[Step], at: int) -> bool:
    """Tell whether a drive is only the way to what is done next in the same place."""
    step, after = steps[at], steps[at + 1] if at + 1 < len(steps) else None
    return isinstance(step, GoTo) and isinstance(after, Find | Count) and after.place == step.place


def option(
    steps: Sequence[Step], vocabulary: Vocabulary, lexicon: Lexicon, language: Language
) -> Option:
    """Return a button that stands for these steps."""
    label = sentence(steps, vocabulary, lexicon)
    return Option(label=label, text=label.of(language)[:2000])


def _step(step: Step, vocabulary: Vocabulary, lexicon: Lexicon) -> Bilingual:
    def named(place: str) -> Bilingual:
        return lexicon.own_name(vocabulary.by_id[place])

    match step:
        case GoTo():
            name = named(step.place)
            return say("order.go_to", name=name)
        case ComeBack():
            return say("order.come_back")
        case ReturnHome():
            return say("order.go_home")
        case Wait():
            return say("order.wait", seconds=step.seconds)
        case Say():
            return say("order.say", text=step.text)
        case Find() | Count():
            return _seen(step, named(step.place) if step.place else None)
        case Follow():
            return say("order.follow", object=_the(step.object))
        case Turn():
            return _turn(round(degrees(step.angle_rad)))
        case Move():
            code = "order.forward" if step.distance_m > 0 else "order.back"
            return say(code, far=f"{abs(step.distance_m):g}")
        case Patrol():
            names = join((named(place) for place in step.places), "joint.and_the")
            return say("order.patrol", names=names)
        case _:
            return same(step.kind)


def _seen(step: Find | Count, place: Bilingual | None) -> Bilingual:
    verb, what = ("count" if isinstance(step, Count) else "find"), _the(step.object)
    if place is None:
        return say(f"order.{verb}", object=what)
    return say(f"order.{verb}_in", object=what, place=place)


def _turn(angle_deg: int) -> Bilingual:
    code = "order.left" if angle_deg > 0 else "order.right"
    return say(code, angle_deg=abs(angle_deg))


def _the(label: str) -> Bilingual:
    """Put the article before a thing, where the language has one; a name has none."""
    bare = label[:1].isupper() or not label.isascii()
    return same(label) if bare else say("order.the", object=label)
