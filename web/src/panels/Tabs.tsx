/** Hold the views beside the map; a later one is one more line here. */
import { computed, effect, signal } from "@preact/signals";
import type { ComponentType } from "preact";
import { useRef } from "preact/hooks";
import { t } from "../i18n";
import { DriveTab } from "./DriveTab";
import { LogTab } from "./LogTab";
import { MissionsTab } from "./MissionsTab";
import { ObjectsTab } from "./ObjectsTab";
import { OrdersTab } from "./OrdersTab";
import { PlacesTab } from "./PlacesTab";
import { RobotTab } from "./RobotTab";
import { SettingsTab } from "./SettingsTab";
import { SetupTab } from "./SetupTab";
import { inSetup } from "../state/trial";

type TabId =
  "setup" | "drive" | "orders" | "places" | "objects" | "robot" | "log" | "missions" | "settings";

const TABS: readonly { readonly id: TabId; readonly View: ComponentType }[] = [
  { id: "drive", View: DriveTab },
  { id: "orders", View: OrdersTab },
  { id: "places", View: PlacesTab },
  { id: "objects", View: ObjectsTab },
  { id: "robot", View: RobotTab },
  { id: "missions", View: MissionsTab },
  { id: "log", View: LogTab },
  { id: "settings", View: SettingsTab },
];

/** Where no bridge drives there is nothing to drive to. */
const SETUP_TABS: typeof TABS = [
  { id: "setup", View: SetupTab },
  ...TABS.filter(({ id }) => ["robot", "log", "settings"].includes(id)),
];

const chosen = signal<TabId>("drive");
const tabs = computed(() => (inSetup.value ? SETUP_TABS : TABS));
const shown = computed(
  () => (tabs.value.find((tab) => tab.id === chosen.value) ?? tabs.value[0])?.id ?? "drive",
);

/** As set-up begins, its view comes up, whatever was shown: the wizard goes on there. */
effect(() => {
  if (inSetup.value) chosen.value = "setup";
});

/** Go to where orders are typed, from whatever view is shown. */
export function toGoalBox(): void {
  chosen.value = "drive";
  requestAnimationFrame(() => document.getElementById("goal-text")?.focus());
}

/** Go to where places are taught, from whatever view is shown. */
export function toTeaching(): void {
  chosen.value = "places";
  requestAnimationFrame(() => document.getElementById("teach-en")?.focus());
}

export function Tabs() {
  const list = useRef<HTMLDivElement>(null);
  const listed = tabs.value;
  const View = listed.find((tab) => tab.id === shown.value)?.View ?? DriveTab;
  const step = (by: number): void => {
    const index = listed.findIndex((tab) => tab.id === shown.value);
    const next = listed[(index + by + listed.length) % listed.length];
    if (!next) return;
    chosen.value = next.id;
    list.current?.querySelector<HTMLElement>(`#tab-${next.id}`)?.focus();
  };
  return (
    <>
      <div ref={list} class="tabs" role="tablist" aria-label={t("tab.label")}>
        {listed.map(({ id }) => (
          <button
            key={id}
            type="button"
            role="tab"
            id={`tab-${id}`}
            aria-selected={shown.value === id}
            aria-controls="view"
            aria-label={id === "settings" ? t("tab.settings") : undefined}
            tabIndex={shown.value === id ? 0 : -1}
            onClick={() => (chosen.value = id)}
            onKeyDown={(event) => {
              if (event.key === "ArrowRight") step(1);
              if (event.key === "ArrowLeft") step(-1);
            }}
          >
            {id === "settings" ? <Gear /> : t(`tab.${id}`)}
          </button>
        ))}
      </div>
      <div id="view" role="tabpanel" aria-labelledby={`tab-${shown.value}`}>
        <View />
      </div>
    </>
  );
}

/** Settings are looked for by this sign everywhere, and seven words fill the row. */
function Gear() {
  return (
    <svg class="gear" viewBox="-12 -12 24 24" aria-hidden="true">
      {[0, 45, 90, 135].map((turn) => (
        <path key={turn} transform={`rotate(${turn})`} d="M-2 -10h4v20h-4z" />
      ))}
      <circle r="7.4" />
      <circle r="3" class="hole" />
    </svg>
  );
}
