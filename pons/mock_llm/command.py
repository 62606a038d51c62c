"""Read the words after ``pons mock-llm``."""

from __future__ import annotations

import argparse

from pydantic import ValidationError

from pons.mock_llm.fault_switches import FAULTS, Switches
from pons.mock_llm.serve import MockOptions, run


def main(words: list[str]) -> int:
    """Serve as told until Ctrl-C; 2 where that makes no sense."""
    grammar = _grammar()
    said = grammar.parse_args(words)
    fault = "status" if said.status is not None else said.fault
    chosen = {
        "fault": fault,
        "times": said.times,
        "delay_s": said.delay,
        "load_s": said.load_s,
        "tokens_per_s": said.tokens_per_s,
        "status": said.status if said.status is not None else 500,
        "retry_after": said.retry_after,
        "transcript": said.transcript,
    }
    try:
        switches = Switches.model_validate(chosen)
    except ValidationError as wrong:
        told = "; ".join(f"{e['loc'][0] if e['loc'] else ''}: {e['msg']}" for e in wrong.errors())
        grammar.error(told)
    return run(MockOptions(said.host, said.port, switches))


def _grammar() -> argparse.ArgumentParser:
    grammar = argparse.ArgumentParser(
        prog="pons mock-llm",
        description="Serve the offline brain over the OpenAI protocol, with faults on demand.",
        epilog='While it runs, POST /mock {"fault": "hang", "times": 1} changes it.',
    )
    grammar.add_argument("--host", default="127.0.0.1")
    grammar.add_argument("--port", type=_port, default=0, help="0 takes a free one")
    grammar.add_argument("--delay", type=float, default=0.0, metavar="S", help="before each reply")
    grammar.add_argument("--load-s", type=float, default=40.0, metavar="S", help="with --cold")
    grammar.add_argument("--tokens-per-s", type=float, metavar="N", help="how fast it writes")
    grammar.add_argument("--times", type=int, metavar="N", help="calls until the fault is gone")
    grammar.add_argument(
        "--transcript",
        default="go to the kitchen",
        metavar="TEXT",
        help="what recordings are heard as",
    )
    grammar.add_argument("--retry-after", metavar="S", help="the header, with --status")
    faults = grammar.add_mutually_exclusive_group()
    faults.add_argument("--status", type=int, metavar="CODE", help=FAULTS["status"])
    for name, what in FAULTS.items():
        if name != "status":
            flag = f"--{name.replace('_', '-')}"
            faults.add_argument(flag, dest="fault", action="store_const", const=name, help=what)
    return grammar


def _port(text: str) -> int:
    if text.isdecimal() and int(text) <= 65_535:
        return int(text)
    raise argparse.ArgumentTypeError(f"{text!r} is no port from 0 to 65535")
