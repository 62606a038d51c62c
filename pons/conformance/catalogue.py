"""List every fault, in the order in which they are played."""

from __future__ import annotations

from pons.conformance import faults_ages, faults_links, faults_rights, faults_values
from pons.conformance.adapter import CannotTest
from pons.conformance.fault import Fault

FAULTS: tuple[Fault, ...] = (
    *faults_values.FAULTS,
    *faults_ages.FAULTS,
    *faults_links.FAULTS,
    *faults_rights.FAULTS,
)


def chosen(names: list[str], *, quick: bool) -> tuple[Fault, ...]:
    """Return the faults of these names, the short run's, or all.

    Raises:
        CannotTest: a name is unknown.
    """
    known = {fault.name for fault in FAULTS}
    unknown = [name for name in names if name not in known]
    if unknown:
        listed = ", ".join(sorted(known))
        raise CannotTest(f"fault_unknown: {', '.join(unknown)}; there are: {listed}")
    if names:
        return tuple(fault for fault in FAULTS if fault.name in names)
    return tuple(fault for fault in FAULTS if fault.quick) if quick else FAULTS
