"""Say all kinds of things in a process whose catalogue has one language file more; print them.

``python -m tests.planner.language.catalogue.third_language FOLDER``: the package ``catalogue`` in
that folder, with its files, stands in for ours. Each line is a JSON pair: English, and language xx.
"""

from __future__ import annotations

import asyncio
import json
import sys
from itertools import product
from math import radians
from typing import Any

import planner.language

if __name__ == "__main__":
    planner.language.__path__.insert(0, sys.argv[1])  # before anything imports the catalogue

from planner.brain import OfflineBrain, ThinkRequest
from planner.language import color_names
from planner.language.formatting import angle, metres
from planner.language.object_classes import KINDS
from planner.language.object_names import list_kinds, name_object, named_several
from planner.language.place_lists import known_places
from planner.perception.snapshot import LookSnapshot, Sight, Thing
from planner.plan import RUNNABLE, Bilingual, Clarify, Language, Refuse
from planner.plan import AnswerPlan as Reply
from planner.site import Site
from planner.site.site_view import facts_of, vocabulary_of
from planner.skills import Eyesight, act_of
from planner.skills.look import direction
from planner.skills.perception import ImageAnswer, WantedObject
from planner.skills.result_text import (
    found_at,
    looked_in,
    name_count,
    name_one,
    unknown_words,
)
from planner.skills.skill_state import LookStage, LookState
from pons_assets import DEFAULT_SITE
from tests.planner.skills.scenes import scene
from wire import CameraConfig, Pose2

SENTENCES = (
    "where can you go?", "where are you?", "what time is it?", "tell me a joke", "hello",
    "go to the cellar", "go to the kitchn or the bath", "find the toy in the kitchen and the study",
    "fetch the toy from the kitchen", "don't go to the kitchen", "go to the kitchen if it rains",
    "drive fast to the study", "turn left 30 degrees and then fly", "move forward", "come here",
    "hit the dog", "go out of the kitchen", "go to the kitchen, then wait 3000 seconds",
)  # fmt: skip
QUESTIONS = (
    "is the cup on the table?", "is there a cup under the table", "what is on the table?",
    "is there a cup near the chair?", "what do you see?", "is there a red cup?",
    "is there a piano?",
)  # fmt: skip
SITE = Site.load(DEFAULT_SITE)
FACTS, VOCABULARY = facts_of(SITE), vocabulary_of(SITE)


def main() -> None:
    """Print what is said."""
    for said in (*constants(), *names(), *figures(), *plans(), *answers()):
        print(json.dumps((said.en, said.of("xx"))))


def constants() -> list[Bilingual]:
    """Return every text that a module of the planner holds, and what its tables hold."""
    held = [vars(module) for name, module in sorted(sys.modules.items()) if "planner." in name]
    values = [value for own in held for value in own.values()]
    inner = [v for value in values if isinstance(value, dict) for v in value.values()]
    inner += [v for value in values if isinstance(value, tuple) for v in value]
    return [value for value in (*values, *inner) if isinstance(value, Bilingual)]


def names() -> list[Bilingual]:
    """Return the names of things, colours, rooms and places."""
    things = [name_object(label, color) for label in KINDS for color in (None, "red")]
    several = [named_several(label, "blue") for label in KINDS]
    places = [target.name for target in FACTS.targets.values()]
    places += [entry.name for entry in VOCABULARY.entries]
    colors = [color_names.color_name(color) for color in color_names.COLORS]
    return [*things, *several, *places, *colors, list_kinds(KINDS), known_places(VOCABULARY, 3)]


def figures() -> list[Bilingual]:
    """Return numbers with their units, directions, and lists of what was found."""
    turns = [angle(radians(deg)) for deg in (-90.0, 12.0)]
    sides = [direction(radians(deg)) for deg in range(0, 360, 45)]
    found = [
        found_at(FACTS, "knife", "red", room, away, wanted)
        for room, away, wanted in product(
            (None, "kitchen"), (None, 1.25), (None, WantedObject("knife", by=WantedObject("table")))
        )
    ]
    looked = looked_in(FACTS, ("kitchen",), ("study",), "way")
    more = [
        name_one("apple"),
        name_count(2, "box", "red"),
        unknown_words("toy", ("cup",)),
        looked,
    ]
    return [*turns, metres(-0.5), metres(1.25), *sides, *found, *more]


def plans() -> list[Bilingual]:
    """Return what is said to orders that are no plans, and the words of their buttons."""
    texts: list[Bilingual] = []
    for sentence in SENTENCES:
        request = ThinkRequest(text=sentence, vocabulary=VOCABULARY, language=Language.EN,
                               runnable=RUNNABLE | {"find", "count"})  # fmt: skip
        plan = asyncio.run(OfflineBrain().think(request)).plan
        if isinstance(plan, Clarify):
            texts += [plan.question, *(option.label for option in plan.options)]
        elif isinstance(plan, Reply | Refuse):
            texts.append(plan.text if isinstance(plan, Reply) else plan.reason)
    return texts


def answers() -> list[Bilingual]:
    """Return what is told of pictures, with what a model adds to it."""
    seen = [thing("table", 1.6, 0.4), thing("cup", 1.7, 0.8), thing("cup", 3.2, 0.8, color="red")]
    texts = []
    for question, place, count in product(QUESTIONS, (None, "kitchen"), range(len(seen) + 1)):
        sight = Sight(
            LookSnapshot(1, 100.0, Pose2(0.0, 0.0, 0.0), 320, 240, ()), tuple(seen[:count])
        )
        fields: dict[str, Any] = {"facts": FACTS, "sight": sight, "now_s": 100.0, "spent_s": 5.0}
        eyes = Eyesight(CameraConfig(), ("cup", "table", "chair"), model=True)
        state = LookState(here=(0.0, 0.0), stage=LookStage.ASKED, faced=(0.0, 1.5))
        sign = ImageAnswer(Bilingual(en="A SIGN", zh="牌子"), shown=2)
        step = {"text": question, "place": place}
        done: Any = act_of(scene("look", step=step, eyes=eyes, state=state, answer=sign, **fields))
        texts += [text for text in (done.said, getattr(done, "read", None)) if text is not None]
    return texts


def thing(label: str, x_m: float, z_m: float, color: str | None = None) -> Thing:
    """Return a thing that was seen often, a moment ago."""
    return Thing(id=f"{label}_{x_m}", label=label, color=color, x_m=x_m, y_m=0.0, z_m=z_m,
                 sigma_m=0.03, confidence=0.9, seen_s=99.5, first_s=0.0, sightings=5,
                 room="kitchen")  # fmt: skip


if __name__ == "__main__":
    main()
