/** Mark the things that the robot remembers on the map: a dot in its colour, and its name. */
import * as L from "leaflet";
import type { Thing } from "../wire/types";

type Mark = { readonly marker: L.Marker; readonly reads: string };

export class Things {
  private readonly marks = new Map<string, Mark>();
  readonly layer = L.layerGroup();

  /** Show these and no others; what has not changed stays as it is. */
  show(things: readonly Thing[], nameOf: (thing: Thing) => string): void {
    const gone = new Set(this.marks.keys());
    for (const thing of things) {
      gone.delete(thing.id);
      this.put(thing, nameOf(thing));
    }
    for (const id of gone) this.drop(id);
  }

  private put(thing: Thing, name: string): void {
    const { id, color, x_m, y_m } = thing;
    const reads = `${color ?? "none"} ${name}`;
    const known = this.marks.get(id);
    if (known?.reads === reads) {
      known.marker.setLatLng([y_m, x_m]);
      return;
    }
    this.drop(id);
    const options = { icon: iconOf(id, color, name), interactive: false, keyboard: false };
    const marker = L.marker([y_m, x_m], options).addTo(this.layer);
    this.marks.set(id, { marker, reads });
  }

  private drop(id: string): void {
    this.marks.get(id)?.marker.remove();
    this.marks.delete(id);
  }
}

function iconOf(id: string, color: string | null, name: string): L.DivIcon {
  const label = document.createElement("span");
  label.textContent = name; // as text: a detector's names may hold anything
  label.dataset.thing = id;
  return L.divIcon({ html: label, className: `thing ${colourClass(color)}`, iconSize: [0, 0] });
}

/** Return the class of a colour's id; an id that is none of ours has no colour. */
export const colourClass = (color: string | null): string =>
  color !== null && /^[a-z]+$/.test(color) ? `color-${color}` : "color-none";
