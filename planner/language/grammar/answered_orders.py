"""Read orders that hang on what somebody answers: "ask Mum if she wants tea, if so go …". Pure.

Law: only a question that a plain yes or no answers; each part is read alone, with all its vetoes.
"""

from __future__ import annotations

from planner.language.grammar.branch_orders import tell_them
from planner.language.grammar.compound_forms import CompoundForms, PartReaders
from planner.plan import Ask, If, Step


def read_answered(said: str, forms: CompoundForms, read: PartReaders) -> tuple[Step, ...] | None:
    """Return the question and its two branches; None of any other sentence."""
    for yes_first, pattern in forms.answers:
        found = pattern.fullmatch(said)
        asked = read.steps(found["ask"].strip(" ,")) if found is not None else None
        if found is None or not asked or not isinstance(asked[-1], Ask):
            continue
        echo = [word for word in (found["echo"] or "").split() if word != "would"][:1]
        if forms.open_question is None or forms.open_question.search(asked[-1].question):
            continue
        if echo and echo[0].removesuffix("s") not in asked[-1].question:
            continue
        first, second = (
            read.steps(tell_them(found[part].strip(" ,"), forms)) if found[part] else ()
            for part in ("then", "else")
        )
        if first is None or second is None:
            continue
        yes, no = (first, second) if yes_first else (second, first)
        return (*asked[:-1], If(when=asked[-1], then=yes, otherwise=no))
    return None
