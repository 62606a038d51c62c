"""Run ``pons eval --quick``: announce the cost, ask, examine, grade, show."""

from __future__ import annotations

import asyncio
import os
import sys
import time
from typing import TYPE_CHECKING

from planner.budget.totals import cost
from planner.outbound import Address
from pons.evals.model_access import agree_on, choose_model
from pons.evals.quick.ask import PROMPT_TOKENS, Caps, examine
from pons.evals.quick.grade import grade
from pons.evals.quick.show import content, table
from pons.terminal import pick
from wire import ConfigError

if TYPE_CHECKING:
    from planner.settings import ModelSettings, Settings
    from pons import settings as places

EXIT = {"A": 0, "B": 0, "C": 1, "D": 2, "F": 2}
"""As for the rest of the doctor: 0 well, 1 less well, 2 not fit to plan."""
REFUSED = 2


def run(
    where: places.LaunchSettings,
    word: str,
    *,
    as_json: bool,
    yes: bool,
    caps: Caps | None = None,
    called: str = "pons doctor --model",
) -> int:
    """Examine the model of a word; 2 where it can't be or may not be asked.

    Args:
        where: home and site.
        word: the model, as :func:`choose_model` reads it.
        as_json: print one JSON object.
        yes: spend without asking.
        caps: where the exam ends.
        called: the command's words, as an error begins.
    """
    caps = caps or Caps()
    try:
        settings, model = choose_model(word, where.home, os.environ)
        address = Address.parse(model.url)
        if not address.local and not agree_on(_bill(settings, model, address.host, caps), yes=yes):
            return REFUSED
        site = where.site if where.site.is_dir() else None
        exam = asyncio.run(
            examine(settings, model, where.home, site, caps, time.monotonic, _tell_waiting)
        )
    except ConfigError as wrong:
        print(f"{called}: {wrong}", file=sys.stderr)
        return REFUSED
    found = grade(exam)
    currency = settings.budget.price.currency if settings.budget.price is not None else None
    print(content(exam, found, currency) if as_json else table(exam, found, currency))
    return EXIT[found.letter]


def _tell_waiting() -> None:
    told = pick(
        "waiting for its first word: the model may be loading", "正在等待第一个词：模型可能还在加载"
    )
    print(told, file=sys.stderr)


def _bill(settings: Settings, model: ModelSettings, host: str, caps: Caps) -> str:
    """Give an exam's highest cost, before it costs anything."""
    sent, written = caps.calls * PROMPT_TOKENS, caps.calls * model.max_tokens
    price = settings.budget.price
    money = pick("no price is set in [budget.price]", "[budget.price] 未设价格")
    if price is not None:
        most = pick("at most", "最多")
        money = f"{most} {cost(price, sent, written):.2f} {price.currency}"
    return pick(
        f"The exam asks {model.name} at {host}, which is not this machine: at most {caps.calls} "
        f"calls in {caps.seconds:.0f} s, at most {sent} tokens sent and {written} written "
        f"({money}). Only the exam's own sentences and a drawn picture are sent.",
        f"考试将调用 {host}（不是本机）上的 {model.name}："
        f"最多 {caps.calls} 次、{caps.seconds:.0f} 秒，"
        f"最多发送 {sent}、生成 {written} 个 token（{money}）。只发送考题本身和一张绘制的图。",
    )
