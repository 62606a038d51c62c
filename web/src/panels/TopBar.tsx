/** Show who speaks to this page and how fresh it is, and let the person choose the language. */
import { choose, language, t, word } from "../i18n";
import { fresh } from "../state/moment";
import { age, bridgeFresh, open, robot, status } from "../state/store";
import { seconds } from "./format";
import { toGoalBox } from "./Tabs";

export function TopBar() {
  const site = robot.value?.site;
  return (
    <header class="topbar">
      <a
        class="skip"
        href="#view"
        onClick={(event) => {
          event.preventDefault();
          toGoalBox();
        }}
      >
        {t("page.skip")}
      </a>
      <h1>Pons</h1>
      {site && <span class="site clip">{site}</span>}
      <Mode />
      <Link />
      <fieldset class="languages">
        <legend class="unseen">{t("page.language")}</legend>
        {(["en", "zh"] as const).map((code) => (
          <button
            key={code}
            type="button"
            lang={code === "zh" ? "zh-CN" : "en"}
            aria-pressed={language.value === code}
            onClick={() => choose(code)}
          >
            {code === "zh" ? "中文" : "EN"}
          </button>
        ))}
      </fieldset>
    </header>
  );
}

function Mode() {
  const mode = status.value?.mode ?? "none";
  return (
    <span
      class={`chip mode mode-${mode} ${bridgeFresh.value ? "" : "stale"}`}
      id="mode"
      data-mode={mode}
    >
      {word("mode", mode)}
    </span>
  );
}

function Link() {
  const [page, bridge] = [age("page"), age("status")];
  let text = t("link.live");
  let state = "good";
  if (page === null) [text, state] = [t("link.connecting"), "stale"];
  else if (!open.value || !fresh(page))
    [text, state] = [t("link.lost", { age: seconds(page) }), "bad"];
  else if (bridge === null) [text, state] = [t("link.never"), "bad"];
  else if (!fresh(bridge))
    [text, state] = [t("link.bridge_silent", { age: seconds(bridge) }), "bad"];
  return (
    <span class={`chip link ${state}`} id="link" data-state={state}>
      <span class="dot" aria-hidden="true" />
      {text}
    </span>
  );
}
