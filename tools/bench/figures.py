"""Turn samples into figures. Pure arithmetic."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, exp, lgamma, log, sqrt

NONE_SEEN_95 = 3.0
"""Rule of three: where n trials showed none, the rate is below 3/n with 95 % confidence."""


def percentile(samples: Sequence[float], share: float) -> float:
    """Return the smallest sample that at least ``share`` of all do not exceed (nearest rank).

    Raises:
        ValueError: there are no samples.
    """
    if not samples:
        raise ValueError("no samples")
    ranked = sorted(samples)
    return ranked[max(0, ceil(share * len(ranked)) - 1)]


@dataclass(frozen=True, slots=True)
class Figures:
    """Summarise one set of samples."""

    n: int
    p25: float
    p50: float
    p75: float
    p99: float
    low: float
    high: float

    @classmethod
    def of(cls, samples: Sequence[float]) -> Figures:
        """Compute all figures. Raises ValueError where there are no samples."""
        p25, p50, p75, p99 = (percentile(samples, share) for share in (0.25, 0.50, 0.75, 0.99))
        return cls(len(samples), p25, p50, p75, p99, min(samples), max(samples))


def none_in(n: int) -> str:
    """Say what zero of n means."""
    return (
        f"0 of {n} (< {min(1.0, NONE_SEEN_95 / n):.2%} with 95 % confidence)" if n else "no trials"
    )


def poisson_upper_95(count: int) -> float:
    """Return the upper end of the exact two-sided 95 % interval of a Poisson mean (Garwood 1936).

    The mean at which ``count`` or fewer come with a chance of 2.5 %, by bisection.
    """
    low, high = float(count), count + 10.0 * sqrt(count + 1.0)
    while high - low > 1e-6 * high:
        middle = (low + high) / 2
        low, high = (middle, high) if _at_most(count, middle) > 0.025 else (low, middle)
    return high


def _at_most(count: int, mean: float) -> float:
    """Return the chance of ``count`` or fewer events of a Poisson process."""
    if not mean > 0.0:
        return 1.0
    logs = (k * log(mean) - mean - lgamma(k + 1.0) for k in range(count + 1))
    return sum(map(exp, logs))
