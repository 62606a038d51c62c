"""The bounds fit the files that a process may open; an address is what one network owns."""

from __future__ import annotations

import resource

import pytest

from planner.api.crowd import RESERVED_FILES, Bounds, address_of, raise_files


@pytest.mark.parametrize("files", [64, 256, 512, 1_024, 4_096, 65_536])
def test_connections_leave_files_for_everything_else(files: int) -> None:
    bounds = Bounds().limit_to_files(files)
    assert bounds.an_address <= bounds.all < bounds.burst
    assert bounds.burst + RESERVED_FILES <= max(files, RESERVED_FILES + 16)


def test_the_soft_limit_of_files_becomes_the_hard_one() -> None:
    before = resource.getrlimit(resource.RLIMIT_NOFILE)
    low = 1_000
    try:
        resource.setrlimit(resource.RLIMIT_NOFILE, (low, before[1]))
        found = raise_files()
        assert resource.getrlimit(resource.RLIMIT_NOFILE)[0] == found
        assert found > low or before[1] == low
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, before)


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ("192.0.2.1", "192.0.2.2", False),
        ("192.0.2.1", "::ffff:192.0.2.1", True),
        ("2001:db8::1", "2001:db8::ffff:1", True),
        ("2001:db8:0:1::1", "2001:db8:0:2::1", False),
        ("fe80::1%eth0", "fe80::2%eth0", True),
        ("", "unknown", False),
    ],
)
def test_an_address_is_what_one_network_owns(one: str, other: str, same: bool) -> None:
    assert (address_of(one) == address_of(other)) is same
