"""Change where the robot may be: ``pons fence show|propose FILE|accept ID|reject ID``.

Proposals go through the planner. A yes does not: what would change is worked out here, from the
text itself against the site's own file, and that text is signed and sent straight to the bridge.
A planner that shows one fence and keeps another gains nothing by it.
"""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from planner.site import SiteError, fence_diff
from planner.site.fence import load_fence
from planner.site.places import load_places
from pons.bridge_client import NoBridge, fence_direct
from pons.http import PlannerDown, PlannerProblem, call, tell_unreached
from pons.terminal import refusal
from wire import ConfigError, FenceFile, fingerprint

if TYPE_CHECKING:
    from pathlib import Path

    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_USAGE, EXIT_REFUSED, EXIT_DOWN = 0, 2, 3, 6
PROPOSALS = "/v1/fence/proposals"


ActResult = tuple[dict[str, Any], list[str]]
"""What an act has done, as JSON and as lines."""


class NotSaid(Exception):
    """The order lacks something, or names an absent thing."""


def run(settings: LaunchSettings, act: str, what: str | None, *, as_json: bool = False) -> int:
    """Do one of show, propose, accept, reject; 0 done, 2 bad order, 3 refused, 6 nobody answers."""
    try:
        if act == "show":
            return _show(settings, what, as_json=as_json)
        if what is None:
            raise NotSaid(f"fence_{act}_what: say which {'file' if act == 'propose' else 'id'}")
        do = {"propose": _propose, "accept": _accept, "reject": _reject}[act]
        done, lines = do(settings, what)
        print(json.dumps(done, ensure_ascii=False, indent=1) if as_json else "\n".join(lines))
        return EXIT_DONE
    except NotSaid as wrong:
        print(wrong, file=sys.stderr)
        return EXIT_USAGE
    except (PlannerProblem, SiteError) as refused:
        told = refused.told if isinstance(refused, PlannerProblem) else refused.message
        print(f"refused: {refusal(refused, told)}", file=sys.stderr)
        return EXIT_REFUSED
    except (PlannerDown, NoBridge, ConfigError) as trouble:
        print(
            tell_unreached(trouble) if isinstance(trouble, PlannerDown) else trouble,
            file=sys.stderr,
        )
        return EXIT_DOWN


def _show(settings: LaunchSettings, proposal_id: str | None, *, as_json: bool) -> int:
    if proposal_id is not None:
        item = _review(settings, proposal_id)
        print(json.dumps(item, ensure_ascii=False, indent=1) if as_json else item["text"], end="")
        return EXIT_DONE
    fence = call(settings, "GET", "/v1/fence")
    items = call(settings, "GET", PROPOSALS)["proposals"]
    if as_json:
        print(json.dumps({**fence, "proposals": items}, ensure_ascii=False, indent=1))
        return EXIT_DONE
    known = "the bridge holds it" if fence["agreed"] else f"bridge: {fence['bridge_fence_hash']}"
    print(f"fence {fence['fence_hash']} ({known})")
    for item in items:
        reason = f", last refused: {item['reason']}" if item["reason"] else ""
        print(f"{item['id']}  {item['state']} by {item['by']}{reason}")
        _print_diff(item["diff"])
    if not items:
        print("no proposals")
    return EXIT_DONE


def _propose(settings: LaunchSettings, name: str) -> ActResult:
    try:
        with open(name, encoding="utf-8") as file:  # noqa: PTH123  # a name, not one of our paths
            fence = json.load(file)
    except OSError as error:
        raise NotSaid(f"fence_file_unreadable: {name}: {error.strerror}") from None
    except ValueError as error:
        raise NotSaid(f"fence_file_no_json: {name}: {error}") from None
    item = call(settings, "POST", PROPOSALS, {"fence": fence, "source": "cli"})
    _print_diff(item["diff"])
    accept = f"put it in force while the robot is disarmed: pons fence accept {item['id']}"
    return item, [f"proposed {item['id']}; nothing is in force yet", accept]


def _accept(settings: LaunchSettings, proposal_id: str) -> ActResult:
    item = _review(settings, proposal_id)
    answer = fence_direct(settings, item["text"])
    if not answer.accepted:
        raise PlannerProblem(409, answer.code, answer.detail)
    told = f"accepted: {answer.detail}; bridge and planner start again with it"
    return {"accepted": proposal_id, "detail": answer.detail}, [told]


def _reject(settings: LaunchSettings, proposal_id: str) -> ActResult:
    call(settings, "POST", f"{PROPOSALS}/{proposal_id}/reject", {"source": "cli"})
    return {"rejected": proposal_id}, [f"rejected {proposal_id}"]


def _review(settings: LaunchSettings, proposal_id: str) -> dict[str, Any]:
    """Fetch a proposal, hold its text to its name, and show the changes it would make.

    Raises:
        PlannerProblem: ``fence_proposal_changed`` where the text is not the one of that name.
    """
    item: dict[str, Any] = call(settings, "GET", f"{PROPOSALS}/{proposal_id}")
    text = str(item.get("text", ""))
    if fingerprint(text.encode()) != proposal_id:
        detail = f"the planner's text for {proposal_id} is another one; propose it again"
        raise PlannerProblem(409, "fence_proposal_changed", detail)
    try:
        after = FenceFile.model_validate_json(text, strict=False)
    except ValidationError as error:
        raise PlannerProblem(422, "fence_invalid", str(error).splitlines()[0]) from None
    _print_diff(_diff(settings.site, after))
    return item


def _diff(site: Path, after: FenceFile) -> dict[str, Any]:
    """Compare with the site's own file, not with the planner's word on the fence in force."""
    before = load_fence(site / "fence.json").record
    rooms = [place for place in load_places(site / "places.yaml").places if place.kind == "room"]
    return fence_diff(before, after, rooms).model_dump(mode="json")


def _print_diff(diff: dict[str, Any]) -> None:
    print(
        f"  becomes allowed {diff['added_m2']:.2f} m2, forbidden {diff['removed_m2']:.2f} m2, "
        f"then {diff['allowed_m2']:.2f} m2 in all; "
        f"speed zones {diff['zones_before']} -> {diff['zones_after']}",
        file=sys.stderr,
    )
    for room in diff["rooms"]:
        print(
            f"    {room['room']}: allowed +{room['added_m2']:.2f} m2, "
            f"forbidden {room['removed_m2']:.2f} m2",
            file=sys.stderr,
        )
