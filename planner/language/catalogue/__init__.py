"""Say everything that a person reads or hears, by code and facts, in every language at once.

Logic names a message by its code and hands over facts by their names; the words of each language
stand in one file beside this one (``en.toml``, ``zh.toml``). A file more is a language more: no
line of code names a language. What a file lacks is told in English.
"""

from planner.language.catalogue.words import (
    CATALOGUE,
    Catalogue,
    UnknownMessage,
    Words,
    build,
    join,
    list_names,
    load,
    message,
    noun,
    pair_up,
    place_name,
    plural,
    quantity,
    raw,
    say,
    say_or_quote,
    template,
)

__all__ = [
    "CATALOGUE",
    "Catalogue",
    "UnknownMessage",
    "Words",
    "build",
    "join",
    "list_names",
    "load",
    "message",
    "noun",
    "pair_up",
    "place_name",
    "plural",
    "quantity",
    "raw",
    "say",
    "say_or_quote",
    "template",
]
