"""Read what a question asks for, and by which neighbour. Pure; knows words, and no eyes.

"Is the cup on the table?", "桌子上有杯子吗", "what is under the chair?". An open question ("what is
there?"), one about people, about things of many kinds ("any toys?") or about a state ("is it
tidy?", 有没有关好) asks for nothing in particular, and so does whatever is not understood. A room
or place of the site says where to look, and is no neighbour but for what lies on or under it;
"here" is none either.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.folding import fold, fold_words, has_chinese
from planner.language.object_names import MAX_READ, resolve, synonyms
from planner.language.questions import chinese, english
from planner.language.questions.question import (
    ObjectQuestion,
    PlaceNames,
    QuestionReading,
    Relation,
    Whereabouts,
)
from planner.plan import Language

if TYPE_CHECKING:
    from types import ModuleType

_ENDS = re.compile(r"^[ .,!?。]+|[ .,!?。]+$")


def read_question(text: str, names: PlaceNames, place: str | None = None) -> QuestionReading:
    """Return what a question asks for.

    Args:
        text: as it was said.
        names: of the rooms and places of the site: they are where to look.
        place: where is looked round; None: from where the robot stands.
    """
    plain = _plain(text)
    language = _language_of(plain)
    asked = tuple(language.read_yes_no(plain, names))
    if asked:
        return _read_first(asked, names, place)
    words = language.open_at(plain)
    if words is not None:
        return QuestionReading((), "", _whereabouts(words, names, place), is_sure=True)
    what, words = language.loosely(plain)
    return QuestionReading((), what, _whereabouts(words, names, place), is_sure=False)


def split_relation(words: str) -> tuple[str, Relation, str] | None:
    """Return the thing's words, how it stands, and its neighbour's words; None without any.

    "the bottle on the table", "椅子旁边的箱子". Whether it stands so is judged where it is seen.
    """
    plain = fold_words(words)
    found = chinese.RELATED.fullmatch(plain) or english.RELATED.fullmatch(plain)
    if found is None:
        return None
    how = next(relation for relation in Relation if found[relation.value])
    return found["what"], how, found["by"]


def has_several_neighbours(words: str, label: str) -> bool:
    """Return whether words mean more than one neighbour of this kind: ``cups on the tables``."""
    by = (split_relation(words) or ("", "", ""))[2]
    if english.SEVERAL.search(by) or chinese.SEVERAL.search(by):
        return True
    return by.endswith("s") and not by.endswith(synonyms(label, Language.EN))


def names_floor(words: str) -> bool:
    """Return whether a neighbour's words mean the floor."""
    return any(language.FLOOR.fullmatch(words) for language in (english, chinese))


def looks_round(text: str) -> bool:
    """Return whether a question asks to look about, and not ahead alone."""
    folded = fold(text)
    return any(language.ROUND.search(folded) for language in (english, chinese))


def _plain(text: str) -> str:
    """Return a question in one way of writing; nothing of one that is too long to be read."""
    plain = _ENDS.sub("", fold_words(text))
    return plain if len(plain) <= MAX_READ else ""


def _language_of(plain: str) -> ModuleType:
    return chinese if has_chinese(plain) else english


def _read_first(
    asked: tuple[ObjectQuestion, ...], names: PlaceNames, place: str | None
) -> QuestionReading:
    """Return what a question asks for, yes or no, apart from where.

    "Is there a cup next to the sofa?" asks for no sofa.
    """
    first = asked[0]
    inner = split_relation(first.what)
    if inner is not None and not first.where:  # "do you see the cup on the table"
        what, relation, by = inner
        return QuestionReading(asked, what, Whereabouts(relation, by, first.what), is_sure=True)
    where = _whereabouts(first.where, names, place)
    sure = where is not None or _is_place_alone(first.where, names)
    return QuestionReading(asked, first.what, where, is_sure=sure)


def _is_place_alone(words: str, names: PlaceNames) -> bool:
    """Return whether words say where to look and nothing else: "on in the kitchen" says a state."""
    bare = _without_place(words, names).strip()
    patterns = (english.WHEREABOUTS, chinese.WHEREABOUTS, english.HERE, chinese.HERE)
    bare_name = re.sub(rf"^{english.THE}", "", bare)
    return not bare or bare_name in names or any(each.fullmatch(bare) for each in patterns)


def _whereabouts(words: str, names: PlaceNames, place: str | None) -> Whereabouts | None:
    """Return which neighbour words name; None where there is none, but a place to look in."""
    bare = _without_place(words, names)
    found = english.WHEREABOUTS.fullmatch(bare) or chinese.WHEREABOUTS.fullmatch(bare)
    if found is None or any(here.fullmatch(found["by"]) for here in (english.HERE, chinese.HERE)):
        return None
    relation = next((how for how in Relation if found[how.value]), None)
    room = names.get(re.sub(rf"^{english.THE}", "", found["by"]))
    if room or (room is False and place is not None and _is_looked_at(relation, found["by"])):
        return None
    return Whereabouts(relation, found["by"], bare.strip())


def _is_looked_at(relation: Relation | None, by: str) -> bool:
    """Return whether a look round a place sees what is meant: nobody looks into a fridge."""
    return relation is Relation.NEAR or (relation is None and resolve(by) is None)


def _without_place(words: str, names: PlaceNames) -> str:
    """Return the words without the room or place that they lie in, where more than that is said."""
    any_name = "|".join(map(re.escape, sorted(names, key=len, reverse=True)))
    if any_name:
        words = re.sub(rf" (?:in|inside|at|of) {english.THE}(?:{any_name})$", "", words)
        inside = rf"^在?(?:{any_name})(?:里面?|里边|内|中)?的?(?=[^{chinese.BESIDE}].)"
        words = re.sub(inside, "", words)
    return english.IN_HERE.sub("", words)
