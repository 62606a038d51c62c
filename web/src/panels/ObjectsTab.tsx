/** List what the robot remembers to have seen, with its age; go to a thing, or forget it. */
import { signal } from "@preact/signals";
import { colourClass } from "../map/nameplates";
import { t } from "../i18n";
import { forgetThing, give } from "../state/acts";
import { pageFresh } from "../state/store";
import { RememberedPanel } from "./RememberedPanel";
import { blind, blindWords, type Row, rows } from "../eyes/sight";

const doubted = signal<string | null>(null); // whose forgetting is being asked about

export function ObjectsTab() {
  return (
    <>
      <Seen />
      <RememberedPanel />
    </>
  );
}

function Seen() {
  return (
    <section
      class={`card ${pageFresh.value ? "" : "stale"}`}
      aria-labelledby="objects-title"
      id="objects"
    >
      <h2 id="objects-title">
        {t("objects.title")} <span class="fine">{rows.value.length}</span>
      </h2>
      {blind.value !== null && <p class="reason">{blindWords.value}</p>}
      {rows.value.length === 0 && <p class="fine">{t("objects.none")}</p>}
      <ul class="taught objects">
        {rows.value.map((row) => (
          <Line key={row.id} row={row} />
        ))}
      </ul>
    </section>
  );
}

function Line({ row }: { row: Row }) {
  const { id, what } = row;
  return (
    <li data-thing={id} class={row.faint ? "quiet" : ""}>
      <span class={`swatch-dot ${colourClass(row.color)}`} aria-hidden="true" />
      <span class="said">
        <strong dir="auto">{what}</strong>
        <span class="fine">{row.known}</span>
      </span>
      <span class="buttons">
        {doubted.value === id ? (
          <>
            <button
              type="button"
              class="main"
              onClick={() => {
                doubted.value = null;
                void forgetThing(id, what);
              }}
            >
              {t("places.forget_yes")}
            </button>
            <button type="button" class="quiet" onClick={() => (doubted.value = null)}>
              {t("op.no")}
            </button>
          </>
        ) : (
          <>
            <button
              type="button"
              aria-label={`${t("objects.go")}: ${what}`}
              onClick={() => void give(row.order)}
            >
              {t("objects.go")}
            </button>
            <button
              type="button"
              aria-label={`${t("places.forget")}: ${what}`}
              onClick={() => (doubted.value = id)}
            >
              {t("places.forget")}
            </button>
          </>
        )}
      </span>
    </li>
  );
}
