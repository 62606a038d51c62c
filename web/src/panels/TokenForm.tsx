/** Ask for the API token where the planner wants one. */
import { useSignal } from "@preact/signals";
import { t } from "../i18n";
import { setToken } from "../net/token";

export function TokenForm({
  used,
  title = t("token.title"),
  text = t("token.text"),
}: {
  used: () => void;
  title?: string;
  text?: string;
}) {
  const typed = useSignal("");
  return (
    <section class="card token">
      <h2>{title}</h2>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          setToken(typed.value);
          used();
        }}
      >
        <label class="field">
          <span>{t("token.label")}</span>
          <input
            type="password"
            autocomplete="off"
            value={typed.value}
            onInput={(event) => (typed.value = event.currentTarget.value)}
          />
          <small>
            {text}
            {!globalThis.isSecureContext && ` ${t("token.insecure")}`}
          </small>
        </label>
        <button type="submit" class="main">
          {t("token.use")}
        </button>
      </form>
    </section>
  );
}
