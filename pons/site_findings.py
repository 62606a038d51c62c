"""Print what is wrong with a site, by its files and by what people taught on its map.

The check of a site reads its folder alone; rooms named at the page lie in the home's store.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from pons.site_rooms import has_named_room
from pons.terminal import pick

if TYPE_CHECKING:
    from pathlib import Path

    from planner.navigation.site_check import SiteFinding


def print_findings(
    folder: Path,
    home: Path,
    radius_m: float,
    *,
    taught_in: Path | None = None,
    as_json: bool = False,
) -> list[SiteFinding]:
    """Print a line for each finding; return the findings.

    Args:
        folder: the site's.
        home: where the state lies, and in it what people taught.
        radius_m: of the robot.
        taught_in: the site on whose map they taught it; None: on this one's.
        as_json: whether to print one object in their place.

    Raises:
        SiteError: the site or the store of taught places can't be read.
    """
    from planner.navigation.site_check import check_site

    found = [*check_site(folder, radius_m), *reserved_name_findings(folder)]
    if any(finding.code == "no_rooms" for finding in found):
        named = has_named_room(taught_in or folder, home)
        found = [finding for finding in found if not (named and finding.code == "no_rooms")]
    if as_json:
        told = [
            {"level": one.level, "code": one.code, "message": one.words.model_dump()}
            for one in found
        ]
        print(json.dumps({"findings": told}, ensure_ascii=False, indent=1))
        return found
    for finding in found:
        words = pick(finding.words.en, finding.words.zh)
        print(f"{finding.level}: {finding.code}: {words}")
    return found


def reserved_name_findings(folder: Path) -> list[SiteFinding]:
    """Return a finding for each name of the site's files that `pons site name` would refuse."""
    from planner.language.catalogue import say
    from planner.navigation.site_check import SiteFinding
    from planner.site import Site, SiteError, reserved_names

    try:
        site = Site.load(folder)
    except SiteError:
        return []  # the check tells why
    code = "place_name_reserved"
    return [
        SiteFinding(code, "warning", say(f"site_check.{code}", place=place.id, name=name))
        for place, name in reserved_names(site)
    ]
