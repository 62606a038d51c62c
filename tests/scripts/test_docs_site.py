"""Hold the docs as a site: every page has its place, no link is dead, nobody else is asked."""

from __future__ import annotations

from pathlib import Path

import pytest

from scripts import assistant_pages, docs_site, reference
from scripts.generated import GENERATORS
from wire import RobotDescription

CONFIG = "site_name: Tiny\nextra: {generator: false}\ntheme: {name: material, font: false}\n"


def tiny(root: Path, page: str, nav: str = "nav: [{Home: index.md}]\n") -> Path:
    (root / "docs").mkdir()
    (root / "docs" / "index.md").write_text(f"# Home\n\n{page}\n")
    (root / "mkdocs.yml").write_text(CONFIG + nav)
    (root / "pyproject.toml").write_text('version = "0.1.0"\n')
    (root / "LICENSE.md").write_text("# Licence\n\n## Terms\n\n[home](docs/index.md)\n")
    (root / "tool.py").write_text("print('tool')\n")
    return root


def test_every_page_of_the_docs_stands_in_the_nav() -> None:
    assert docs_site.homeless_pages() == []


def test_every_page_that_the_nav_names_is_there_or_to_come(repository: Path) -> None:
    named = docs_site.nav_pages(docs_site.read_config())
    missing = {page for page in named if not (repository / "docs" / page).is_file()}
    assert not missing
    assert len(set(named)) == len(named)


def test_a_page_that_is_not_there_leaves_no_hole_in_the_nav(tmp_path: Path) -> None:
    root = tiny(tmp_path, "x")
    nav = [{"Home": "index.md"}, {"Later": [{"Gone": "gone.md"}]}, {"Terms": "../LICENSE.md"}]
    assert docs_site.present_nav(nav, root) == [{"Home": "index.md"}, {"Terms": "LICENSE.md"}]


def test_what_a_page_names_outside_the_docs_is_laid_beside_it(tmp_path: Path) -> None:
    root = tiny(
        tmp_path, "[terms](../LICENSE.md#terms) [tool](../tool.py) [web](https://x.example)"
    )
    docs_site.stage(root, tmp_path / "out")
    page = (tmp_path / "out" / "index.md").read_text()
    assert "(LICENSE.md#terms)" in page
    assert "(tool.py)" in page
    assert "(https://x.example)" in page
    assert "(index.md)" in (tmp_path / "out" / "LICENSE.md").read_text()


@pytest.mark.parametrize(
    ("page", "nav", "said"),
    [
        ("[a](../LICENSE.md#terms), [b](#home)", None, None),
        ("[a](nowhere.md)", None, "page does not exist"),
        ("[a](../LICENSE.md#nothing)", None, "anchor does not exist"),
        ("<script src='https://cdn.example/x.js'></script>", None, "asks another host"),
        ("x", "nav: [{Terms: ../LICENSE.md}]\n", "no nav of mkdocs.yml names docs/index.md"),
    ],
)
def test_a_site_with_something_dead_or_foreign_fails(
    page: str,
    nav: str | None,
    said: str | None,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    pytest.importorskip("zensical", reason="the extra docs is not installed")
    root = tiny(tmp_path, page) if nav is None else tiny(tmp_path, page, nav)
    code = docs_site.build(root, tmp_path / "built")
    told = capsys.readouterr().out
    assert (code, said is None or said in told) == (0 if said is None else 1, True), told


def test_a_link_to_click_is_no_request() -> None:
    found = docs_site.FOREIGN.search
    assert not found('<a href="https://mcap.dev">x</a>')
    assert found('<link rel=stylesheet href="https://fonts.example/css">')
    assert found("src: url(//cdn.example/a.woff2)")
    assert not found('<link rel="stylesheet" href="assets/a.css">')


def test_a_key_is_told_with_its_bounds_and_the_words_below_it() -> None:
    page = reference.table_page("robot.toml", "", RobotDescription)
    (line,) = (each for each in page.splitlines() if each.startswith("| `max_accel_mps2`"))
    assert (
        line
        == "| `max_accel_mps2` | number | `0.5` | ≥ 0.05, ≤ 3 | At the wheels, away from zero. |"
    )
    assert '`"rplidar"`' in page


def test_every_code_that_is_raised_stands_among_the_codes() -> None:
    page = (reference.DOCS / "codes.md").read_text("utf-8")
    for code in ("port_busy", "other_robot_toml", "hand_taken", "robot_toml_missing"):
        assert f"| `{code}` |" in page
    (line,) = (each for each in page.splitlines() if each.startswith("| `lidar_no_turn` |"))
    assert line.endswith("| [lidars](lidars.md) |")


def test_the_first_sentence_of_a_page_is_prose() -> None:
    text = "# Title\n\n```sh\nmake. it.\n```\n\n| a |\n\nOne **bold** [link](x.md). Two.\n"
    assert assistant_pages.first_sentence(text) == "One bold link."


def test_what_an_assistant_reads_is_made_with_the_other_pages() -> None:
    made = [generator.module for generator in GENERATORS]
    assert made.index("scripts.reference") < made.index("scripts.assistant_pages")
    for command in ("make check", "make docs", "pytest -q"):
        assert command in assistant_pages.agents_page()
