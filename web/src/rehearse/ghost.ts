/** Draw what is rehearsed on the map: the ways as a ghost, and where the simulator drove along them. */
import { effect } from "@preact/signals";
import { type Drawing, outlineOf } from "../map/drawing";
import { driven } from "./drive";
import { shown } from "./rehearsal";

const SVG = "http://www.w3.org/2000/svg";

/** Keep the ghost to what is shown; return what ends it. */
export function followGhost(drawing: Drawing): () => void {
  const within = drawing.layers.find((svg) => svg.classList.contains("drawing"))?.firstElementChild;
  const ghost = document.createElementNS(SVG, "path");
  const trail = document.createElementNS(SVG, "path");
  ghost.setAttribute("class", "ghost");
  trail.setAttribute("class", "driven-trail");
  within?.append(ghost, trail);
  const end = effect(() => {
    const steps = shown.value?.plan.steps ?? [];
    ghost.setAttribute("d", steps.map((step) => wayOf(step.points)).join(""));
    trail.setAttribute("d", wayOf(driven.value?.driven.trail ?? []));
  });
  return () => {
    end();
    ghost.remove();
    trail.remove();
  };
}

/** Return a way as a path; fewer than two points are none, and an empty path is not drawn. */
export const wayOf = (points: readonly (readonly [number, number])[]): string =>
  points.length > 1 ? outlineOf(points) : "";
