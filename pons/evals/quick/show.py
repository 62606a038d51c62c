"""Show an exam: a table for people, in both languages where it judges, or JSON."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

from pons.evals.quick.exam import Exam, ExamPart, ModeResult
from pons.evals.quick.grade import Grade, percentile


def table(exam: Exam, found: Grade, currency: str | None) -> str:
    """Return the exam for a terminal."""
    rows = [("model", f"{exam.model} at {exam.host}"), ("modes", _modes(exam))]
    for part in ExamPart:
        asked = exam.of(part)
        right = sum(m.result == "right" for m in asked)
        rows.append((part.value, f"{right} of {len(asked)} right" if asked else "not asked"))
    rows += [
        ("pictures", _eyes(exam)),
        ("schema", _schema(exam)),
        ("speed", _speed(exam)),
        ("latency", _latency(exam)),
        ("tokens", _tokens(exam)),
        ("cost", _cost(exam, currency)),
    ]
    lines = [f"{name:<10} {text}" for name, text in rows]
    lines += [
        f"  {m.result:<9} {m.question.text} -> {m.made or '-'}"
        for m in exam.marked
        if m.result not in ("right", "not_asked")
    ]
    lines.append(f"{'grade':<10} {found.letter}")
    for reason in found.reasons:
        lines += [f"  {reason.words.en}", f"  {reason.words.zh}"]
    return "\n".join(lines)


def content(exam: Exam, found: Grade, currency: str | None) -> str:
    """Return the exam as JSON."""
    latencies = exam.latencies_s
    record: dict[str, Any] = {
        "model": exam.model,
        "host": exam.host,
        "grade": found.letter,
        "reasons": [asdict(reason) for reason in found.reasons],
        "modes": [asdict(rung) for rung in exam.rungs],
        "parts": {
            part.value: {
                "right": sum(m.result == "right" for m in exam.of(part)),
                "asked": len(exam.of(part)),
            }
            for part in ExamPart
        },
        "pictures": asdict(exam.eyes),
        "speed": asdict(exam.speed),
        "latency_s": {
            "n": len(latencies),
            "p50": percentile(latencies, 0.50) if latencies else None,
            "p95": percentile(latencies, 0.95) if latencies else None,
        },
        "cost": asdict(exam.cost) | {"seconds": exam.took_s, "currency": currency},
        "prompt_tokens_here": exam.prompt_tokens_here,
        "answers": [
            {
                "part": m.question.part.value,
                "text": m.question.text,
                "right_would_be": m.question.right,
                "result": m.result,
                "made": m.made,
                "seconds": m.seconds,
                "calls": m.calls,
            }
            for m in exam.marked
        ],
    }
    return json.dumps(record, ensure_ascii=False, indent=1)


def _modes(exam: Exam) -> str:
    return " · ".join(f"{rung.mode} {_mode(rung)}" for rung in exam.rungs)


def _mode(rung: ModeResult) -> str:
    if rung.right or not rung.asked:
        return "yes" if rung.right else "not asked"
    why = rung.why[:60]
    return f"taken, but {why}" if rung.taken else f"no ({why})"


def _schema(exam: Exam) -> str:
    """Tell whether a word that only the schema knew came back, by which way of asking."""
    found = {True: "binds", False: "taken and not held to", None: "not found out"}
    told = [f"{rung.mode} {found[rung.held]}" for rung in exam.rungs if rung.held is not None]
    return " · ".join(told) or found[None]


def _speed(exam: Exam) -> str:
    first_s, second_s = exam.speed.first_call_s, exam.speed.second_call_s
    if first_s is None:
        return "not measured"
    second = "" if second_s is None else f", the second {second_s:.2f} s"
    rate = exam.speed.tokens_per_s
    pace = "pace not measured: no stream" if rate is None else f"then {rate:.0f} tokens a second"
    return f"first word after {first_s:.2f} s at the first call{second}; {pace}"


def _eyes(exam: Exam) -> str:
    word = {
        "right": "seen: a drawn disc was named and pointed at",
        "wrong": "taken, but not seen",
        "none": "not taken",
        "no_answer": "no answer",
        "not_asked": "not asked",
    }[exam.eyes.result]
    return f"{word} ({exam.eyes.why})" if exam.eyes.why else word


def _latency(exam: Exam) -> str:
    found = exam.latencies_s
    if not found:
        return "none: nothing was answered"
    p50, p95 = percentile(found, 0.50), percentile(found, 0.95)
    return f"p50 {p50:.2f} s, p95 {p95:.2f} s, longest {found[-1]:.2f} s (n {len(found)})"


def _tokens(exam: Exam) -> str:
    calls = max(1, exam.cost.calls)
    sent, written = exam.cost.prompt_tokens / calls, exam.cost.reply_tokens / calls
    here = f"; about {exam.prompt_tokens_here} sent with this robot's places"
    return f"{sent:.0f} sent and {written:.0f} written a call" + (
        here if exam.prompt_tokens_here else ""
    )


def _cost(exam: Exam, currency: str | None) -> str:
    money = f", {exam.cost.money:.4f} {currency}" if currency else ""
    return f"{exam.cost.calls} calls, {exam.took_s:.1f} s{money}"
