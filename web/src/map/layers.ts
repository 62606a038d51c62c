/** Choose which layers of the map are drawn; the choice is kept on this browser. */
import { signal } from "@preact/signals";

export const LAYERS = ["scan", "obstacles", "movers", "rooms", "trail", "fence"] as const;
export type LayerName = (typeof LAYERS)[number];

/** What is hidden is kept, so that a layer which comes later is shown. */
const SLOT = "pons.layers.hidden";

function kept(): readonly LayerName[] {
  try {
    const hidden: unknown = JSON.parse(localStorage.getItem(SLOT) ?? "null");
    return Array.isArray(hidden) ? LAYERS.filter((name) => !hidden.includes(name)) : LAYERS;
  } catch {
    return LAYERS;
  }
}

export const shownLayers = signal<readonly LayerName[]>(kept());

export function toggleLayer(name: LayerName): void {
  const now = shownLayers.value;
  shownLayers.value = LAYERS.filter((one) => (one === name) !== now.includes(one));
  try {
    localStorage.setItem(SLOT, JSON.stringify(LAYERS.filter((one) => !isShown(one))));
  } catch {
    // a browser that keeps nothing shows all again next time
  }
}

export const isShown = (name: LayerName): boolean => shownLayers.value.includes(name);
