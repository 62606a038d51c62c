"""Write a card whose numbers are those that were measured."""

from __future__ import annotations

from tools.train.card import card
from tools.train.evaluation import judge_model, least_of, table
from tools.train.score import ScoredThing, TrueThing


def test_the_card_states_what_was_measured() -> None:
    cup = TrueThing("cup", (0.0, 0.0, 10.0, 10.0))
    found = [ScoredThing("cup", 0.9, cup.box)]
    judge = judge_model([([cup], found), ([], [])], [([], [])], least_of(None) | {"cup": 0.47})
    judge["ms_p50"] = 7.25
    fit = {
        "gflops": 0.376,
        "frames": 4000,
        "epochs": 8,
        "seconds": 1500,
        "threads": 1,
        "steps": 2000,
        "batch": 16,
        "small_share": 0.5,
        "plain_share": 0.2,
        "seed": 6,
        "torch": "2.13.0",
    }
    export = {
        "parameters": 263630,
        "bytes": 1155067,
        "opset": 17,
        "commit": "abc1234",
        "worst_difference": 2e-5,
    }
    text = card({"drawn": {"seconds": 300.0}, "fit": fit, "export": export, "judge": judge})
    for said in (
        "| frames | 4000 | 20000 |",
        "| drawing and fitting | 30 min, 1 threads | 2 h on 2 cores |",
        "| mAP50 | 1.000 | >= 0.85 |",
        "| false detections in an empty frame | 0.000 | <= 0.02 |",
        "| cup | 1 | 1.000 | 0.47 | 1.000 | 1.000 |",
        "2000 steps of 16 frames",
        "the first 50% of them in a smaller size",
        "abc1234",
        "| from bytes to boxes, one thread | 7.2 ms | |",
    ):
        assert said in text
    assert "mAP50 1.000 on 2 frames" in table(judge)
