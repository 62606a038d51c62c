/** Hold the views beside the map; a later one is one more line here. */
import { signal } from "@preact/signals";
import type { ComponentType } from "preact";
import { useRef } from "preact/hooks";
import { t } from "../i18n";
import { DriveTab } from "./DriveTab";
import { LogTab } from "./LogTab";
import { ObjectsTab } from "./ObjectsTab";
import { OrdersTab } from "./OrdersTab";
import { PlacesTab } from "./PlacesTab";
import { RobotTab } from "./RobotTab";

type TabId = "drive" | "orders" | "places" | "objects" | "robot" | "log";

const TABS: readonly { readonly id: TabId; readonly View: ComponentType }[] = [
  { id: "drive", View: DriveTab },
  { id: "orders", View: OrdersTab },
  { id: "places", View: PlacesTab },
  { id: "objects", View: ObjectsTab },
  { id: "robot", View: RobotTab },
  { id: "log", View: LogTab },
];

const shown = signal<TabId>("drive");

/** Go to where orders are typed, from whatever view is shown. */
export function toGoalBox(): void {
  shown.value = "drive";
  requestAnimationFrame(() => document.getElementById("goal-text")?.focus());
}

/** Go to where places are taught, from whatever view is shown. */
export function toTeaching(): void {
  shown.value = "places";
  requestAnimationFrame(() => document.getElementById("teach-en")?.focus());
}

export function Tabs() {
  const list = useRef<HTMLDivElement>(null);
  const View = TABS.find((tab) => tab.id === shown.value)?.View ?? DriveTab;
  const step = (by: number): void => {
    const index = TABS.findIndex((tab) => tab.id === shown.value);
    const next = TABS[(index + by + TABS.length) % TABS.length];
    if (!next) return;
    shown.value = next.id;
    list.current?.querySelector<HTMLElement>(`#tab-${next.id}`)?.focus();
  };
  return (
    <>
      <div ref={list} class="tabs" role="tablist" aria-label={t("tab.label")}>
        {TABS.map(({ id }) => (
          <button
            key={id}
            type="button"
            role="tab"
            id={`tab-${id}`}
            aria-selected={shown.value === id}
            aria-controls="view"
            tabIndex={shown.value === id ? 0 : -1}
            onClick={() => (shown.value = id)}
            onKeyDown={(event) => {
              if (event.key === "ArrowRight") step(1);
              if (event.key === "ArrowLeft") step(-1);
            }}
          >
            {t(`tab.${id}`)}
          </button>
        ))}
      </div>
      <div id="view" role="tabpanel" aria-labelledby={`tab-${shown.value}`}>
        <View />
      </div>
    </>
  );
}
