/** List the owner's tool servers: reached or why not, what each may be asked, and today's calls. */
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { say, t } from "../i18n";
import { call } from "../net/api";
import type { Bilingual } from "../wire/types";

type Server = {
  readonly name: string;
  readonly host: string;
  readonly tools: readonly { readonly name: string; readonly writes: boolean }[];
  readonly left_out: readonly {
    readonly name: string;
    readonly code: string;
    readonly message: Bilingual;
  }[];
  readonly problem: string | null;
  readonly message: Bilingual | null;
  readonly calls_today: number | null;
  readonly day_calls: number;
};

type Servers = { readonly message: Bilingual | null; readonly servers: readonly Server[] };

const LOOK_MS = 5000; // a server that is back is seen here soon

const known = signal<Servers | null>(null);

async function look(): Promise<void> {
  known.value = await call("GET", "v1/tools").then(
    (list) => list as Servers,
    () => known.value,
  );
}

export function ToolsPanel() {
  useEffect(() => {
    void look();
    const timer = setInterval(() => void look(), LOOK_MS);
    return () => clearInterval(timer);
  }, []);
  const list = known.value;
  if (list === null || list.servers.length === 0) return null;
  return (
    <section class="card" aria-labelledby="tools-title" id="tools">
      <h2 id="tools-title">{t("tools.title")}</h2>
      <p class="fine">{t("tools.how")}</p>
      {list.message !== null && <p class="wrong">{say(list.message)}</p>}
      <ul class="taught">
        {list.servers.map((server) => (
          <Line key={server.name} server={server} />
        ))}
      </ul>
    </section>
  );
}

function Line({ server }: { readonly server: Server }) {
  const named = (writes: boolean): string =>
    server.tools
      .filter((tool) => tool.writes === writes)
      .map((tool) => tool.name.slice(server.name.length + 1))
      .join(", ");
  const [reads, writes] = [named(false), named(true)];
  return (
    <li data-server={server.name} data-problem={server.problem}>
      <span class="said">
        <strong>{server.name}</strong>
        <span class="fine" dir="ltr">
          {server.host}
        </span>
        {server.message === null ? (
          <span>{t("tools.reached")}</span>
        ) : (
          <span class="wrong">{say(server.message)}</span>
        )}
        {reads !== "" && <span>{t("tools.reads", { names: reads })}</span>}
        {writes !== "" && <span>{t("tools.writes", { names: writes })}</span>}
        {server.left_out.map((each) => (
          <span key={each.name} class="fine" data-left-out={each.code}>
            {t("tools.left_out", { name: each.name, why: say(each.message) })}
          </span>
        ))}
        <span class="fine">
          {server.calls_today === null
            ? t("tools.uncounted")
            : t("tools.calls", { made: `${server.calls_today}`, most: `${server.day_calls}` })}
        </span>
      </span>
    </li>
  );
}
