/** Take an order in words, with what was said before at hand, and the site's names as buttons. */
import { signal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { say, t } from "../i18n";
import { give, said } from "../state/acts";
import { ShowFirst } from "../rehearse/RehearsalPanel";
import { isBusy, places } from "../state/store";
import { Aloud, Talk } from "../talk/Talk";

const wide = matchMedia("(min-width: 821px)").matches; // a phone's view has no room for all names

const text = signal("");
const sending = signal(false);

export function GoalBox() {
  const back = useRef(-1); // how far the arrow keys went into what was said before
  const send = async (replace: boolean): Promise<void> => {
    const order = text.value.trim();
    if (order === "" || sending.value) return;
    sending.value = true;
    back.current = -1;
    if (await give(order, replace)) text.value = "";
    sending.value = false;
  };
  const recall = (step: number): void => {
    const kept = said();
    back.current = Math.max(-1, Math.min(kept.length - 1, back.current + step));
    text.value = back.current < 0 ? "" : (kept[back.current] ?? "");
  };
  return (
    <section class="card" aria-label={t("goal.label")}>
      <form
        class="goal-form"
        onSubmit={(event) => {
          event.preventDefault();
          void send(false);
        }}
      >
        <label for="goal-text">{t("goal.label")}</label>
        <div class="goal-row">
          <input
            id="goal-text"
            type="text"
            autocomplete="off"
            enterkeyhint="send"
            placeholder={t("goal.placeholder")}
            value={text.value}
            onInput={(event) => (text.value = event.currentTarget.value)}
            onKeyDown={(event) => {
              if (event.isComposing) return; // the keys belong to the input method
              if (event.key === "ArrowUp") recall(1);
              else if (event.key === "ArrowDown") recall(-1);
              else return;
              event.preventDefault();
            }}
          />
          <button type="submit" class="main" disabled={sending.value || text.value.trim() === ""}>
            {isBusy.value ? t("goal.queue") : t("goal.send")}
          </button>
        </div>
        <ShowFirst text={text.value.trim()} />
        {isBusy.value && text.value.trim() !== "" && (
          <button type="button" class="instead" onClick={() => void send(true)}>
            {t("goal.replace")}
          </button>
        )}
      </form>
      <div class="voice">
        <Talk />
        <Aloud />
      </div>
      <Names />
    </section>
  );
}

/** Offer every room and place as a button: what a click on the map does, by keyboard. */
function Names() {
  return (
    <details class="names" open={wide}>
      <summary>{t("goal.places")}</summary>
      <ul class="chips">
        {places.value.map((place) => (
          <li key={place.id}>
            <button
              type="button"
              class={`chip clip ${place.kind}`}
              onClick={() => void give(t("goal.to", { name: say(place.name) }))}
            >
              {say(place.name)}
            </button>
          </li>
        ))}
      </ul>
    </details>
  );
}
