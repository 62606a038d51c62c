/** Lay the fleet's page out: bar, map, questions and the field, lists, Stop below on every view. */
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { tokenNeeded } from "../net/token";
import { Boundary } from "../panels/Boundary";
import { when } from "../panels/format";
import { Languages } from "../panels/Languages";
import { ThemePanel } from "../panels/ThemePanel";
import { TokenForm } from "../panels/TokenForm";
import { note } from "../state/note";
import { askNow, heardMs, isViewer, link, order, robots } from "./fleet";
import { FleetMap } from "./FleetMap";
import { Missions, Questions } from "./Missions";
import { Robots } from "./Robots";
import { StopAllBar } from "./StopAllBar";
import { ft } from "./words";

const SHOWN_MS = 6000;

export function FleetApp() {
  return (
    <>
      <Boundary>
        <TopBar />
      </Boundary>
      <main class="fleet">
        <div class="first">
          <Boundary>
            {tokenNeeded.value && (
              <TokenForm
                title={ft("token.title")}
                text={ft("token.text")}
                used={() => void askNow()}
              />
            )}
            {robots.value !== null && <Say />}
          </Boundary>
          <Boundary>
            <Questions />
          </Boundary>
        </div>
        <Boundary>
          <FleetMap />
        </Boundary>
        <div class="side">
          <Boundary>
            <Robots />
          </Boundary>
          <Boundary>
            <Missions />
          </Boundary>
          <ThemePanel />
        </div>
      </main>
      <Notes />
      <StopAllBar />
    </>
  );
}

function TopBar() {
  const state = link.value;
  const all = robots.value ?? [];
  const n = all.filter((robot) => robot.state === "ready").length;
  const words = { connecting: "connecting", good: "live", bad: "silent" } as const;
  return (
    <>
      <header class="topbar">
        <h1>Pons</h1>
        {robots.value !== null && (
          <span
            class={`chip clip ${n === all.length ? "good" : "warn"} ${state === "good" ? "" : "stale"}`}
            id="count"
          >
            {ft("answer", { n: `${n}`, all: `${all.length}` })}
          </span>
        )}
        <span
          class={`chip link ${state === "connecting" ? "stale" : state}`}
          id="link"
          data-state={state}
        >
          <span class="dot" aria-hidden="true" />
          <span class="clip">{ft(words[state])}</span>
        </span>
        <Languages />
      </header>
      {state === "bad" && !tokenNeeded.value && (
        <p class="lost" id="lost" role="status">
          {ft("lost", { time: heardMs.value === 0 ? "–" : when(heardMs.value, Date.now()) })}
        </p>
      )}
    </>
  );
}

const text = signal("");
const sending = signal(false);

/** Take an order to the house; who goes is in its words. */
function Say() {
  if (isViewer.value)
    return (
      <p class="card fine" id="viewer">
        {ft("viewer")}
      </p>
    );
  const send = async (): Promise<void> => {
    const said = text.value.trim();
    if (said === "" || sending.value) return;
    sending.value = true;
    if (await order(said)) text.value = "";
    sending.value = false;
  };
  return (
    <section class="card" aria-label={ft("say.label")}>
      <form
        class="goal-form"
        onSubmit={(event) => {
          event.preventDefault();
          void send();
        }}
      >
        <label for="say">{ft("say.label")}</label>
        <div class="goal-row">
          <input
            id="say"
            type="text"
            autocomplete="off"
            enterkeyhint="send"
            aria-describedby="say-hint"
            placeholder={ft("say.placeholder")}
            value={text.value}
            onInput={(event) => (text.value = event.currentTarget.value)}
          />
          <button type="submit" class="main" disabled={sending.value || text.value.trim() === ""}>
            {ft("say.send")}
          </button>
        </div>
        <p class="fine" id="say-hint">
          {ft("say.hint")}
        </p>
      </form>
    </section>
  );
}

/** Show for a while what failed. */
function Notes() {
  const shown = note.value;
  useEffect(() => {
    if (!shown) return;
    const timer = setTimeout(() => {
      if (note.peek()?.id === shown.id) note.value = null;
    }, SHOWN_MS);
    return () => clearTimeout(timer);
  }, [shown]);
  return (
    <div class="announcer" aria-live="polite" role="status" id="announcer">
      {shown && <p class={`note clip-3 ${shown.bad ? "bad" : ""}`}>{shown.text}</p>}
    </div>
  );
}
