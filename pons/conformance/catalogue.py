"""List every fault, in the order in which they are played."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from pons.conformance import faults_ages, faults_links, faults_rights, faults_values
from pons.conformance.adapter import CannotTest
from pons.conformance.fault import Fault, W, X

if TYPE_CHECKING:
    from wire import OwnerKind

FAULTS: tuple[Fault, ...] = (
    *faults_values.FAULTS,
    *faults_ages.FAULTS,
    *faults_links.FAULTS,
    *faults_rights.FAULTS,
)


def choose_faults(
    names: list[str], *, quick: bool, kinds: tuple[OwnerKind, ...] = (X, W)
) -> tuple[Fault, ...]:
    """Return the faults of these names, the short run's, or all, for these brains.

    Raises:
        CannotTest: a name is unknown.
    """
    known = {fault.name for fault in FAULTS}
    unknown = [name for name in names if name not in known]
    if unknown:
        listed = ", ".join(sorted(known))
        raise CannotTest(f"fault_unknown: {', '.join(unknown)}; there are: {listed}")
    rows = []
    for fault in FAULTS:
        mine = fault.quick if quick and not names else fault.kinds
        mine = tuple(kind for kind in mine if kind in kinds)
        if mine and (not names or fault.name in names):
            rows.append(replace(fault, kinds=mine))
    return tuple(rows)
