"""Say where a search did not look, and offer to look there, too. Pure.

Law: what was not looked at is named. Where a search's own bounds ended it, a person is asked
whether it is to go on there; a yes gives it the bounds of another search, in the rooms that were
left. Anything else ends it with what was seen. Nobody is asked where the person has said what to do
then.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from planner.language.catalogue import join, say
from planner.plan import Bilingual, StepRole
from planner.skills import search
from planner.skills.actions import Question, Scene
from planner.skills.result_text import list_rooms, looked_in

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.perception.snapshot import Thing


def tell_looked(scene: Scene[Any], alike: Sequence[Thing] = (), *, rooms: bool = True) -> Bilingual:
    """Tell where a search looked (unless told before), and where it did not, and why."""
    state = scene.state
    shut = tuple(room for room in state.shut if room not in state.rooms)
    seen = state.rooms if rooms else ()
    return looked_in(
        scene.facts, seen, shut, search.find_spent_budget(scene), alike, search.list_unseen(scene)
    )  # fmt: skip


def offer_more(scene: Scene[Any], said: Bilingual) -> Question | None:
    """Return the question whether to look on, after what was seen; None where nobody is asked."""
    unseen = search.list_unseen(scene)
    if not (scene.offers and unseen and search.may_go_on(scene)) or scene.state.offered:
        return None
    more = say("search.there", rooms=list_rooms(scene.facts, unseen))
    return Question(join((said, more)), scene.state.but(offered=True))


def takes_else(scene: Scene[Any]) -> bool:
    """Tell whether a find that ran out is what the person has given another branch for.

    Where no room was looked in at all, nobody has searched yet.
    """
    return scene.step.role is StepRole.WHEN and bool(scene.state.rooms) and search.ran_out(scene)


def tell_else(scene: Scene[Any], said: Bilingual) -> Bilingual:
    """Add to what a search came to that the person's other branch is taken, where it is."""
    told = takes_else(scene) and scene.has_else
    return join((said, say("search.else"))) if told else said
