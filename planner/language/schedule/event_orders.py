"""Read English orders upon an event that the clause behind them names: "tell me when somebody comes".

"Say welcome to everyone who comes in" waits for anybody as well. Where the clause names a place, or
what no camera tells ("when he wakes up"), the nearest event is offered, or what can be noticed is
told. Pure. Law: an order that drives is none of these, and is left as it was said.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner.language.schedule.arrivals import COMES, KIN, Arrival, read_arrival, speak_to
from planner.language.schedule.parts import EventPart
from planner.language.schedule.reasons import leave_reasons_out
from planner.plan.timing import WorldEvent

if TYPE_CHECKING:
    from planner.language.schedule.parts import ReadsWhole

_WHEN = r"(?:when(?:ever)?|as soon as|every time|each time|any ?time|once|the moment|next time)"
_ANYBODY = r"(?:somebody|someone|anybody|anyone|a person|people|a visitor|a guest)"
_EACH = (
    r"(?:every(?:body|one)|any(?:body|one)|whoever|people|(?:each|every|any|all) (?:the )?"
    r"(?:person|one|guests?|visitors?|people)|(?:all )?(?:the )?(?:guests|visitors))"
)
TELL_ME = re.compile(
    r"(?:please |then |just )*(?:let (?:me|us) know|tell (?:me|us)|warn (?:me|us)|alert (?:me|us)|notify (?:me|us)"
    r"|call(?: out)?(?: (?:me|us))?|shout|give (?:me|us) a (?:shout|call))"
    r"(?: (?:about it|at once|right away|straight ?away|immediately|please))*"
)
"""What asks for the news of an event, and nothing else."""
NEWS = {
    WorldEvent.PERSON_SEEN: "somebody is here",
    WorldEvent.MOVEMENT: "something is moving",
    WorldEvent.BATTERY_LOW: "my battery is low",
    WorldEvent.GOAL_DONE: "an order is done",
    WorldEvent.GOAL_FAILED: "an order has failed",
    WorldEvent.ARRIVED_HOME: "I am back home",
}
"""What is then said to a person who wanted to be told."""
_SPEAKS = (
    r"(?:please |just |also |then )*(?:say|tell|let|remind|ask|greet|welcome|announce|wish|warn|call|shout|alert"
    r"|notify|give me)\b"
)
_BEHIND = re.compile(rf"(?P<deed>{_SPEAKS}[^,;:.]*?) (?P<clause>{_WHEN} [^,;:.]+)")
_BEFORE = re.compile(rf"(?P<clause>{_WHEN} [^,;:.]+?),? (?P<deed>{_SPEAKS}.+)")
_SECOND = re.compile(
    r"\b(?:and|then|if|unless|until|or) (?:then )?(?:go|come|drive|tell|say|ask|wait|look|find|when|whenever|if)\b"
)
_TO_WHO = re.compile(
    rf"(?:please |just )*say (?P<what>.+) to (?P<who>{KIN}|[a-z]+)|(?:please |just )*(?:greet|welcome) (?P<who2>{KIN}|[a-z]+)"
    rf"|(?:please |just )*(?P<verb>tell|remind|wish|ask|warn) (?P<who3>{KIN}|[a-z]+)(?P<rest> .+)"
)
_HE = re.compile(rf"{_WHEN} (?P<he>he|she|they|(?P<who>{KIN}|[a-z]+)) (?P<comes>{COMES})")
_TO_EACH = re.compile(
    rf"(?:please |just )*(?:(?:say|call out|shout) (?P<what>.+?) to|(?P<greets>greet|welcome)) {_EACH}"
    rf"(?: (?:who|that))? (?P<comes>.+?)(?: (?:with|by saying) (?P<with>[^,;]+))?"
    rf"|(?:please |just )*(?:tell|remind|warn) {_EACH} (?:who|that) (?P<comes2>.+?) (?P<how>to|that) (?P<rest>.+)"
)
_COMES_EACH = re.compile(
    r"(?:(?:comes?|coming|walks?|walking|steps?|stepping)(?: (?:in|inside|home|here|by|past|along|over|through))*(?: (?:at |to |by |through |in )?the (?:front )?door)?"
    r"|enters?|entering|arrives?|arriving|shows? up|turns? up|you (?:see|meet|spot)|is at the door|at the door)"
)
_TO_THEM = re.compile(r"(?:please |just )*(?:tell|remind|wish|warn|let) (?:them|him|her)\b")
_AT_PLACE = re.compile(
    rf"{_WHEN} (?P<who>{_ANYBODY}|{KIN}|[a-z]+)(?:'s|'re)? ?(?:comes?|goes|go|walks?|gets?|steps?|arrives?|appears?|shows? up|turns? up|is|are|sits?|stands?|enters?)?"
    r"(?: (?:back|over|up|down|out))? (?:in|into|to|at|near|by|inside|outside|on|onto|enters|through|in front of) ?"
    r"(?:the |my |our |your )(?P<place>[a-z' ]{2,30})"
)
_ENTERS = re.compile(
    rf"{_WHEN} (?P<who>{_ANYBODY}|{KIN}|[a-z]+) (?:enters?|leaves?) (?:the |my |our |your )[a-z' ]{{2,30}}"
)
_UNSEEN = re.compile(
    rf"{_WHEN} (?:he|she|they|i|we|(?:the |my |our |your )?[a-z]+(?: [a-z]+)?|{_ANYBODY})(?: (?:has|have|is|are|'s|'re))?"
    r" ?(?:wakes? up|gets? up|is up|is awake|falls? asleep|asleep|awake|goes (?:out|to (?:bed|sleep|work|school))|go (?:out|to (?:bed|sleep))"
    r"|leaves?(?: the house| home)?|barks?|meows?|miaows?|cries|cry|cough(?:s)?|rings?(?: the (?:door ?)?bell)?|knocks?(?: (?:on|at) the door)?"
    r"|beeps?|boils?|is boiling|is (?:ready|hungry|sad|ill|full|empty|hot|cold|open|shut|closed)|stops?|starts?|starts? (?:raining|snowing|crying)"
    r"|rains?|snows?|gets? (?:dark|light|cold|hot|late)|calls?|phones?|falls?(?: over| down)?|laughs?|sings?)"
)
_ANIMAL = re.compile(r"(?:the |my |our )?(?:cat|dog|puppy|kitten|bird|rabbit|robot|ball|postie)s?")
_NO_NAME = re.compile(
    r"(?:he|she|they|it|i|we|you|that|this|there|nobody|nothing|something|anything|everything)"
)


@dataclass(frozen=True, slots=True)
class EventOrder:
    """Hold an order upon an event, whom it waits for, or the sentence that comes nearest."""

    order: str
    who: str = ""
    event: WorldEvent | None = None
    """None: no event tells that."""
    offer: str = ""


def read_event_order(folded: str, written: str, whole: ReadsWhole) -> EventOrder | None:
    """Return an order upon somebody's coming, or upon what can't be noticed; None of any other."""
    each = _TO_EACH.fullmatch(folded)
    if each is not None:
        return _to_each(each, written)
    behind = _BEHIND.fullmatch(folded)
    found = behind or _BEFORE.fullmatch(folded)
    if found is None or _SECOND.search(found["deed"]) or '"' in found["clause"]:
        return None
    clause = written[slice(*found.span("clause"))]
    deed = written[slice(*found.span("deed"))].strip(" ,")
    if behind is not None:
        arrival = _read_behind(deed, clause)
        if arrival is not None:
            return EventOrder(arrival.order, arrival.who, WorldEvent.PERSON_SEEN)
    parts = whole(clause.lower(), in_chinese=False)
    if parts == (EventPart(WorldEvent.PERSON_SEEN),):
        order = speak_to("", deed) if _TO_THEM.match(deed.lower()) else deed
        return EventOrder(order, event=WorldEvent.PERSON_SEEN) if order != deed else None
    if parts:
        return None  # another event, or a time
    return _read_unseen(clause, deed)


def is_news(order: str) -> bool:
    """Tell whether an order upon an event asks for its news alone: "tell me"."""
    said = order.lower().strip(" .!")
    bare = leave_reasons_out(said, chinese=False) or said
    return TELL_ME.fullmatch(bare) is not None


def _to_each(found: re.Match[str], written: str) -> EventOrder | None:
    comes = found["comes"] or found["comes2"]
    if found["rest"]:
        rest = written[slice(*found.span("rest"))]
        order = f'say "{_address("", rest, asks=found["how"] == "to")}"'
    elif found["with"]:
        said = written[slice(*found.span("with"))]
        order = f"say {said.strip()}"
    elif found["what"]:
        order = f"say {written[slice(*found.span('what'))]}"
    else:
        order = "say hello" if found["greets"] == "greet" else "say welcome"
    if _COMES_EACH.fullmatch(comes) is not None:
        return EventOrder(order, event=WorldEvent.PERSON_SEEN)
    if re.match(_COMES_EACH.pattern, comes) is None:
        return None
    return EventOrder("", offer=f"when somebody comes in, {order}")


def _address(who: str, words: str, *, asks: bool) -> str:
    """Return what is to be said to whoever comes, as it is said to them."""
    words = re.sub(r"\b(?:their|his|her) (?=[a-z])", "your ", words.strip(" .!"))
    said = f"please {words}" if asks else words
    return f"{who}, {said}" if who else said[:1].upper() + said[1:]


def _read_behind(deed: str, clause: str) -> Arrival | None:
    """Read "say hello to Mia when she comes home", "let me know when the postman comes"."""
    comes = _HE.fullmatch(clause.lower())
    if comes is None:
        return None
    if is_news(deed):
        who = clause[slice(*comes.span("he"))]
        named = comes["who"] is not None and _is_somebody(who)
        return Arrival(who, deed) if named else None
    to = _TO_WHO.fullmatch(deed.lower())
    if to is None:
        return None
    group = next(name for name in ("who", "who2", "who3") if to[name])
    who = deed[slice(*to.span(group))]
    if not _is_somebody(who) or (comes["who"] and comes["who"] != who.lower()):
        return None
    if to["what"]:
        name = re.sub(r"^(?:the|my|our|your) ", "", who)
        what = deed[slice(*to.span("what"))].strip("\"' ")
        return Arrival(who, f'say "{name[:1].upper()}{name[1:]}, {what}"')
    if to["who2"]:
        return Arrival(who, "say hello")
    turned = f"when {who} comes, {deed}"
    return read_arrival(turned.lower(), turned, chinese=False)


def _is_somebody(who: str) -> bool:
    """Tell whether words name a person: one of the family, or a name that is written as one."""
    if _NO_NAME.fullmatch(who.lower()) is not None or _ANIMAL.fullmatch(who.lower()) is not None:
        return False
    return re.fullmatch(KIN, who.lower()) is not None or who[:1].isupper()


def _read_unseen(clause: str, deed: str) -> EventOrder | None:
    """Return the nearest order to one upon what no event tells; None of an event, or of none."""
    folded = clause.lower()
    at = _AT_PLACE.fullmatch(folded) or _ENTERS.fullmatch(folded)
    if at is not None:
        who = clause[slice(*at.span("who"))]
        anybody = re.fullmatch(_ANYBODY, who.lower()) is not None
        if at.groupdict().get("place", "").strip() in ("door", "front door") and anybody:
            return EventOrder(deed, event=WorldEvent.PERSON_SEEN)
        if anybody:
            return EventOrder("", offer=f"when somebody comes in, {deed}")
        if _is_somebody(who):
            return EventOrder("", offer=f"when {who} comes, {deed}")
        return EventOrder("") if _ANIMAL.fullmatch(who.lower()) is not None else None
    return EventOrder("") if _UNSEEN.fullmatch(folded) is not None else None
