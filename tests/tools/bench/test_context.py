"""Long runs go on where they were cut off; a lost slice costs only itself."""

from __future__ import annotations

from pathlib import Path

import pytest

from tools.bench.context import BenchLab, MeasurementFailure, until
from tools.bench.store import Store


def lab(path: Path, *, resume: bool = True, commit: str = "c1") -> BenchLab:
    return BenchLab(Store(path / "results.jsonl", resume, commit, "m1"), long=True, name="bench")


def squares(bench: BenchLab, count: int, calls: list[int]) -> list[int]:
    def take(index: int) -> int:
        calls.append(index)
        return index * index

    return list(bench.slices("square", count, take))


def test_a_resumed_run_takes_only_what_is_missing(tmp_path: Path) -> None:
    calls: list[int] = []
    assert squares(lab(tmp_path), 3, calls) == [0, 1, 4]
    with (tmp_path / "results.jsonl").open("a") as file:
        file.write('{"kind": "slice", "name": "ben')  # cut off in the middle of a line
        file.write("\n")
    assert squares(lab(tmp_path), 5, calls) == [0, 1, 4, 9, 16]
    assert calls == [0, 1, 2, 3, 4]


@pytest.mark.parametrize(("resume", "commit"), [(False, "c1"), (True, "c2")])
def test_another_commit_or_a_fresh_run_takes_all(tmp_path: Path, resume: bool, commit: str) -> None:
    calls: list[int] = []
    squares(lab(tmp_path), 2, calls)
    squares(lab(tmp_path, resume=resume, commit=commit), 2, calls)
    assert calls == [0, 1, 0, 1]


def test_a_lost_slice_is_named_and_the_others_are_kept(tmp_path: Path) -> None:
    bench = lab(tmp_path)

    def take(index: int) -> int:
        if index == 1:
            raise MeasurementFailure("the robot did not come\nand did not say why")
        return index

    assert list(bench.slices("drive", 3, take)) == [0, 2]
    assert bench.lost == ["drive 2: the robot did not come | and did not say why"]


def test_when_the_time_is_up_no_slice_is_begun(tmp_path: Path) -> None:
    bench = lab(tmp_path)
    bench.end_s = 0.0
    assert squares(bench, 3, []) == []
    assert bench.lost == ["square 1 to 3: the time was up"]


def test_waiting_ends_with_what_was_waited_for() -> None:
    with pytest.raises(MeasurementFailure, match="a miracle: not within"):
        until(lambda: False, 0.01, "a miracle", 0.001)


def test_lent_folders_are_empty_short_and_gone_afterwards(tmp_path: Path) -> None:
    with lab(tmp_path).folder() as folder:
        (folder / "file").write_text("x")
        assert len(str(folder / "run" / "localization.sock")) < 107
    assert not folder.exists()
