"""Write steps as a sentence that reads back as the same steps: what a button of a question says."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees

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
)


def sentence(steps: Sequence[Step], vocabulary: Vocabulary, lexicon: Lexicon) -> Bilingual:
    """Return the order of these steps in both languages."""
    kept = [step for at, step in enumerate(steps) if not _goes_without_saying(steps, at)]
    said = [_step(step, vocabulary, lexicon) for step in kept]
    return Bilingual(
        en=", then ".join(one.en for one in said), zh="，然后".join(one.zh for one in said)
    )


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
            return Bilingual(en=f"go to the {name.en}", zh=f"去{name.zh}")
        case ComeBack():
            return Bilingual(en="come back", zh="回来")
        case ReturnHome():
            return Bilingual(en="go home", zh="回家")
        case Wait():
            return Bilingual(en=f"wait {step.seconds:g} seconds", zh=f"等{step.seconds:g}秒")
        case Say():
            return Bilingual(en=f'say "{step.text}"', zh=f"说“{step.text}”")
        case Find() | Count():
            return _seen(step, named(step.place) if step.place else None)
        case Follow():
            return Bilingual(en=f"follow {_the(step.object)}", zh=f"跟着{step.object}")
        case Turn():
            return _turn(round(degrees(step.angle_rad)))
        case Move():
            way = ("forward", "前") if step.distance_m > 0 else ("back", "后")
            far = f"{abs(step.distance_m):g}"
            return Bilingual(en=f"move {way[0]} {far} m", zh=f"向{way[1]}走{far}米")
        case Patrol():
            names = [named(place) for place in step.places]
            en = " and the ".join(name.en for name in names)
            return Bilingual(en=f"patrol the {en}", zh="巡逻" + "和".join(n.zh for n in names))
        case _:
            return Bilingual(en=step.kind, zh=step.kind)


def _seen(step: Find | Count, place: Bilingual | None) -> Bilingual:
    verb, action = ("count", "数") if isinstance(step, Count) else ("find", "找")
    where = f" in the {place.en}" if place else ""
    there = f"去{place.zh}" if place else ""
    return Bilingual(en=f"{verb} {_the(step.object)}{where}", zh=f"{there}{action}{step.object}")


def _turn(angle_deg: int) -> Bilingual:
    side = ("left", "左") if angle_deg > 0 else ("right", "右")
    return Bilingual(
        en=f"turn {side[0]} {abs(angle_deg)} degrees", zh=f"向{side[1]}转{abs(angle_deg)}度"
    )


def _the(label: str) -> str:
    """Put the article before a thing; a name has none."""
    return label if label[:1].isupper() or not label.isascii() else f"the {label}"
