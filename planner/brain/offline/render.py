"""Write steps as a sentence that reads back as the same steps: what a button of a question says."""

from __future__ import annotations

from collections.abc import Sequence

from planner.brain.offline.lexicon import Lexicon
from planner.plan import (
    Bilingual,
    ComeBack,
    GoTo,
    Language,
    Option,
    ReturnHome,
    Say,
    Step,
    Vocabulary,
    Wait,
)


def sentence(steps: Sequence[Step], vocabulary: Vocabulary, lexicon: Lexicon) -> Bilingual:
    """Return the order of these steps in both languages."""
    said = [_step(step, vocabulary, lexicon) for step in steps]
    return Bilingual(
        en=", then ".join(one.en for one in said), zh="，然后".join(one.zh for one in said)
    )


def option(
    steps: Sequence[Step], vocabulary: Vocabulary, lexicon: Lexicon, language: Language
) -> Option:
    """Return a button that stands for these steps."""
    label = sentence(steps, vocabulary, lexicon)
    return Option(label=label, text=label.of(language)[:2000])


def _step(step: Step, vocabulary: Vocabulary, lexicon: Lexicon) -> Bilingual:
    match step:
        case GoTo():
            name = lexicon.own_name(vocabulary.by_id[step.place])
            return Bilingual(en=f"go to the {name.en}", zh=f"去{name.zh}")
        case ComeBack():
            return Bilingual(en="come back", zh="回来")
        case ReturnHome():
            return Bilingual(en="go home", zh="回家")
        case Wait():
            return Bilingual(en=f"wait {step.seconds:g} seconds", zh=f"等{step.seconds:g}秒")
        case Say():
            return Bilingual(en=f'say "{step.text}"', zh=f"说“{step.text}”")
        case _:
            return Bilingual(en=step.kind, zh=step.kind)
