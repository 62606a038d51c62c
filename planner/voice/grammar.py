"""Own what may be said: the orders as a JSGF grammar, and the same as a pattern. Pure.

The orders are forms that the offline brain reads; the decoys are what people also say near a robot
and what must not be bent into an order. A decoder may return a sentence's beginning where the end
fits badly: the pattern tells whole orders from such pieces.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

MAX_NAMES = 300
_SPOKEN = re.compile(r"[a-z']+(?: [a-z']+)*")


@dataclass(frozen=True, slots=True)
class Form:
    """Hold one part of the language twice: for the decoder and as a pattern over ``word ``."""

    jsgf: str
    pattern: str


def words(text: str) -> Form:
    """Say these words in this order."""
    return Form(text, re.escape(text).replace("\\ ", " ") + " ")


def one_of(*forms: Form) -> Form:
    """Say one of these."""
    jsgf = " | ".join(form.jsgf for form in forms)
    return Form(f"({jsgf})", f"(?:{'|'.join(form.pattern for form in forms)})")


def maybe(form: Form) -> Form:
    """Say it or not."""
    return Form(f"[{form.jsgf}]", f"(?:{form.pattern})?")


def after(*forms: Form) -> Form:
    """Say these one after the other."""
    jsgf = " ".join(form.jsgf for form in forms)
    return Form(jsgf, "".join(form.pattern for form in forms))


def any_of(*texts: str) -> Form:
    """Say one of these texts."""
    return one_of(*map(words, texts))


@dataclass(frozen=True, slots=True)
class Language:
    """Hold what may be said on one site."""

    jsgf: str
    orders: re.Pattern[str]
    left_out: tuple[str, ...]
    """Names that can't be said: a word without a pronunciation, digits, or too many names."""

    def is_order(self, transcript: str) -> bool:
        """Tell whether a transcript is an order from its first word to its last."""
        return self.orders.fullmatch(f"{transcript} ") is not None


def language_of(names: Sequence[str], pronounced: Callable[[str], bool]) -> Language:
    """Return what may be said about places with these names.

    ``pronounced`` tells whether the decoder knows how a word sounds.
    """
    unique = list(dict.fromkeys(" ".join(name.lower().replace("-", " ").split()) for name in names))
    sayable = [name for name in unique if _SPOKEN.fullmatch(name) and _all(name, pronounced)]
    kept = sayable[:MAX_NAMES]
    left_out = tuple(name for name in unique if name not in set(kept))
    orders = _orders(any_of(*kept) if kept else None)
    decoys = _decoys(any_of(*kept) if kept else None)
    jsgf = f"#JSGF V1.0;\ngrammar orders;\npublic <said> = {one_of(orders, decoys).jsgf};\n"
    return Language(jsgf, re.compile(orders.pattern), left_out)


def _all(name: str, pronounced: Callable[[str], bool]) -> bool:
    return all(pronounced(word) for word in name.split())


def _orders(place: Form | None) -> Form:
    please = maybe(words("please"))
    stop = any_of("stop", "stop now", "please stop")
    back = any_of("come back", "return home", "go home")
    asked = any_of("where are you")
    if place is None:
        return one_of(stop, asked, after(please, back, please))
    the = after(words("the"), place)
    go = after(any_of("go to", "drive to", "move to"), the)
    then = any_of("then", "and", "and then")
    more = maybe(after(then, one_of(go, the, back)))
    courtesy = maybe(any_of("please", "can you", "could you"))
    return one_of(stop, asked, after(courtesy, go, more, more, please), after(please, back, please))


def _decoys(place: Form | None) -> Form:
    never = any_of("don't", "do not", "can't", "never")
    alone = one_of(after(never, words("stop")), words("go away"))
    if place is None:
        return alone
    the = after(words("the"), place)
    away = after(never, any_of("go to", "drive to", "move to"), the)
    other = after(any_of("open", "close", "clean", "find", "in", "at", "on"), the)
    return one_of(alone, away, other)
