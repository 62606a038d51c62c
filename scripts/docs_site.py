"""Build the docs as a site, strictly, and look through it: ``python -m scripts.docs_site``.

The pages stay as a repository shows them, so what they name outside docs/ is laid beside them
first. Builds with Zensical into build/docs/site; a dead link, a dead anchor, a page that asks
another host for something, or one that no nav names ends with 1. Knows no page's words.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import yaml

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT = Path(__file__).resolve().parents[1]
PLACE = ROOT / "build" / "docs"
LINK = re.compile(r"(\]\()([^)\s#]+)((?:#[^)\s]*)?\))")
SCHEME = re.compile(r"^[a-z][a-z0-9+.-]*:")
FOREIGN = re.compile(
    r"<(?:script|img|iframe|source|video|audio|link)\b[^>]*?\b(?:src|href)=[\"']?(?:https?:)?//[^\"'\s>]+"
    r"|url\([\"']?(?:https?:)?//[^)]+|@import[^;]*//[^;]+|class=\"?mermaid"
)
"""What a browser would fetch from elsewhere. A link that a person may click is none of it."""


def staged_name(path: Path, root: Path = ROOT) -> str:
    """Return where a file of the repository lies in the site: docs/ is its top."""
    inside = path.relative_to(root)
    if inside.parts[0] == "docs":
        return inside.relative_to("docs").as_posix()
    return inside.name if len(inside.parts) == 1 else f"files/{inside.as_posix()}"


def stage(root: Path, target: Path) -> None:
    """Lay the pages, and each file that one of them links to, below ``target``."""
    left = [path for path in sorted((root / "docs").rglob("*")) if path.is_file()]
    left += [
        (root / "docs" / name).resolve()
        for name in nav_pages(read_config(root))
        if name.startswith("../")
    ]
    seen = set(left)
    while left:
        path = left.pop()
        out = target / staged_name(path, root)
        out.parent.mkdir(parents=True, exist_ok=True)
        if path.suffix != ".md":
            shutil.copyfile(path, out)
            continue
        text, named = with_staged_links(path, root)
        out.write_text(text, "utf-8")
        left += named - seen
        seen |= named


def with_staged_links(path: Path, root: Path) -> tuple[str, set[Path]]:
    """Return a page with its links as they lie in the site, and the files that they name."""
    named: set[Path] = set()
    here = Path(staged_name(path, root)).parent

    def staged_link(found: re.Match[str]) -> str:
        target = (path.parent / found[2]).resolve()
        if SCHEME.match(found[2]) or not target.is_relative_to(root):
            return found[0]
        if target.is_dir():
            target /= "index.md"
        if not target.is_file():
            return found[0]  # dead: the build says where
        named.add(target)
        return found[1] + os.path.relpath(staged_name(target, root), here) + found[3]

    return LINK.sub(staged_link, path.read_text("utf-8")), named


def read_config(root: Path = ROOT) -> dict[str, Any]:
    """Return mkdocs.yml."""
    return dict(yaml.safe_load((root / "mkdocs.yml").read_text("utf-8")))


def nav_pages(config: dict[str, Any]) -> list[str]:
    """Return the pages that the nav names, from docs/ on."""

    def walk(entry: object) -> Iterator[str]:
        if isinstance(entry, str):
            yield entry
        elif isinstance(entry, dict):
            for inner in entry.values():
                yield from walk(inner)
        elif isinstance(entry, list):
            for inner in entry:
                yield from walk(inner)

    return list(walk(config["nav"]))


def present_nav(entry: Any, root: Path) -> Any:
    """Return the nav of the pages that are there, by where they lie in the site."""
    if isinstance(entry, str):
        path = (root / "docs" / entry).resolve()
        return staged_name(path, root) if path.is_file() else None
    if isinstance(entry, dict):
        kept = {name: present_nav(inner, root) for name, inner in entry.items()}
        return {name: inner for name, inner in kept.items() if inner} or None
    return [inner for each in entry if (inner := present_nav(each, root))]


def homeless_pages(root: Path = ROOT) -> list[str]:
    """Return the pages of docs/ that no nav names; decisions are named by their index."""
    named = set(nav_pages(read_config(root)))
    pages = (path.relative_to(root / "docs").as_posix() for path in (root / "docs").rglob("*.md"))
    return sorted(page for page in pages if page not in named and not re.match(r"adr/\d{4}-", page))


def foreign_requests(site: Path) -> list[str]:
    """Return what a browser would ask of another host, each with its file."""
    return [
        f"{path.relative_to(site)}: {found[0][:120]}"
        for path in sorted(site.rglob("*"))
        if path.suffix in (".html", ".css")
        for found in FOREIGN.finditer(path.read_text("utf-8"))
    ]


def build(root: Path = ROOT, place: Path = PLACE) -> int:
    """Build into ``place``/site; print what is wrong; return 1 where something is."""
    if find_spec("zensical") is None:
        print("site_generator_missing: `.venv/bin/pip install -e '.[docs]'` brings Zensical")
        return 1
    began_s = time.monotonic()
    shutil.rmtree(place, ignore_errors=True)
    stage(root, place / "source")
    config = read_config(root)
    config |= {"docs_dir": "source", "nav": present_nav(config["nav"], root)}
    version = re.search(
        r'^version = "(.+)"$', (root / "pyproject.toml").read_text("utf-8"), re.MULTILINE
    )
    config["copyright"] = f"Pons {version[1] if version else ''}, Apache-2.0"
    (place / "mkdocs.yml").write_text(yaml.safe_dump(config, allow_unicode=True), "utf-8")
    command = [sys.executable, "-m", "zensical", "build", "--clean", "--strict"]
    made = subprocess.run(
        command,
        cwd=place,
        env={**os.environ, "NO_COLOR": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    wrong = [f"no nav of mkdocs.yml names docs/{page}" for page in homeless_pages(root)]
    if made.returncode:
        wrong.append(without_colour(made.stdout + made.stderr))
    else:
        wrong += [f"asks another host: {line}" for line in foreign_requests(place / "site")]
    print("\n".join([*wrong, f"{place / 'site'}: {time.monotonic() - began_s:.1f} s"]))
    return 1 if wrong else 0


def without_colour(text: str) -> str:
    """Return what Zensical printed as plain text."""
    return re.sub(r"\x1b\[[0-9;]*m", "", text)


if __name__ == "__main__":
    sys.exit(build())
