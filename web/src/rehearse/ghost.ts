/** Draw what is rehearsed as a ghost on the map: the ways, and where each of them is narrowest. */
import { effect } from "@preact/signals";
import { type Drawing, outlineOf } from "../map/drawing";
import { shown } from "./rehearsal";

const SVG = "http://www.w3.org/2000/svg";

/** Keep the ghost to what is shown; return what ends it. */
export function followGhost(drawing: Drawing): () => void {
  const within = drawing.layers.find((svg) => svg.classList.contains("drawing"))?.firstElementChild;
  const ghost = document.createElementNS(SVG, "path");
  ghost.setAttribute("class", "ghost");
  within?.append(ghost);
  const end = effect(() => {
    const steps = shown.value?.plan.steps ?? [];
    const ways = steps.filter((step) => step.points.length > 1);
    ghost.setAttribute("d", ways.map((step) => outlineOf(step.points)).join(""));
  });
  return () => {
    end();
    ghost.remove();
  };
}
