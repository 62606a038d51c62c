"""Own the spoken orders: as a JSGF grammar, and the same as a pattern. Pure.

The orders are forms that the offline brain reads; the decoys are what people also say near a robot
and what must not be bent into an order. A decoder may return a sentence's beginning where the end
fits badly: the pattern tells whole orders from such pieces.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

MAX_NAMES = 300
MAX_SENTENCES = 200
PLACE = "_"
"""Stands in a sentence of the owner's where a name of a place is said."""
_SPOKEN = re.compile(r"[a-z']+(?: [a-z']+)*")


@dataclass(frozen=True, slots=True)
class GrammarPart:
    """Hold one part of the language twice: for the decoder and as a pattern over ``word ``."""

    jsgf: str
    pattern: str


def words(text: str) -> GrammarPart:
    """Say these words in this order."""
    return GrammarPart(text, re.escape(text).replace("\\ ", " ") + " ")


def one_of(*forms: GrammarPart) -> GrammarPart:
    """Say one of these."""
    jsgf = " | ".join(form.jsgf for form in forms)
    return GrammarPart(f"({jsgf})", f"(?:{'|'.join(form.pattern for form in forms)})")


def maybe(form: GrammarPart) -> GrammarPart:
    """Say it or not."""
    return GrammarPart(f"[{form.jsgf}]", f"(?:{form.pattern})?")


def any_number(form: GrammarPart) -> GrammarPart:
    """Say it as often as wanted, or not at all."""
    return GrammarPart(f"({form.jsgf})*", f"(?:{form.pattern})*")


def after(*forms: GrammarPart) -> GrammarPart:
    """Say these one after the other."""
    jsgf = " ".join(form.jsgf for form in forms)
    return GrammarPart(jsgf, "".join(form.pattern for form in forms))


def any_of(*texts: str) -> GrammarPart:
    """Say one of these texts."""
    return one_of(*map(words, texts))


def _file(said: GrammarPart) -> str:
    return f"#JSGF V1.0;\ngrammar spoken;\npublic <said> = {said.jsgf};\n"


_STOPS = ("stop", "stop now", "please stop")
STOPS = _file(any_of(*_STOPS))
"""The grammar of the stops alone, for a second look at what was no whole order."""
_OTHER_STOPS = (
    *("don't move", "emergency stop", "stand still", "stop moving"),
    *("stop stop", "stop stop stop", "robot stop", "hey robot stop"),
)
OTHER_STOPS = _file(any_of(*_OTHER_STOPS))
"""Other ways to say stop, for a third look: beside the plain ones they would take their score. One
short word alone ("freeze", "halt") is found in too many other sentences."""
_CALLED_STOPS = ("robot stop", "hey robot stop", "robot please stop")
CALLED_STOPS = _file(any_of(*_CALLED_STOPS))
"""What else stops while it is being said, at the beginning of a piece of speech. Looked for after
the plain stops: in one grammar with them, 6 of 32 plain ones were missed (docs/adr/0068)."""
_ANSWERS = (
    *("yes", "yes please", "go ahead", "please do"),
    *("no", "no thanks", "no thank you", "no please don't"),
)
_NEAR_ANSWERS = ("guess", "chess", "bless you", "your head")
"""Words that sound like a yes: without them six of seven voices' "guess" was heard as one. What
sounds like a no may be one: a no moves nothing."""
ANSWERS = _file(any_of(*_ANSWERS, *_NEAR_ANSWERS))
"""The grammar of yes and no, looked for only while a question waits for one of them."""


@dataclass(frozen=True, slots=True)
class SpokenLanguage:
    """Hold the spoken orders of one site."""

    jsgf: str
    orders: re.Pattern[str]
    names: tuple[str, ...]
    """Names that can be said."""
    left_out: tuple[str, ...]
    """Names and sentences that can't be said: a word without a pronunciation, digits, too many."""
    sentences: tuple[str, ...] = ()
    """The owner's own orders that can be said."""

    def is_order(self, transcript: str) -> bool:
        """Tell whether a transcript is an order from its first word to its last."""
        return self.orders.fullmatch(f"{transcript} ") is not None


def is_answer(transcript: str) -> bool:
    """Tell whether a transcript is a yes or no, and not a word that sounds like one."""
    return transcript in _ANSWERS


def is_stop(transcript: str) -> bool:
    """Tell whether a transcript is one of the stops that are in every grammar."""
    return transcript in _STOPS


def is_called_stop(transcript: str) -> bool:
    """Tell whether a transcript calls the robot and tells it to stop."""
    return transcript in _CALLED_STOPS


def language_of(
    names: Sequence[str], pronounced: Callable[[str], bool], sentences: Sequence[str] = ()
) -> SpokenLanguage:
    """Return the language of orders about places with these names.

    Args:
        names: of the places.
        pronounced: tells whether the decoder knows how a word sounds.
        sentences: orders of the owner's own, ``PLACE`` where a name of a place stands.
    """
    kept, left_out = _choose(names, MAX_NAMES, lambda name: _can_say(name, pronounced))
    own, unsaid = _choose(
        sentences,
        MAX_SENTENCES,
        lambda said: _can_say(said.replace(PLACE, "place"), pronounced),
    )
    place = any_of(*kept) if kept else None
    owners = [_sentence(each, place) for each in own if place is not None or PLACE not in each]
    orders = one_of(_orders(place), *owners) if owners else _orders(place)
    decoys = _decoys(place)
    return SpokenLanguage(
        _file(one_of(orders, decoys)), re.compile(orders.pattern), kept, left_out + unsaid, own
    )


def _choose(
    texts: Sequence[str], most: int, can_say: Callable[[str], bool]
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the texts that can be said, and the others."""
    unique = list(dict.fromkeys(" ".join(text.lower().replace("-", " ").split()) for text in texts))
    kept = tuple(text for text in unique if can_say(text))[:most]
    return kept, tuple(text for text in unique if text not in set(kept))


def _can_say(text: str, pronounced: Callable[[str], bool]) -> bool:
    return _SPOKEN.fullmatch(text) is not None and all(map(pronounced, text.split()))


def _sentence(text: str, place: GrammarPart | None) -> GrammarPart:
    spot = None if place is None else after(maybe(words("the")), place)
    return after(*(words(word) if word != PLACE or not spot else spot for word in text.split()))


def _orders(place: GrammarPart | None) -> GrammarPart:
    back = any_of("come back", "return home", "go home")
    asked = words("where are you")
    alone = one_of(
        any_of(*_STOPS), asked, after(maybe(words("please")), back, maybe(words("please")))
    )
    if place is None:
        return alone
    the = after(words("the"), place)
    go = after(_GO, the)
    more = after(_THEN, one_of(go, the, back))
    return one_of(alone, after(maybe(_COURTESY), go, any_number(more), maybe(words("please"))))


def _decoys(place: GrammarPart | None) -> GrammarPart:
    never = any_of("don't", "do not", "can't", "never")
    alone = one_of(after(never, words("stop")), words("go away"))
    if place is None:
        return alone
    other = one_of(after(never, _GO), any_of(*_OTHER))
    return one_of(alone, after(other, words("the"), place))


_OTHER = (
    *("open", "close", "clean", "find", "put", "take", "not", "not to"),
    *("in", "at", "on", "from", "around"),
)
"""What else comes before a place and must not be bent into "go to"."""
_GO = any_of("go to", "drive to", "move to")
_THEN = any_of("then", "and", "and then")
_COURTESY = any_of("please", "can you", "could you")
