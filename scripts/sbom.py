"""Write sbom.cdx.json and docs/licences.md: what Pons runs with, and under which licences.

``python -m scripts.sbom [--check]``. Reads the locks and what installed packages state; asks no
network. A licence that is not on the list below fails, unless it is a named exception.
"""

from __future__ import annotations

import base64
import json
import re
import sys
import tomllib
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import Any
from urllib.parse import quote

from packaging.licenses import InvalidLicenseExpression, canonicalize_license_expression

ROOT = Path(__file__).resolve().parents[1]
BILL = ROOT / "sbom.cdx.json"
TABLE = ROOT / "docs" / "licences.md"

PERMISSIVE = frozenset(
    {
        "0BSD", "Apache-2.0", "BSD-2-Clause", "BSD-3-Clause", "CC0-1.0", "ISC", "MIT", "MIT-0",
        "PSF-2.0", "Zlib",
    }
)  # fmt: skip
EXCEPTIONS = {
    "certifi": "MPL-2.0 file by file: a list of authorities, passed on as it came",
    "lightningcss": "MPL-2.0 file by file: squeezes CSS while the page is built, never shipped",
}
"""Packages whose licence is not permissive, and why that is no matter. A name with a dash and a
platform after it is the same package's binary."""
NOTES = {
    "opencv-python-headless": "its wheel carries FFmpeg (LGPL-2.1-or-later), replaceable",
    "eclipse-zenoh": "taken under Apache-2.0",
}
STATED = {
    "eclipse-zenoh": "EPL-2.0 OR Apache-2.0",
    "cronsim": "BSD-3-Clause",
    "lz4": "BSD-3-Clause",
    "pocketsphinx": "BSD-2-Clause AND BSD-3-Clause",
}
"""What the licence files say where a package's own data names no SPDX expression."""
SPOKEN = {
    "3-clause bsd license": "BSD-3-Clause",
    "apache 2.0": "Apache-2.0",
    "mit license": "MIT",
}
PIN = re.compile(r"^([a-z0-9._-]+)==(\S+)(?: ;.*)? \\$", re.MULTILINE)


TABLE_HEAD = """\
# Licences of what Pons runs with

Made by `python -m scripts.sbom` from the locks and what the packages state; `sbom.cdx.json`
(CycloneDX) has the same for machines, with the binaries for other platforms. A licence that is
not permissive fails the check unless it is named here with its reason. Why each is used:
[adr/0003](adr/0003-dependencies-and-licences.md), [adr/0012](adr/0012-the-page-and-its-tools.md).

| package | version | licence | note |
|---|---|---|---|
"""


class LicenceUnknown(Exception):
    """A package may not be passed on, or states nothing that can be read."""


@dataclass(frozen=True, slots=True)
class Package:
    """Name one locked package."""

    kind: str
    name: str
    version: str
    licence: str
    optional: bool = False
    sha512: str = ""

    @property
    def purl(self) -> str:
        """Return the package's address in a bill of materials."""
        return f"pkg:{self.kind}/{quote(self.name)}@{quote(self.version)}"

    @property
    def note(self) -> str:
        """Return why its licence is taken, where that is not plain."""
        return EXCEPTIONS.get(family(self.name), NOTES.get(self.name, ""))

    def component(self) -> dict[str, Any]:
        """Return it as CycloneDX writes it."""
        hashes = {"hashes": [{"alg": "SHA-512", "content": self.sha512}]} if self.sha512 else {}
        return {
            "type": "library",
            "bom-ref": self.purl,
            "name": self.name,
            "version": self.version,
            "scope": "optional" if self.optional else "required",
            "licenses": [{"expression": self.licence}],
            "purl": self.purl,
            **hashes,
        }


def family(name: str) -> str:
    """Return the name under which an exception may stand."""
    return next((known for known in EXCEPTIONS if name.startswith(f"{known}-")), name)


def judge(name: str, licence: str) -> str:
    """Return a licence as SPDX writes it.

    Raises:
        Unlicensed: no expression, or neither permissive nor excepted.
    """
    try:
        expression = str(canonicalize_license_expression(licence))
    except InvalidLicenseExpression as error:
        raise LicenceUnknown(f"{name}: {licence!r} is no SPDX expression: {error}") from None
    if not is_permissive(expression) and family(name) not in EXCEPTIONS:
        raise LicenceUnknown(
            f"{name}: {expression} is not on the list of permissive licences (scripts/sbom.py)"
        )
    return expression


def is_permissive(expression: str) -> bool:
    """Return whether a choice that the expression leaves is permissive in all that it asks for.

    One with parentheses is judged by a person: none of ours has any.
    """
    return any(
        all(term.strip() in PERMISSIVE for term in choice.split(" AND "))
        for choice in expression.split(" OR ")
    )


def python_packages(lock: str, before: dict[str, str]) -> list[Package]:
    """Return what requirements.lock pins; ``before`` has licences of what is not installed here."""
    found = []
    for name, version in PIN.findall(lock):
        licence = _stated_licence(name) or before.get(f"pkg:pypi/{name}@{version}")
        if licence is None:
            raise LicenceUnknown(f"{name}: not installed here, so its licence can't be read")
        found.append(Package("pypi", name, version, judge(name, licence)))
    return found


def _stated_licence(name: str) -> str | None:
    if name in STATED:
        return STATED[name]
    try:
        told = metadata.metadata(name).json
    except metadata.PackageNotFoundError:
        return None
    said = str(told.get("license_expression") or told.get("license") or "")
    if not said:
        kinds = [kind.rpartition(" :: ")[2] for kind in told.get("classifier", ())
                 if kind.startswith("License")]  # fmt: skip
        said = kinds[0] if len(kinds) == 1 else ""
    return SPOKEN.get(said.lower(), said) or None


def page_packages(lock: str) -> list[Package]:
    """Return what building and showing the page takes."""
    found = []
    for path, told in json.loads(lock)["packages"].items():
        if path and not told.get("dev"):
            name = path.rpartition("node_modules/")[2]
            licence = judge(name, told.get("license", ""))
            digest = base64.b64decode(told["integrity"].removeprefix("sha512-")).hex()
            optional = told.get("optional", False)
            found.append(Package("npm", name, told["version"], licence, optional, digest))
    return found


def bill(packages: list[Package]) -> str:
    """Return the bill of materials; the same locks make the same bytes."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    own = {
        "type": "application",
        "name": project["name"],
        "version": project["version"],
        "licenses": [{"expression": project["license"]}],
    }
    whole = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {"component": own},
        "components": [package.component() for package in packages],
    }
    return json.dumps(whole, indent=1, ensure_ascii=False) + "\n"


def table(packages: list[Package]) -> str:
    """Return the table that a person reads."""
    rows = [
        f"| {one.name} | {one.version} | {one.licence} | {one.note} |"
        for one in packages
        if not one.optional
    ]
    return TABLE_HEAD + "\n".join(rows) + "\n"


def known_before() -> dict[str, str]:
    """Return the licences that the committed bill has, by package."""
    if not BILL.is_file():
        return {}
    components = json.loads(BILL.read_text("utf-8"))["components"]
    return {one["purl"]: one["licenses"][0]["expression"] for one in components}


def main(arguments: list[str]) -> int:
    """Write both files, or with ``--check`` say whether the committed ones are fresh."""
    try:
        packages = [
            *python_packages((ROOT / "requirements.lock").read_text("utf-8"), known_before()),
            *page_packages((ROOT / "web" / "package-lock.json").read_text("utf-8")),
        ]
    except LicenceUnknown as wrong:
        sys.stderr.write(f"licence: {wrong}\n")
        return 1
    texts = {BILL: bill(packages), TABLE: table(packages)}
    if "--check" in arguments:
        return int(any(not f.is_file() or f.read_text("utf-8") != t for f, t in texts.items()))
    for file, text in texts.items():
        file.write_text(text, "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
