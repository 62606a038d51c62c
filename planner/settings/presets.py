"""List the servers known by name: their address and their capabilities. Data only.

A preset saves typing and a few refused calls; it switches nothing on. `[model]` must name it, with
a model and, for a server elsewhere, with `allow_offhost` and a key of its own: the variables that
vendors' tools read (`OPENAI_API_KEY` and the like) are named in messages and never looked at.

Sources, read in November 2026; the compatible surface counts, not the vendor's own API:

- Ollama: docs.ollama.com/api/openai-compatibility. `response_format`, `reasoning_effort`,
  `stream_options`; a key is ignored.
- LM Studio: lmstudio.ai/docs/developer. `json_schema`, but no `json_object`.
- vLLM: docs.vllm.ai, "OpenAI-compatible server". `chat_template_kwargs`, named tools.
- llama.cpp: tools/server/README.md. `json_schema`; a named `tool_choice` counts as `auto`, which
  makes the tool a weak rung; 503 while it loads.
- OpenAI: platform.openai.com/docs/api-reference/chat. Reasoning models refuse `max_tokens`.
- Anthropic: platform.claude.com/docs/en/api/openai-sdk. `response_format` and `reasoning_effort`
  are ignored, tools work.
- Gemini: ai.google.dev/gemini-api/docs/openai. `reasoning_effort`; some models can't stop
  thinking, so it is made low.
- DashScope: help.aliyun.com/zh/model-studio, "compatible-mode". `enable_thinking`; a tool can't be
  forced while it thinks.
- DeepSeek: api-docs.deepseek.com/guides/thinking_mode. It thinks unless `thinking` says otherwise;
  no `json_schema`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType
from typing import Any, Literal

TokensField = Literal["max_tokens", "max_completion_tokens"]


class JsonMode(StrEnum):
    """The ways to ask an endpoint for JSON, strictest first: the rungs of the ladder."""

    JSON_SCHEMA = "json_schema"
    """The server holds the model to the schema."""
    TOOL = "tool"
    """The model must call one tool, whose arguments are the reply."""
    JSON_OBJECT = "json_object"
    """The server holds the model to any JSON object."""
    PROMPT = "prompt"
    """Nobody holds the model to anything but the prompt."""


class PresetName(StrEnum):
    """The servers known by name."""

    OLLAMA = "ollama"
    LMSTUDIO = "lmstudio"
    VLLM = "vllm"
    LLAMACPP = "llamacpp"
    OPENAI = "openai"
    ANTHROPIC = "anthropic"
    GEMINI = "gemini"
    DASHSCOPE = "dashscope"
    DEEPSEEK = "deepseek"


@dataclass(frozen=True, slots=True)
class Preset:
    """Say where one server is and how it is first asked; a 400 still teaches better."""

    url: str
    key_name: str = ""
    """What the vendor calls the key's variable: a word for messages. Empty: none is needed."""
    mode: JsonMode = JsonMode.JSON_SCHEMA
    """The first rung."""
    tokens_field: TokensField = "max_tokens"
    max_tokens: int = 1000
    """More where thoughts that can't be switched off count as well."""
    system: bool = True
    """It takes a message of the system."""
    quiet: Mapping[str, Any] = field(default_factory=dict)
    """What switches its thoughts off, or makes them short: seconds that a person would wait."""


_NO_TEMPLATE_THOUGHTS: dict[str, Any] = {"chat_template_kwargs": {"enable_thinking": False}}

PRESETS: Mapping[PresetName, Preset] = MappingProxyType(
    {
        PresetName.OLLAMA: Preset(
            "http://127.0.0.1:11434/v1", quiet={"reasoning_effort": "none"}
        ),
        PresetName.LMSTUDIO: Preset("http://127.0.0.1:1234/v1"),
        PresetName.VLLM: Preset("http://127.0.0.1:8000/v1", quiet=_NO_TEMPLATE_THOUGHTS),
        PresetName.LLAMACPP: Preset("http://127.0.0.1:8080/v1", quiet=_NO_TEMPLATE_THOUGHTS),
        PresetName.OPENAI: Preset(
            "https://api.openai.com/v1",
            key_name="OPENAI_API_KEY",
            tokens_field="max_completion_tokens",
            max_tokens=4000,
            quiet={"reasoning_effort": "low"},
        ),
        PresetName.ANTHROPIC: Preset(
            "https://api.anthropic.com/v1", key_name="ANTHROPIC_API_KEY", mode=JsonMode.TOOL
        ),
        PresetName.GEMINI: Preset(
            "https://generativelanguage.googleapis.com/v1beta/openai",
            key_name="GEMINI_API_KEY",
            max_tokens=4000,
            quiet={"reasoning_effort": "low"},
        ),
        PresetName.DASHSCOPE: Preset(
            "https://dashscope.aliyuncs.com/compatible-mode/v1",
            key_name="DASHSCOPE_API_KEY",
            quiet={"enable_thinking": False},
        ),
        PresetName.DEEPSEEK: Preset(
            "https://api.deepseek.com/v1",
            key_name="DEEPSEEK_API_KEY",
            mode=JsonMode.TOOL,
            quiet={"thinking": {"type": "disabled"}},
        ),
    }
)  # fmt: skip


def known_as(name: object) -> Preset | None:
    """Return the preset of a name, which may be anything that TOML holds; None where it is none."""
    if not isinstance(name, str) or name not in set(PresetName):
        return None
    return PRESETS[PresetName(name)]
