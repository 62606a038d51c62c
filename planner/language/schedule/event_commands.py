"""Read a sentence as an order upon an event: somebody's coming, or what no event tells. Pure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.schedule import chinese
from planner.language.schedule.arrivals import offer_event, read_arrival
from planner.language.schedule.command import ScheduleCommand
from planner.language.schedule.event_orders import NEWS, is_news, read_event_order
from planner.language.schedule.time_finder import first_parts, whole_parts
from planner.plan.timing import EventRule, WorldEvent

if TYPE_CHECKING:
    from types import ModuleType

    from planner.language.schedule.folded_sentence import FoldedSentence
    from planner.language.schedule.parts import Problem


def read_event(said: FoldedSentence, grammar: ModuleType) -> ScheduleCommand | None:
    """Read an order upon somebody's coming who is named, or upon what can't be noticed."""
    is_chinese = grammar is chinese
    arrival = read_arrival(said.folded, said.written, chinese=is_chinese)
    if arrival is not None:
        when = EventRule(event=WorldEvent.PERSON_SEEN)
        return order_upon(when, arrival.order, "", who=arrival.who)
    offer = offer_event(said.folded, chinese=is_chinese)
    if is_chinese or offer:
        return None if offer is None else _unseen(said, offer, grammar)
    found = read_event_order(said.folded, said.written, whole_parts)
    if found is None:
        return None if offer is None else _unseen(said, offer, grammar)
    if found.event is None:
        return _unseen(said, found.offer, grammar)
    return order_upon(EventRule(event=found.event), found.order, "", who=found.who)


def _unseen(said: FoldedSentence, offer: str, grammar: ModuleType) -> ScheduleCommand | None:
    """Return that no event tells what is waited for, with the order that comes nearest."""
    if not offer and first_parts(said.folded, grammar).parts:
        return None
    problem: Problem = "order_event_place" if offer else "order_no_event"
    return ScheduleCommand(None, said.written, "", problem=problem, offer=offer)


def order_upon(when: EventRule, order: str, words: str, who: str = "") -> ScheduleCommand:
    """Return an order upon an event; where its news alone is wanted, a reminder that tells it."""
    news = NEWS[when.event] if is_news(order) else None
    return ScheduleCommand(when, order, words, reminder=news, who=who)
