/** Choose which layers of the map are drawn; the choice is kept on this browser. */
import { signal } from "@preact/signals";

export const LAYERS = ["scan", "obstacles", "movers", "rooms", "trail"] as const;
export type LayerName = (typeof LAYERS)[number];

const SLOT = "pons.layers";

function kept(): readonly LayerName[] {
  try {
    const found: unknown = JSON.parse(localStorage.getItem(SLOT) ?? "null");
    return Array.isArray(found) ? LAYERS.filter((name) => found.includes(name)) : LAYERS;
  } catch {
    return LAYERS;
  }
}

export const shownLayers = signal<readonly LayerName[]>(kept());

export function toggleLayer(name: LayerName): void {
  const now = shownLayers.value;
  shownLayers.value = LAYERS.filter((one) => (one === name) !== now.includes(one));
  try {
    localStorage.setItem(SLOT, JSON.stringify(shownLayers.value));
  } catch {
    // a browser that keeps nothing shows all again next time
  }
}

export const isShown = (name: LayerName): boolean => shownLayers.value.includes(name);
