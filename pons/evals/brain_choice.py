"""Open the brain that a suite is asked of: the grammar, or a model that the home pays for."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, TypeVar

from planner.brain import Brain, OfflineBrain
from wire import ConfigError

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from planner.brain.endpoint import EndpointBrain
    from pons.settings import LaunchSettings

Scored = TypeVar("Scored")


async def with_brain(
    settings: LaunchSettings,
    model: str | None,
    score: Callable[[Brain], Awaitable[Scored]],
    *,
    yes: bool,
    count: int = 0,
) -> Scored:
    """Score the brain that is meant: the offline one, or a model.

    Raises:
        ConfigError: as ``with_model`` does.
    """
    if model is None:
        return await score(OfflineBrain())
    return await with_model(settings, model, score, yes=yes, count=count)


async def with_model(
    settings: LaunchSettings,
    model: str,
    score: Callable[[EndpointBrain], Awaitable[Scored]],
    *,
    yes: bool,
    count: int = 0,
) -> Scored:
    """Score a model; it is paid for by the owner's budget.

    Args:
        settings: where the home lies.
        model: NAME, URL or NAME@URL; empty for the owner's own.
        score: asks it.
        yes: what a suite holds, pictures too, may be sent to another machine.
        count: sentences that would be sent; 0 where that is not known.

    Raises:
        ConfigError: ``model_offhost`` and what a model's settings may lack.
    """
    from planner.brain.endpoint import EndpointBrain
    from planner.budget import Ledger, Purse
    from planner.outbound import Address
    from pons.evals.model_access import choose_model

    owner, whom = choose_model(model, settings.home, os.environ)
    address = Address.parse(whom.url)
    if not address.local and not yes:
        sentences = f"{count} sentences" if count else "the sentences"
        detail = f"{sentences} would be sent to {address.host}; if that is meant, say --yes"
        raise ConfigError("model_offhost", detail)
    ledger = Ledger.in_home(settings.home)
    purse = Purse(owner.budget, ledger, model=whom.name, most_reply=whom.max_tokens)
    consent = {"allow_offhost": True, "allow_pictures_offhost": True}  # drawn ones, of a suite
    brain = EndpointBrain(whom.model_copy(update=consent), settings.home, meter=purse)
    try:
        return await score(brain)
    finally:
        await brain.close()
        purse.close()
