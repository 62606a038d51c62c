"""Read the templates that a site's owner put beside it, in ``sentences.toml``.

They are of the same form as ours and mean plans of ours: ``[[template]]`` with ``plan``, ``en`` and
``zh``, and use the words that our file names. Law: an owner's sentence plans only what one of ours
could, and vetoes stand before both.
"""

from __future__ import annotations

from functools import lru_cache

from planner.language.templates.expressions import TemplateError
from planner.language.templates.template_file import TemplateSet, load_templates, read_templates


@lru_cache(maxsize=8)
def read_owners_templates(text: str) -> TemplateSet:
    """Return an owner's templates.

    Raises:
        TemplateError: one can't be read, or its plan or a slot of it is none of ours.
    """
    ours = load_templates()
    known: dict[str, set[str]] = {}
    for row in ours.rows:
        known.setdefault(row.form, set()).update(row.slots, row.values)
    made = read_templates(text, ours)
    for row in made.rows:
        if not {*row.slots, *row.values} <= known.get(row.form, set()):
            raise TemplateError(
                f"plan {row.form}({', '.join((*row.slots, *row.values))}) is none",
                f"plans: {'; '.join(f'{k}({_row(v)})' for k, v in sorted(known.items()))}",
                "请使用上面列出的 plan 及其槽位",
            )
    return made


@lru_cache(maxsize=64)
def read_skill_templates(text: str) -> TemplateSet:
    """Return the templates by which skills are called. Raises TemplateError."""
    return read_templates(text, load_templates())


def _row(slots: set[str]) -> str:
    return ", ".join(sorted(slots))
