/** Show who speaks to this page and how fresh it is, and let the person choose the language. */
import { computed } from "@preact/signals";
import { choose, language, modeWords, t } from "../i18n";
import {
  age,
  bridgeFresh,
  bridgeHeard,
  open,
  pageFresh,
  pageHeard,
  shown,
  shownStatus,
  poseUnknown,
} from "../state/store";
import { seconds } from "./format";
import { inSetup } from "../state/trial";
import { toGoalBox } from "./Tabs";

const siteNow = computed(() => shown.value?.site);
const modeNow = computed(() => shownStatus.value?.mode ?? "none");

export function TopBar() {
  const site = siteNow.value;
  return (
    <header class="topbar">
      {!inSetup.value && (
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
      )}
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
  const mode = modeNow.value;
  const lost = bridgeFresh.value && !inSetup.value ? poseUnknown.value : null;
  const state = lost === null ? `mode-${mode}` : "bad";
  return (
    <span
      class={`chip mode ${state} ${bridgeFresh.value ? "" : "stale"}`}
      id="mode"
      data-mode={mode}
    >
      {modeWords(inSetup.value ? "setup" : mode, lost)}
    </span>
  );
}

/** Say how the page hears; while all is well it says so without counting. */
function hearing(): readonly [text: string, state: string] {
  if (!pageHeard.value) return [t("link.connecting"), "stale"];
  if (!open.value || !pageFresh.value)
    return [t("link.lost", { age: seconds(age("page")) }), "bad"];
  if (!bridgeHeard.value) return [t("link.never"), "bad"];
  if (!bridgeFresh.value) return [t("link.bridge_silent", { age: seconds(age("status")) }), "bad"];
  return [t("link.live"), "good"];
}

function Link() {
  const [text, state] = hearing();
  return (
    <span class={`chip link ${state}`} id="link" data-state={state}>
      <span class="dot" aria-hidden="true" />
      <span class="clip">{text}</span>
    </span>
  );
}
