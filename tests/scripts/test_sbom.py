"""The bill of materials is true to the locks, and no licence slips in."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from scripts.sbom import (
    EXCEPTIONS,
    PIN,
    LicenceUnknown,
    bill,
    is_permissive,
    judge,
    page_packages,
    python_packages,
    table,
)
from tests.scripts.test_lock import pins


@pytest.mark.parametrize(
    ("expression", "permissive"),
    [
        ("MIT", True),
        ("EPL-2.0 OR Apache-2.0", True),
        ("BSD-3-Clause AND 0BSD AND MIT", True),
        ("MIT AND GPL-3.0-only", False),
        ("GPL-3.0-only OR MIT AND MPL-2.0", False),
        ("AGPL-3.0-or-later", False),
        ("(MIT OR GPL-3.0-only) AND MIT", False),
        ("GPL-3.0-only WITH GCC-exception-3.1", False),
        ("", False),
    ],
)
def test_an_expression_is_permissive_where_one_whole_choice_is(
    expression: str, permissive: bool
) -> None:
    assert is_permissive(expression) is permissive


@pytest.mark.parametrize(
    "licence", ["GPL-3.0-only", "AGPL-3.0-only", "Proprietary", "", "BSD License", "MPL-2.0"]
)
def test_what_is_not_permissive_fails_by_name(licence: str) -> None:
    with pytest.raises(LicenceUnknown, match="sounddevice"):
        judge("sounddevice", licence)


def test_exceptions_are_by_name_and_given_no_further() -> None:
    assert judge("certifi", "MPL-2.0") == "MPL-2.0"
    assert judge("lightningcss-linux-x64-gnu", "MPL-2.0") == "MPL-2.0"
    with pytest.raises(LicenceUnknown):
        judge("certifiable", "MPL-2.0")
    assert all(len(reason) > 20 for reason in EXCEPTIONS.values())


def test_a_package_that_is_not_installed_here_keeps_what_was_read_elsewhere() -> None:
    lock = "nowhere-to-be-found==1.0 ; python_version == '3.12' \\\n    --hash=sha256:00\n"
    with pytest.raises(LicenceUnknown, match="not installed here"):
        python_packages(lock, {})
    before = {"pkg:pypi/nowhere-to-be-found@1.0": "MIT"}
    assert [one.licence for one in python_packages(lock, before)] == ["MIT"]
    with pytest.raises(LicenceUnknown):
        python_packages(lock, {"pkg:pypi/nowhere-to-be-found@1.0": "GPL-3.0-only"})


def test_the_bill_has_each_pin_and_only_what_is_locked(repository: Path) -> None:
    components = json.loads((repository / "sbom.cdx.json").read_text("utf-8"))["components"]
    listed = [(one["name"], one["version"]) for one in components if "pypi" in one["purl"]]
    lock = (repository / "requirements.lock").read_text("utf-8")
    assert sorted(listed) == sorted(PIN.findall(lock))
    assert {name for name, _ in listed} == set(pins(repository / "requirements.lock"))
    assert {"preact", "vite"} <= {one["name"] for one in components}
    assert "vitest" not in {one["name"] for one in components}


def test_the_same_locks_make_the_same_bytes_and_name_no_place(repository: Path) -> None:
    lock = (repository / "web" / "package-lock.json").read_text("utf-8")
    first, second = page_packages(lock), page_packages(lock)
    assert bill(first) == bill(second)
    assert table(first) == table(second)
    for text in (bill(first), (repository / "sbom.cdx.json").read_text("utf-8")):
        assert not re.search(r"https?://|\d{4}-\d\d-\d\dT", text)
