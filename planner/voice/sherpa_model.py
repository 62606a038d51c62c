"""Find the owner's streaming sherpa-onnx model, and keep the process that hears by it.

Two kinds are read, as their makers pack them: transducers (zipformer, LSTM, conformer) and
paraformers. Names carry epochs and "int8" in many ways, so a file is known by how its name begins.
"""

from __future__ import annotations

import importlib.util
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from planner.voice.process_client import VoiceWorker
from wire import ConfigError

if TYPE_CHECKING:
    from planner.settings import VoiceSettings

TRANSDUCER = ("encoder", "decoder", "joiner")
PARAFORMER = ("encoder", "decoder")
TOKENS = "tokens.txt"
EXPECTED = (
    "expected tokens.txt, encoder*.onnx and decoder*.onnx, and joiner*.onnx for a transducer: a "
    "streaming model as sherpa-onnx packs it"
)
_LISTED = 12
_PLAIN = frozenset({"decoder"})
"""Small enough that its int8 form only costs accuracy; of the others int8 is preferred."""


@dataclass(frozen=True, slots=True)
class SherpaModel:
    """Hold the paths of one model's files."""

    tokens: Path
    encoder: Path
    decoder: Path
    joiner: Path | None
    """None for a paraformer."""

    @property
    def paths(self) -> dict[str, str]:
        """Return the files by the names that sherpa-onnx gives its arguments."""
        named = {"tokens": self.tokens, "encoder": self.encoder, "decoder": self.decoder}
        if self.joiner is not None:
            named["joiner"] = self.joiner
        return {name: str(path) for name, path in named.items()}


def open_model(settings: VoiceSettings) -> VoiceWorker | None:
    """Return the keeper of the process that hears by the owner's model, or None without one.

    Raises:
        ConfigError: ``voice_contradictory`` beside a server; see ``find_model`` for the folder.
    """
    if settings.folder is None:
        return None
    if settings.url is not None:
        told = "[voice] has both url and folder; one of them hears beside the built-in recogniser"
        raise ConfigError("voice_contradictory", told)
    model = {"sherpa": find_model(settings.folder).paths, "threads": settings.threads}
    return VoiceWorker((), model=model)


def find_model(folder: Path) -> SherpaModel:
    """Return the model in a folder.

    Raises:
        ConfigError: ``voice_folder``: it is no folder, or a file is missing; the text says which
            are expected and what lies there. ``voice_package``: sherpa-onnx is not installed.
    """
    try:
        present = sorted(each.name for each in folder.iterdir() if each.is_file())
    except OSError as error:
        told = f"{folder}: {error.strerror or error}; {EXPECTED}"
        raise ConfigError("voice_folder", told) from None
    found = {role: _choose(role, present) for role in TRANSDUCER}
    needed = {TOKENS: TOKENS in present} | {f"{role}*.onnx": found[role] for role in PARAFORMER}
    missing = [name for name, there in needed.items() if not there]
    if missing:
        told = f"{folder} lacks {', '.join(missing)}; {EXPECTED}; there: {_list(present)}"
        raise ConfigError("voice_folder", told)
    if importlib.util.find_spec("sherpa_onnx") is None:
        told = "[voice] folder needs the package sherpa-onnx: pip install 'pons-robot[sherpa]'"
        raise ConfigError("voice_package", told)
    joiner = found["joiner"]
    return SherpaModel(
        folder / TOKENS,
        folder / str(found["encoder"]),
        folder / str(found["decoder"]),
        None if joiner is None else folder / joiner,
    )


def _choose(role: str, present: list[str]) -> str | None:
    """Return the file of a role; of several the quantised one, of decoders the plain one."""
    fitting = [name for name in present if name.startswith(role) and name.endswith(".onnx")]
    wanted = role not in _PLAIN
    fitting.sort(key=lambda name: (("int8" in name) is not wanted, name))
    return fitting[0] if fitting else None


def _list(present: list[str]) -> str:
    more = len(present) - _LISTED
    told = ", ".join(present[:_LISTED]) or "nothing"
    return f"{told} and {more} more" if more > 0 else told
