/**
 * Ask twice for what wakes or silences the robot: one press opens the question, another does it.
 * Never one key and never one click, so that nothing that a slip can do arms or resets.
 */
import { signal } from "@preact/signals";
import { useCallback, useEffect, useRef } from "preact/hooks";
import { t } from "../i18n";
import type { Act } from "../net/api";
import { hasKey, mayAskKey, needsKey, setKey } from "../net/proof";
import { order } from "../state/acts";
import { shownStatus } from "../state/store";

const OPEN_MS = 15_000;

/** Which order is being asked about, and where: two places may offer the same one. */
const asked = signal<string | null>(null);

export function Deliberate({ kind, where }: { kind: Act; where: string }) {
  const id = `${where}-${kind}`;
  const open = asked.value === id;
  const opener = useRef<HTMLButtonElement>(null);
  const close = useCallback((): void => {
    asked.value = null;
    opener.current?.focus();
  }, []);
  return (
    <div class="deliberate">
      <button
        ref={opener}
        type="button"
        id={id}
        aria-expanded={open}
        onClick={() => (asked.value = open ? null : id)}
      >
        {t(`op.${kind}`)} …
      </button>
      {open && <Question kind={kind} close={close} />}
    </div>
  );
}

function Question({ kind, close }: { kind: Act; close: () => void }) {
  const yes = useRef<HTMLButtonElement>(null);
  const signs = needsKey(shownStatus.value) && kind !== "disarm" && kind !== "estop";
  useEffect(() => {
    yes.current?.focus();
    const timer = setTimeout(close, OPEN_MS); // a question left open must not wait for a slip
    return () => clearTimeout(timer);
  }, [close]);
  return (
    <fieldset class="question" aria-label={t(`op.${kind}`)}>
      <p>{t(`op.${kind}.ask`)}</p>
      {signs && !hasKey.value && <KeyBox />}
      <div class="buttons">
        <button
          ref={yes}
          type="button"
          class="main"
          disabled={signs && !hasKey.value}
          onClick={() => {
            close();
            void order(kind);
          }}
        >
          {t(`op.${kind}.yes`)}
        </button>
        <button type="button" class="quiet" onClick={close}>
          {t("op.no")}
        </button>
      </div>
    </fieldset>
  );
}

/**
 * Take the operator's key for this page's memory, or say where it can be given instead. `stays`: the
 * box is not taken away once the key is there, so it may be read at each letter.
 */
export function KeyBox({ stays = false }: { stays?: boolean }) {
  if (!mayAskKey()) return <p class="fine key-insecure">{t("error.operator_key_insecure")}</p>;
  return (
    <form onSubmit={(event) => event.preventDefault()}>
      <label class="field">
        <span>{t("op.key")}</span>
        <input
          type="password"
          autocomplete="off"
          spellcheck={false}
          onChange={(event) => setKey(event.currentTarget.value)}
          onInput={(event) => stays && setKey(event.currentTarget.value)}
        />
        <small>
          {t("op.key.why")} {t("op.key.short")} {t("op.key.where")}
        </small>
      </label>
    </form>
  );
}
