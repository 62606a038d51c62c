/** Show who speaks to this page and how fresh it is, and let the person choose the language. */
import { computed } from "@preact/signals";
import { t } from "../i18n";
import { age, bridgeFresh, shown, shownStatus } from "../state/store";
import { headlineNow, isLow, linkNow } from "../state/facts";
import { percent, seconds } from "./format";
import { Languages } from "./Languages";
import { inSetup } from "../state/trial";
import { toGoalBox } from "./Tabs";

const siteNow = computed(() => shown.value?.site);
const modeNow = computed(() => shownStatus.value?.mode ?? "none");
const batteryNow = computed(() => {
  const charge = shownStatus.value?.drive.battery ?? null;
  return charge === null ? null : percent(charge);
});

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
      <Battery />
      <Link />
      <Languages />
    </header>
  );
}

function Mode() {
  const { word, tone } = headlineNow.value;
  return (
    <span
      class={`chip mode ${tone} ${linkNow.value === "live" ? "" : "stale"}`}
      id="mode"
      data-mode={modeNow.value}
      data-word={word}
    >
      {t(word)}
    </span>
  );
}

/** Say how full the battery is, where the drive tells; amber where the bridge finds it low. */
function Battery() {
  const share = batteryNow.value;
  if (share === null) return null;
  return (
    <span
      class={`chip battery ${isLow.value ? "warn" : ""} ${bridgeFresh.value ? "" : "stale"}`}
      id="battery"
      role="img"
      aria-label={t("now.battery", { share })}
    >
      {share}
    </span>
  );
}

/** Say how the page hears; while all is well it says so without counting. */
function hearing(): readonly [text: string, state: string] {
  switch (linkNow.value) {
    case "connecting":
      return [t("link.connecting"), "stale"];
    case "lost":
      return [t("link.lost", { age: seconds(age("page")) }), "bad"];
    case "unheard":
      return [t("link.never"), "bad"];
    case "silent":
      return [t("link.bridge_silent", { age: seconds(age("status")) }), "bad"];
    case "live":
      return [t("link.live"), "good"];
  }
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
