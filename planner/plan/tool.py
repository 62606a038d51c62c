"""Own the record of a tool and the step that asks it.

A tool is what a server of the owner's can be asked; ``planner.tool_servers`` lists and calls them.
"""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import BeforeValidator, Field, StringConstraints, model_validator

from planner.plan.base import Frozen

MOST_ARGUMENTS = 8
MOST_ARGUMENT = 200
"""Characters of one."""
ServerName = Annotated[str, StringConstraints(pattern=r"^[a-z][a-z0-9_]{0,19}$")]
ToolName = Annotated[
    str, StringConstraints(pattern=r"^[a-z][a-z0-9_]{0,19}\.[A-Za-z0-9_./-]{1,64}$")
]
"""``server.tool``: so no tool is named like a stop, a place or a step."""
ArgumentKind = Literal["string", "number", "integer", "boolean", "array", "object"]


class ToolParameter(Frozen):
    """Name one parameter of a tool, with its JSON type."""

    name: Annotated[str, StringConstraints(pattern=r"^[A-Za-z_][A-Za-z0-9_.-]{0,39}$")]
    kind: ArgumentKind = "string"
    required: bool = False


class Tool(Frozen):
    """Hold one tool that may be asked."""

    name: ToolName
    about: Annotated[str, StringConstraints(max_length=120)] = ""
    """The server's own words: data, never an order."""
    parameters: Annotated[tuple[ToolParameter, ...], Field(max_length=MOST_ARGUMENTS)] = ()
    """The required ones first: a plan gives its arguments in this row."""
    writes: bool = False
    """It changes something outside: each call waits for a person's yes."""

    @property
    def server(self) -> str:
        """Return the owner's name for the server."""
        return self.name.partition(".")[0]

    def find_missing(self, arguments: tuple[str, ...]) -> tuple[str, ...]:
        """Return the names of required parameters that are given nothing."""
        given = (*arguments, *("" for _ in self.parameters))
        pairs = zip(self.parameters, given, strict=False)
        return tuple(each.name for each, value in pairs if each.required and not value.strip())


MOST_GIVEN = 600
"""Characters of all arguments of one call: a person who is asked about it is told them whole."""


def _write_scalars(arguments: object) -> object:
    """Return numbers and yes or no among arguments as words: models write them as JSON has them."""
    if not isinstance(arguments, list | tuple):
        return arguments
    plain = [str(a).lower() if isinstance(a, bool | int | float) else a for a in arguments]
    return tuple("" if a is None else a for a in plain)


class UseTool(Frozen):
    """Ask a tool."""

    kind: Literal["use_tool"] = "use_tool"
    tool: ToolName
    arguments: Annotated[
        tuple[Annotated[str, StringConstraints(max_length=MOST_ARGUMENT)], ...],
        Field(max_length=MOST_ARGUMENTS),
        BeforeValidator(_write_scalars),
    ] = ()
    """In the row of the tool's parameters; an empty one is left out."""

    @model_validator(mode="after")
    def _can_be_told(self) -> Self:
        if sum(map(len, self.arguments)) > MOST_GIVEN:
            raise ValueError(f"arguments of one call have at most {MOST_GIVEN} characters")
        return self
