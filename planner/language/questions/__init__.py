"""Read a question about what is there, by its words: what it asks for, and where that is to be."""

from planner.language.questions.elsewhere import find_elsewhere
from planner.language.questions.question import (
    ObjectQuestion,
    PlaceNames,
    QuestionReading,
    Relation,
    Whereabouts,
    fold_names,
)
from planner.language.questions.reader import (
    has_several_neighbours,
    looks_round,
    names_floor,
    read_question,
    split_relation,
)

__all__ = [
    "ObjectQuestion",
    "PlaceNames",
    "QuestionReading",
    "Relation",
    "Whereabouts",
    "find_elsewhere",
    "fold_names",
    "has_several_neighbours",
    "looks_round",
    "names_floor",
    "read_question",
    "split_relation",
]
