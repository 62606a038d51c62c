"""Give the robot a goal from a shell, answer its questions and tell how it went."""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner.language.folding import is_chinese
from planner.language.stop import StopReading, is_stop, read_stop
from pons import stop
from pons.goal_progress import ShownProgress
from pons.http import DEFAULT_TIMEOUT_S, PlannerDown, PlannerProblem, call, tell_unreached
from pons.terminal import pick, refusal
from pons.terminal_text import (
    FINAL_STATES,
    WAITING_STATES,
    figures,
    goal_line,
    how_to_answer,
    message,
    stand_in,
)

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

POLL_S = 0.2
LOST_LIMIT_S = 15.0
"""How long a planner may be away, restarting, before we stop waiting for it."""

LOADING_S = 4.0
"""A plan that has not come by then may wait for a model that is loaded first."""

EXIT = {"succeeded": 0, "failed": 1, "refused": 3, "cancelled": 4}
EXIT_NO_FILE = EXIT_NO_ANSWER = 2
MAX_WAV_BYTES = 3_000_000
"""As many as the planner takes; one more is sent, so that it is the planner who refuses."""
WAV_TIMEOUT_S = 60.0
EXIT_WAITING = 5
SOURCE = "cli"
EXIT_UNREACHED = 6


def say(
    settings: LaunchSettings,
    told: str | Path,
    *,
    wait: bool,
    replace: bool = False,
    as_json: bool = False,
) -> int:
    """Give the goal, a sentence or a recording of one; follow it to its end unless told not to.

    An order to stop goes both ways of `pons stop`, so that no planner is needed for it; so does a
    sentence that may mean stop, where the planner does not answer.

    Args:
        settings: of the robot.
        told: the sentence, or a WAV file.
        wait: whether to follow the goal.
        replace: whether the running goal is forgotten.
        as_json: whether to print the goal alone, as JSON, when it ends, asks or was accepted.
    """
    reading = StopReading.NONE if isinstance(told, Path) else read_stop(told)
    if reading is StopReading.ORDER:
        return stop.run(settings, as_json=as_json)
    try:
        if isinstance(told, Path):
            spoken = _send_sound(settings, told, replace=replace)
            goal, language = spoken["goal"], spoken["language"]
            if not as_json:
                print(_heard_line(spoken))
            if goal is None:
                said = message(spoken["outcome"], pick("en", "zh"))
                print(json.dumps(spoken, ensure_ascii=False) if as_json else f"  {said}")
                return EXIT["refused"]
        else:
            body = {"text": told, "source": SOURCE, **({"replace": True} if replace else {})}
            limit_s = DEFAULT_TIMEOUT_S if reading is StopReading.NONE else stop.HTTP_TIMEOUT_S
            goal, language = call(settings, "POST", "/v1/goals", body, limit_s), language_of(told)
    except OSError as error:
        cure = pick("check its path and rights", "无法读取该文件：请检查路径和权限")
        print(f"unreadable_file: {told}: {error.strerror}; {cure}", file=sys.stderr)
        return EXIT_NO_FILE
    except (PlannerDown, PlannerProblem) as trouble:
        if reading is not StopReading.NONE:
            return stop.run(settings, as_json=as_json)
        return tell_trouble(trouble)
    if not as_json:
        print(goal_line(goal), flush=True)
    elif not wait:
        print(json.dumps(goal, ensure_ascii=False, indent=1))
    return follow(settings, goal["id"], language, as_json=as_json) if wait else 0


def _send_sound(settings: LaunchSettings, path: Path, *, replace: bool) -> dict[str, Any]:
    """Return what the planner heard in a recording.

    Raises:
        OSError: the file can't be read.
        PlannerDown, PlannerProblem: as ``call``.
    """
    with path.open("rb") as file:
        sound = file.read(MAX_WAV_BYTES + 1)
    address = "/v1/voice?replace=true" if replace else "/v1/voice"
    sent = {"Content-Type": "audio/wav"}
    spoken: dict[str, Any] = call(settings, "POST", address, None, WAV_TIMEOUT_S, sent, sound)
    return spoken


def _heard_line(spoken: dict[str, Any]) -> str:
    """Say what was heard by which recogniser, and for which other one where that one failed."""
    by = f"{spoken['recogniser']}, confidence {spoken['confidence']:.2f}"
    instead = f", instead of {spoken['instead_of']}: {spoken['trouble']}"
    return f"heard {spoken['transcript']!r} ({by}{instead if spoken['instead_of'] else ''})"


def language_of(text: str) -> str:
    """Return zh where the text is Chinese, else en."""
    return "zh" if is_chinese(text) else "en"


def act(settings: LaunchSettings, verb: str, goal_id: str | None) -> int:
    """Cancel, pause or resume a goal: the named one, else the one that it must mean.

    Where no goal is paused, a resume clears what holds the robot; so it does without a planner,
    when another brain drives, which a person may let go on.
    """
    try:
        chosen = goal_id or _meant_goal(settings, verb)
        if chosen is None:
            if verb == "resume" and _is_held(settings):
                return _ask_bridge(settings)
            print(f"no_goal: there is nothing to {verb}", file=sys.stderr)
            return 1
        act_on = _resume if verb == "resume" else _post
        goal = act_on(settings, f"/v1/goals/{chosen}/{verb}")
    except (PlannerDown, PlannerProblem) as trouble:
        if verb == "resume" and goal_id is None and isinstance(trouble, PlannerDown):
            return _ask_bridge(settings)
        return tell_trouble(trouble)
    except _NoProof as trouble:
        print(str(trouble), file=sys.stderr)
        return EXIT_UNREACHED
    print(goal_line(goal))
    if verb == "resume" and goal["state"] == "paused":  # a latched or unpowered robot keeps it so
        print("still_paused: `pons why` says what is to be done first", file=sys.stderr)
        return EXIT["refused"]
    return 0


class _NoProof(Exception):
    """This user can't prove to be the operator: no key that counts, or no bridge to sign for."""


def _post(settings: LaunchSettings, path: str) -> dict[str, Any]:
    answer: dict[str, Any] = call(settings, "POST", path, {})
    return answer


def _resume(settings: LaunchSettings, path: str) -> dict[str, Any]:
    """Resume a goal; of a held robot of metal, with a proof that the planner can't make.

    Raises:
        PlannerDown, PlannerProblem: as ``call``.
        _NoProof: a proof is needed, and can't be made here.
    """
    try:
        return _post(settings, path)
    except PlannerProblem as refused:
        if refused.code != "operator_proof_needed":
            raise
    from pons.bridge_client import NoBridge, resume_request
    from wire import ConfigError

    try:
        request = resume_request(settings)
    except (NoBridge, ConfigError) as trouble:
        raise _NoProof(str(trouble)) from None
    proof = request.model_dump(mode="json", include={"id", "proof"})
    answer: dict[str, Any] = call(settings, "POST", path, {"operator": proof})
    return answer


def _is_held(settings: LaunchSettings) -> bool:
    return bool((call(settings, "GET", "/v1/robot").get("status") or {}).get("held"))


def _ask_bridge(settings: LaunchSettings) -> int:
    from pons import operator

    return operator.ask(settings, "resume")


_MEANT = {
    "cancel": (
        "running",
        "planning",
        "paused",
        "needs_clarification",
        "awaiting_confirmation",
        "queued",
    ),
    "pause": ("running",),
    "resume": ("paused",),
}


def _meant_goal(settings: LaunchSettings, verb: str) -> str | None:
    goals = _goals(settings)
    for state in _MEANT[verb]:
        for goal in sorted(goals, key=lambda goal: str(goal["created"]), reverse=True):
            if goal["state"] == state:
                return str(goal["id"])
    return None


def answer(settings: LaunchSettings, words: list[str], *, wait: bool) -> int:
    """Answer the goal that asks, or that is named first, and follow it; a stop stops at once."""
    if is_stop(" ".join(words)) or is_stop(" ".join(words[1:])):
        return stop.run(settings)
    try:
        goals = _goals(settings)
        named = next((goal for goal in goals if goal["id"] == words[0]), None)
        text = " ".join(words[1:] if named else words)
        chosen = named or _asking(goals, _ASKING)
        if chosen is None:
            return 1
        if not text:
            print(f"no_answer: say what to answer: pons answer {words[0]} TEXT", file=sys.stderr)
            return EXIT_NO_ANSWER
        body = {"text": text, "source": SOURCE}
        goal = call(settings, "POST", f"/v1/goals/{chosen['id']}/answer", body)
    except (PlannerDown, PlannerProblem) as trouble:
        return tell_trouble(trouble)
    print(goal_line(goal), flush=True)
    return follow(settings, goal["id"], language_of(text)) if wait else 0


def confirm(settings: LaunchSettings, goal_id: str | None, *, wait: bool) -> int:
    """Say yes to the plan that waits for it, or that is named, and follow it."""
    try:
        goals = _goals(settings) if goal_id is None else []
        chosen = goal_id or (_asking(goals, ("awaiting_confirmation",)) or {}).get("id")
        if chosen is None:
            return 1
        goal = call(settings, "POST", f"/v1/goals/{chosen}/confirm", {"source": SOURCE})
    except (PlannerDown, PlannerProblem) as trouble:
        return tell_trouble(trouble)
    print(goal_line(goal), flush=True)
    return follow(settings, goal["id"], language_of(str(goal["text"]))) if wait else 0


def _goals(settings: LaunchSettings) -> list[dict[str, Any]]:
    goals: list[dict[str, Any]] = call(settings, "GET", "/v1/goals")["goals"]
    return goals


_ASKING = ("needs_clarification", "awaiting_confirmation")


def _asking(goals: list[dict[str, Any]], states: tuple[str, ...]) -> dict[str, Any] | None:
    """Return the one goal that waits for a person's word; where it is not one, list them."""
    waiting = [goal for goal in goals if goal["state"] in states]
    if len(waiting) == 1:
        return waiting[0]
    if not waiting:
        none = pick("nothing waits for your answer", "没有任务在等待您的回答")
        print(f"no_goal: {none}", file=sys.stderr)
        return None
    print(f"which_goal: {pick('name one:', '请指明一个：')}", file=sys.stderr)
    for goal in waiting:
        asked = message(goal.get("outcome"), language_of(str(goal["text"])))
        print(f"  {goal_line(goal)}" + (f"\n    {asked}" if asked else ""), file=sys.stderr)
    return None


def follow(settings: LaunchSettings, goal_id: str, language: str, *, as_json: bool = False) -> int:
    """Print each change until the goal ends or needs a person; as JSON, only how it ended."""
    shown = ShownProgress(silent=as_json)
    begun_s = heard_s = time.monotonic()
    try:
        while True:
            try:
                goal = call(settings, "GET", f"/v1/goals/{goal_id}")
                heard_s = time.monotonic()
            except PlannerDown as trouble:
                if time.monotonic() - heard_s > LOST_LIMIT_S:
                    return tell_trouble(trouble)
                time.sleep(POLL_S)
                continue
            except PlannerProblem as trouble:
                return tell_trouble(trouble)
            shown.show(goal)
            if (
                not as_json
                and goal["state"] == "planning"
                and time.monotonic() - begun_s > LOADING_S
            ):
                _tell_load(settings, language, shown)
            if goal["state"] in FINAL_STATES | WAITING_STATES:
                shown.clear()
                if as_json:
                    print(json.dumps(goal, ensure_ascii=False, indent=1))
                    return EXIT.get(str(goal["state"]), EXIT_WAITING)
                return _conclude(goal, language)
            time.sleep(POLL_S)
    except KeyboardInterrupt:
        print(f"\n{goal_id} goes on; `pons stop` stops the robot, `pons cancel` ends the goal")
        return 130


def _tell_load(settings: LaunchSettings, language: str, shown: ShownProgress) -> None:
    """Say once why no plan comes, where the model's server may still be loading it."""
    from planner.language.catalogue import say as words  # only here: its words are read from a file
    from planner.plan import Language

    told = f"  {words('model_error.slow').of(Language(language))}"
    if not shown.has(told) and call(settings, "GET", "/v1/robot")["brain"]["loads"]:
        shown.print_new([told])


def _conclude(goal: dict[str, Any], language: str) -> int:
    outcome = goal.get("outcome") or {}
    for line in (stand_in(goal, language), message(outcome, language), figures(outcome)):
        if line:
            print(f"  {line}")
    plan = goal.get("plan") or {}
    options = plan.get("options") or []
    for number, option in enumerate(options, 1):
        mark = f"{number}." if len(options) > 1 else "-"
        print(f"    {mark} {option if isinstance(option, str) else option.get('text', option)}")
    if hint := how_to_answer(goal, language):
        print(f"  {hint}")
    return EXIT.get(str(goal["state"]), EXIT_WAITING)


def tell_trouble(trouble: Exception) -> int:
    """Say what went wrong, once; return 3 where the planner refused, 6 where nobody answers."""
    if isinstance(trouble, PlannerProblem):
        print(f"refused: {refusal(trouble, trouble.told)}", file=sys.stderr)
        return EXIT["refused"]
    print(tell_unreached(trouble), file=sys.stderr)
    return EXIT_UNREACHED
