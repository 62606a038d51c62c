/**
 * Write names on the map: upright however it is turned, and each with room of its own. Names that have
 * none keep a ring at what they name. Elements are kept while what they say is the same.
 */
import { type Camera, originOf, unmovedPixel } from "./camera";
import { boxOf, type Label, meet, type PixelBox, placeLabels, type Spot } from "./labels";
import type { Point } from "./resolve";

export type Kind = "robot" | "row" | "room" | "proposed" | "place" | "guess" | "thing";
export type Nameplate = {
  readonly id: string;
  readonly text: string;
  readonly at: Point; // in metres of the map
  readonly more?: string; // classes
  readonly radius?: number; // of what it names, in metres
};

/** Who chooses room first. */
const ORDER: readonly Kind[] = ["robot", "row", "room", "proposed", "guess", "place", "thing"];
const MARK_PX: Readonly<Record<Kind, number>> = {
  robot: 14,
  row: 8,
  room: 0,
  proposed: 0,
  guess: 8,
  place: 5,
  thing: 6,
};
/** Classes as stories and styles know them. */
const CLASSES: Readonly<Record<Kind, string>> = {
  robot: "name name-robot",
  row: "name name-row",
  room: "name name-room",
  proposed: "name name-proposed",
  guess: "name name-guess",
  place: "name name-place",
  thing: "thing",
};

type Written = {
  readonly plate: Nameplate;
  readonly element: HTMLElement;
  readonly label: HTMLElement;
  readonly lead: HTMLElement;
  size: readonly [number, number] | null; // as the browser lays it out
};

export class Nameplates {
  readonly element = document.createElement("div");
  private readonly kinds = new Map<Kind, Map<string, Written>>();
  private shown: readonly PixelBox[] = [];
  private left = new Set<string>();
  private robotThen: PixelBox | null = null;

  constructor() {
    this.element.className = "nameplates";
  }

  /** Write these names of a kind and no others; return whether any element changed. */
  show(kind: Kind, plates: readonly Nameplate[]): boolean {
    const before = this.kinds.get(kind) ?? new Map<string, Written>();
    const after = new Map<string, Written>();
    let changed = before.size !== plates.length;
    for (const plate of plates) {
      const known = before.get(plate.id);
      const same = known && JSON.stringify(known.plate) === JSON.stringify(plate);
      const written = same ? known : this.write(kind, plate);
      changed ||= !same;
      if (!same) known?.element.remove();
      after.set(plate.id, written);
      before.delete(plate.id);
    }
    for (const { element } of before.values()) element.remove();
    this.kinds.set(kind, after);
    return changed;
  }

  private write(kind: Kind, plate: Nameplate): Written {
    const [element, label, lead] = [made("div"), made("span"), made("i")];
    element.className = `${CLASSES[kind]} ${plate.more ?? ""}`;
    label.textContent = plate.text; // as text: a name may hold anything
    element.append(lead, label);
    this.element.append(element);
    return { plate, element, label, lead, size: null };
  }

  /** Forget how large names are: another size of letters is used. */
  resize(): void {
    for (const written of this.all()) written.size = null;
  }

  /** Give each name its room; `blocked` and the robot's box are never written over [px of the unmoved map]. */
  place(camera: Camera, blocked: readonly PixelBox[], robot: PixelBox | null): void {
    const { x, y } = originOf(camera);
    const view = { left: -x, top: -y, right: camera.width - x, bottom: camera.height - y };
    const all = this.all();
    for (const one of all) one.size ??= [one.label.offsetWidth, one.label.offsetHeight];
    const labels = ORDER.flatMap((kind) =>
      [...(this.kinds.get(kind)?.values() ?? [])].map(({ plate, size }): Label => {
        const [width, height] = size ?? [0, 0];
        const mark = Math.max(MARK_PX[kind], camera.scale * (plate.radius ?? 0));
        return { at: unmovedPixel(camera, plate.at), width, height, mark };
      }),
    );
    const spots = placeLabels(labels, robot ? [robot, ...blocked] : blocked, view);
    all.forEach((one, index) => this.put(one, labels[index]?.at, spots[index] ?? null));
    this.robotThen = robot;
    this.left = new Set(all.filter((_, index) => !spots[index]).map(({ plate }) => plate.id));
    this.shown = labels.flatMap((label, index) => {
      const spot = spots[index];
      return spot ? [boxOf(label, spot)] : [];
    });
  }

  /** Say whether the robot has come over a name, or so far that a name may have room again. */
  crowds(robot: PixelBox | null): boolean {
    const then = this.robotThen;
    if (robot === null || then === null) return robot !== then;
    return !meet(robot, then) || this.shown.some((box) => meet(box, robot));
  }

  /** Say whether a thing's or place's name has no room now. */
  isLeftOut(id: string): boolean {
    return this.left.has(id);
  }

  private all(): Written[] {
    return ORDER.flatMap((kind) => [...(this.kinds.get(kind)?.values() ?? [])]);
  }

  private put({ element, label, lead }: Written, at: Point | undefined, spot: Spot | null): void {
    if (!at) return;
    element.style.transform = `translate(${at.x}px, ${at.y}px)`;
    element.classList.toggle("crowded", spot === null);
    const [dx, dy] = spot ? [spot.x - at.x, spot.y - at.y] : [0, 0];
    label.style.transform = `translate(${dx}px, ${dy}px) translate(-50%, -50%)`;
    const leads = spot?.leads ?? false;
    lead.style.display = leads ? "" : "none";
    if (!leads) return;
    lead.style.width = `${Math.hypot(dx, dy)}px`;
    lead.style.transform = `rotate(${Math.atan2(dy, dx)}rad)`;
  }
}

const made = (name: "div" | "span" | "i"): HTMLElement => document.createElement(name);

/** Return the class of a colour's id; an id that is none of ours has no colour. */
export const colourClass = (color: string | null): string =>
  color !== null && /^[a-z]+$/.test(color) ? `color-${color}` : "color-none";
