"""Call servers that the owner named, and only those: judged addresses, one key, bounded answers."""

from planner.outbound.address import Address, CallTarget, TargetResolver, refused_among
from planner.outbound.errors import CallFailure
from planner.outbound.secret import Secret

__all__ = [
    "Address",
    "CallFailure",
    "CallTarget",
    "Secret",
    "TargetResolver",
    "refused_among",
]
