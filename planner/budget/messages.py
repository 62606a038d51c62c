"""Say in both languages which budget is used up, how much of it, and when it comes back."""

from __future__ import annotations

from planner.brain.errors import OutOfBudget
from planner.budget.totals import Kind, Overrun
from planner.plan import Bilingual

_KINDS: dict[Kind, tuple[str, str]] = {
    "calls": ("calls", "次调用"),
    "prompt_tokens": ("tokens sent", "个输入 token"),
    "reply_tokens": ("tokens written", "个输出 token"),
    "seconds": ("seconds", "秒"),
    "money": ("", ""),
}


def refusal(over: Overrun, resets_in_s: float, currency: str | None) -> OutOfBudget:
    """Return the error of a limit that the next call would pass."""
    en, zh = _KINDS[over.kind] if over.kind != "money" else (currency or "", currency or "")
    spent, limit = _number(over.spent), _number(over.limit)
    if over.per == "goal":
        when_en = "It does not come back for this goal; give the order anew"
        when_zh = "本任务内不再恢复，请重新下达指令"
    else:
        when_en = f"It comes back at midnight UTC, in {_hours(resets_in_s, ' h ', ' min')}"
        when_zh = f"UTC 零点恢复，还有 {_hours(resets_in_s, ' 小时 ', ' 分钟')}"
    per_en, per_zh = {"goal": ("a goal", "单个任务"), "day": ("the day", "当日")}[over.per]
    said = Bilingual(
        en=f"The model's budget for {per_en} does not hold another call: {spent} of {limit} {en} "
        f"are spent. {when_en}.",
        zh=f"{per_zh}的模型预算不足以再次调用：已用 {spent} / {limit} {zh}。{when_zh}。",
    )
    return OutOfBudget(f"{over.kind} per {over.per}: {spent} of {limit}", said)


UNWRITABLE = Bilingual(
    en="What the model costs can't be written down (is the disk full?), so it is not asked.",
    zh="无法记录模型开销（磁盘可能已满），因此不调用模型。",
)
IDLE = Bilingual(en="No goal asked for this call.", zh="没有任务需要这次调用。")


def _number(value: float) -> str:
    return f"{value:.0f}" if value == int(value) else f"{value:.4g}"


def _hours(seconds: float, hours: str, minutes: str) -> str:
    whole = int(seconds // 60) + 1
    return f"{whole // 60}{hours}{whole % 60}{minutes}"
