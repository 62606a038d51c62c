"""Ask with LangChain's agent, its response held to the schema by the server ("provider").

Run as ``python -m tools.bench.peers.langchain_agent FACTS`` in the peers' environment.
"""

from __future__ import annotations

import sys
from importlib.metadata import version

from langchain.agents import create_agent
from langchain.agents.structured_output import ProviderStrategy
from langchain_openai import ChatOpenAI

from tools.bench.peers.loop import take_turns
from tools.bench.peers.shape import PeerFacts, check, plan_model

PARTS = ("langchain", "langchain-openai", "langgraph")


def main(path: str) -> None:
    """Take turns with the bench."""
    facts = PeerFacts.load(path)
    model = ChatOpenAI(model="langchain", base_url=facts.url, api_key="none", temperature=0.0)
    shape = ProviderStrategy(plan_model(facts))
    agent = create_agent(model, tools=[], system_prompt=facts.system, response_format=shape)

    async def plan_once() -> None:
        done = await agent.ainvoke({"messages": [{"role": "user", "content": facts.order}]})
        check(done["structured_response"], facts)

    take_turns("langchain", {part: version(part) for part in PARTS}, plan_once)


if __name__ == "__main__":
    main(sys.argv[1])
