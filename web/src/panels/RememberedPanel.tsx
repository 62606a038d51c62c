/** Search what the robot remembers: seen and told, with ages; teach it a fact, have it forget. */
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { language, say, t } from "../i18n";
import { forgetMemories, forgetMemory, listMemories, teachFact } from "../net/api";
import { attempt } from "../state/acts";
import { tell } from "../state/note";
import { pageFresh } from "../state/store";
import type { Memories, Memory } from "../wire/types";
import { nameOf } from "./steps";

const SHOWN = 30;

const query = signal("");
const fact = signal("");
const held = signal<Memories | null>(null);
const doubted = signal<number | "all" | null>(null); // whose forgetting is being asked about
let asked = 0;

async function look(): Promise<void> {
  const mine = ++asked;
  await attempt(async () => {
    const found = await listMemories(query.value.trim(), SHOWN);
    if (mine === asked) held.value = found; // a newer search may have been answered before
    return undefined;
  });
}

async function learn(): Promise<void> {
  const words = fact.value.trim();
  if (words === "") return;
  const kept = await attempt(async () => {
    await teachFact(words);
    return undefined;
  });
  if (kept) fact.value = "";
  await look();
}

async function drop(which: Memory | "all"): Promise<void> {
  doubted.value = null;
  await attempt(async () => {
    const count = await (which === "all" ? forgetMemories() : forgetMemory(which.id));
    tell(t("memory.forgot", { count: String(count) }));
    return undefined;
  });
  await look();
}

export function RememberedPanel() {
  useEffect(() => void look(), []);
  const memories = held.value?.memories ?? [];
  const near = query.value.trim() !== "" && memories.length > 0 && !memories.some((m) => m.fits);
  return (
    <section
      class={`card ${pageFresh.value ? "" : "stale"}`}
      aria-labelledby="memory-title"
      id="memory"
    >
      <h2 id="memory-title">{t("memory.title")}</h2>
      <form
        class="memory-form"
        role="search"
        onSubmit={(event) => {
          event.preventDefault();
          void look();
        }}
      >
        <label for="memory-query">{t("memory.search")}</label>
        <input
          id="memory-query"
          type="search"
          maxLength={120}
          value={query.value}
          onInput={(event) => (query.value = event.currentTarget.value)}
        />
        <button type="submit">{t("memory.find")}</button>
      </form>
      {held.value !== null && memories.length === 0 && <p class="fine">{t("memory.none")}</p>}
      {near && <p class="fine">{t("memory.near")}</p>}
      <ul class="taught memories">
        {memories.map((memory) => (
          <Line key={memory.id} memory={memory} />
        ))}
      </ul>
      <Teach />
      {memories.length > 0 && <ForgetAll />}
    </section>
  );
}

function Teach() {
  return (
    <form
      class="memory-form"
      onSubmit={(event) => {
        event.preventDefault();
        void learn();
      }}
    >
      <label for="memory-fact">{t("memory.teach")}</label>
      <input
        id="memory-fact"
        value={fact.value}
        onInput={(event) => (fact.value = event.currentTarget.value)}
      />
      <button type="submit" disabled={fact.value.trim() === ""}>
        {t("memory.keep")}
      </button>
    </form>
  );
}

function ForgetAll() {
  return (
    <p class="buttons">
      {doubted.value === "all" ? (
        <Sure yes={() => void drop("all")} />
      ) : (
        <button type="button" class="quiet" onClick={() => (doubted.value = "all")}>
          {t("memory.forget_all")}
        </button>
      )}
    </p>
  );
}

function Sure({ yes }: { readonly yes: () => void }) {
  return (
    <>
      <button type="button" class="main" onClick={yes}>
        {t("places.forget_yes")}
      </button>
      <button type="button" class="quiet" onClick={() => (doubted.value = null)}>
        {t("op.no")}
      </button>
    </>
  );
}

function Line({ memory }: { readonly memory: Memory }) {
  const what = whatOf(memory);
  return (
    <li data-memory={memory.id}>
      <span class="said">
        <strong dir="auto">{what}</strong>
        <span class="fine">{knownOf(memory)}</span>
      </span>
      <span class="buttons">
        {doubted.value === memory.id ? (
          <Sure yes={() => void drop(memory)} />
        ) : (
          <button
            type="button"
            aria-label={`${t("memory.forget_one")}: ${what}`}
            onClick={() => (doubted.value = memory.id)}
          >
            {t("places.forget")}
          </button>
        )}
      </span>
    </li>
  );
}

function whatOf(memory: Memory): string {
  return memory.name ? say(memory.name) : `“${memory.words ?? ""}”`;
}

function knownOf(memory: Memory): string {
  const at = new Date(memory.last_unix_s * 1000).toLocaleString(
    language.value === "zh" ? "zh-CN" : "en-GB",
    {
      dateStyle: "medium",
      timeStyle: "short",
    },
  );
  const where = memory.room ? nameOf(memory.room) : "";
  const on = memory.on ? t("memory.on", { what: say(memory.on) }) : "";
  const when = t(memory.kind === "fact" ? "memory.told" : "memory.seen", { at });
  return [where, on, when].filter((part) => part !== "").join(" · ");
}
