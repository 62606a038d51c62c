/** Draw what was found in a picture over it: a box each, its name and how sure the detector is. */
import type { Box, Look } from "../wire/types";
import { boxWords } from "./words";

const LINE = 12; // a line of text, in the picture's pixels
const LEAST_WIDTH = 0.45; // of the picture: what a name may need to its right

export function Boxes({ look }: { look: Look }) {
  const { width, height, boxes } = look;
  return (
    <svg class="boxes" viewBox={`0 0 ${width} ${height}`} aria-hidden="true">
      {boxes.map((box, index) => (
        <One key={index} box={box} width={width} />
      ))}
    </svg>
  );
}

function One({ box, width }: { box: Box; width: number }) {
  const [left, top, right, bottom] = box.box;
  const atRight = width - left < width * LEAST_WIDTH;
  return (
    <g data-label={box.label}>
      <rect x={left} y={top} width={right - left} height={bottom - top} />
      <text
        x={atRight ? Math.min(right, width - 2) : left + 1}
        y={top > LINE ? top - 3 : top + LINE}
        text-anchor={atRight ? "end" : "start"}
      >
        {boxWords(box)}
      </text>
    </g>
  );
}
