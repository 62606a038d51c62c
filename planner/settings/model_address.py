"""Judge where the owner's model is, at the start and before such a setting is saved."""

from __future__ import annotations

from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from planner.outbound import Address
from wire import ConfigError

if TYPE_CHECKING:
    from planner.settings.model import ModelSettings


def need_local_or_allowed(model: ModelSettings) -> Address:
    """Return a model's address, if what people say may be sent there.

    Raises:
        ConfigError: ``model_url``, ``model_offhost``.
    """
    address = Address.parse(model.url)
    if not address.local and not model.allow_offhost:
        raise ConfigError(
            "model_offhost",
            f"what people say would be sent to {address.host}; if that is meant, set "
            "allow_offhost = true in [model], or PONS_MODEL_ALLOW_OFFHOST=1",
        )
    return address


def same_place(one: str, other: str) -> bool:
    """Return whether two URLs lead to one scheme, host and port; a text that is no URL does not."""
    try:
        a, b = urlsplit(one), urlsplit(other)
        return (a.scheme, a.hostname, a.port) == (b.scheme, b.hostname, b.port)
    except ValueError:
        return False
