"""Choose the model that an examination asks, agree on its cost, and pay from the home's budget.

The model is the owner's own, or one named on the command line:

``NAME``, ``URL`` or ``NAME@URL``. The part that is not named is the owner's. Where the URL is of
another host than the owner's settings lead to, settings for that host stay behind: the key,
PONS_MODEL_KEY too, `extra_body` and the leaves to send sentences and pictures away. Another host's
key is given together with PONS_MODEL_URL, or where no host is set at all.
"""

from __future__ import annotations

import logging
import os
import sys
from collections.abc import Awaitable, Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, TypeVar

from planner.brain import Brain, OfflineBrain
from planner.budget import Ledger, Purse
from planner.outbound import Address
from planner.settings import (
    BudgetSettings,
    GoalLimits,
    ModelSettings,
    Settings,
    load_settings,
    place_of,
    same_place,
    with_published_price,
)
from pons.terminal import pick
from wire import ConfigError

if TYPE_CHECKING:
    from planner.brain.endpoint import EndpointBrain
    from pons.settings import LaunchSettings

log = logging.getLogger(__name__)
Scored = TypeVar("Scored")

_SCHEMES = ("http://", "https://")
HOW = "NAME, URL or NAME@URL"


@dataclass(frozen=True, slots=True)
class Spending:
    """Count the calls and tokens that an examination cost."""

    calls: int = 0
    prompt_tokens: int = 0
    reply_tokens: int = 0
    money: float = 0.0


def choose_model(
    word: str, home: Path, environment: Mapping[str, str]
) -> tuple[Settings, ModelSettings]:
    """Return the owner's settings with this model in them, and the model.

    Args:
        word: as it stands on the command line; empty for the owner's own model.
        home: where settings.toml lies.
        environment: as ``load_settings`` reads it.

    Raises:
        ConfigError: ``model_not_set``: nothing says which; and all of ``load_settings``.
    """
    name, url = split_word(word)
    elsewhere = _is_elsewhere(url, home, environment)
    named = dict(environment)
    if url:
        named["PONS_MODEL_URL"] = url
    if name:
        named["PONS_MODEL"] = name
    if elsewhere:
        named |= {"PONS_MODEL_ALLOW_OFFHOST": "0", "PONS_MODEL_ALLOW_PICTURES_OFFHOST": "0"}
        if named.pop("PONS_MODEL_KEY", ""):
            log.warning(
                "PONS_MODEL_KEY is not used: it belongs to another host than %s; "
                "if it is this one's, set PONS_MODEL_URL to it as well",
                url,
            )
    try:
        settings = load_settings(home, named)
    except ConfigError as wrong:
        if wrong.code != "model_incomplete":
            raise
        detail = f"which model, and where? give {HOW}, or set [model] in settings.toml: {wrong}"
        raise ConfigError("model_not_set", detail) from None
    model = settings.model
    if model is None:
        detail = f"no model is set; give {HOW}, or set [model] in settings.toml"
        raise ConfigError("model_not_set", detail)
    if url:  # what the owner's model costs says nothing about another
        budget = settings.budget.model_copy(update={"price": None})
        settings = with_published_price(settings.model_copy(update={"budget": budget}), model)
    if elsewhere:
        model = model.model_copy(update={"extra_body": {}})
        settings = settings.model_copy(update={"model": model})
    return settings, model


def _is_elsewhere(url: str, home: Path, environment: Mapping[str, str]) -> bool:
    """Return whether a URL is of another host than the one the owner set everything for."""
    owners = place_of(home, environment)
    return bool(url and owners) and not same_place(owners, url)


def split_word(word: str) -> tuple[str, str]:
    """Return name and URL, each empty where not given."""
    word = word.strip()
    if word.startswith(_SCHEMES):
        return "", word
    for scheme in _SCHEMES:
        name, found, rest = word.partition(f"@{scheme}")
        if found:
            return name, scheme + rest
    return word, ""


def agree_on(bill: str, *, yes: bool) -> bool:
    """Show on standard error the expense or the data to send; return whether a person agrees."""
    print(bill, file=sys.stderr)
    if yes:
        return True
    if not sys.stdin.isatty():  # silence is not consent
        print(f"not_agreed: {pick('give --yes', '请加 --yes')}", file=sys.stderr)
        return False
    return input(f"{pick('Go on?', '继续吗？')} [y/N] ").strip().lower() in ("y", "yes", "是")


@contextmanager
def open_purse(
    settings: Settings, model: ModelSettings, home: Path, limits: GoalLimits
) -> Iterator[tuple[Purse, Path]]:
    """Lend a purse of the home's budget with limits of its own, and a folder that goes away.

    Args:
        settings: the owner's, for the day's limits and prices.
        model: the model that is paid for.
        home: the home whose budget pays.
        limits: of the one goal that the examination is.

    Raises:
        ConfigError: the budget can't be read.
    """
    budget = BudgetSettings(goal=limits, day=settings.budget.day, price=settings.budget.price)
    purse = Purse(budget, Ledger.in_home(home), model=model.name, most_reply=model.max_tokens)
    purse.prepare()
    try:
        with TemporaryDirectory(prefix="pons-eval-") as folder:
            yield purse, Path(folder)
    finally:
        purse.close()


def spending_of(purse: Purse, goal: str) -> Spending:
    """Return one goal's expense so far."""
    spent = purse.usage(goal).goal
    if spent is None:
        return Spending()
    return Spending(spent.calls, spent.prompt_tokens, spent.reply_tokens, spent.money)


async def with_brain(
    launch: LaunchSettings,
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
    return await with_model(launch, model, score, yes=yes, count=count)


async def with_model(
    launch: LaunchSettings,
    model: str,
    score: Callable[[EndpointBrain], Awaitable[Scored]],
    *,
    yes: bool,
    count: int = 0,
) -> Scored:
    """Score a model; it is paid for by the owner's budget.

    Args:
        launch: where the home lies.
        model: NAME, URL or NAME@URL; empty for the owner's own.
        score: asks it.
        yes: what a suite holds, pictures too, may be sent to another machine.
        count: sentences that would be sent; 0 where that is not known.

    Raises:
        ConfigError: ``model_offhost`` and what a model's settings may lack.
    """
    from planner.brain.endpoint import EndpointBrain  # httpx: not for the offline brain

    owner, whom = choose_model(model, launch.home, os.environ)
    address = Address.parse(whom.url)
    if not address.local and not yes:
        sentences = f"{count} sentences" if count else "the sentences"
        detail = f"{sentences} would be sent to {address.host}; if that is meant, say --yes"
        raise ConfigError("model_offhost", detail)
    ledger = Ledger.in_home(launch.home)
    purse = Purse(owner.budget, ledger, model=whom.name, most_reply=whom.max_tokens)
    consent = {"allow_offhost": True, "allow_pictures_offhost": True}  # drawn ones, of a suite
    brain = EndpointBrain(whom.model_copy(update=consent), launch.home, meter=purse)
    try:
        return await score(brain)
    finally:
        await brain.close()
        purse.close()
