/** Draw the last minute of some values with uPlot, twice a second. Knows no robot. */

import { computed, effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { type Sample, series, WINDOW_S } from "../state/history";
import { history, now } from "../state/store";
import { isDark } from "../state/theme";
import { visible } from "../state/visible";
import { span } from "./span";

export type Line = {
  readonly label: string;
  readonly colour: string; // a CSS variable
  readonly dash?: number[];
  readonly value: (sample: Sample) => number;
};

const HEIGHT_PX = 120;
const PERIOD_MS = 500;

/** Change twice a second, and not at all while nobody looks. */
const beat = computed(() => visible.value && Math.floor(now.value.monotonicMs / PERIOD_MS));

export function Plot({
  title,
  lines,
  least,
}: {
  title: string;
  lines: readonly Line[];
  least: number;
}) {
  const place = useRef<HTMLDivElement>(null);
  const dark = isDark.value; // its colours are read when it is made
  useEffect(() => {
    const element = place.current;
    if (element === null) return;
    const plot = make(element, lines, least);
    const width = new ResizeObserver(() =>
      plot.setSize({ width: element.clientWidth, height: HEIGHT_PX }),
    );
    width.observe(element);
    const end = effect(() => {
      if (beat.value === false) return;
      const data = series(
        history.samples,
        now.peek().monotonicMs / 1000,
        lines.map((line) => line.value),
      );
      plot.setData(data as uPlot.AlignedData);
    });
    return () => {
      end();
      width.disconnect();
      plot.destroy();
    };
  }, [lines, least, dark]);
  return (
    <figure class="plot">
      <figcaption>
        {title}
        <span class="legend">
          {lines.map((line) => (
            <span key={line.label} class={`swatch swatch-${line.colour}`}>
              {line.label}
            </span>
          ))}
        </span>
      </figcaption>
      <div ref={place} />
    </figure>
  );
}

function make(element: HTMLElement, lines: readonly Line[], least: number): uPlot {
  const css = getComputedStyle(document.documentElement);
  const ink = css.getPropertyValue("--ink-soft").trim();
  const grid = { stroke: css.getPropertyValue("--line").trim(), width: 1 };
  const font = "11px system-ui, sans-serif";
  return new uPlot(
    {
      width: element.clientWidth || 300,
      height: HEIGHT_PX,
      legend: { show: false },
      cursor: { show: false },
      scales: {
        x: { time: false, range: [-WINDOW_S, 0] },
        y: { range: (_, low, high) => span(low, high, least) },
      },
      axes: [
        {
          stroke: ink,
          grid,
          font,
          size: 22,
          ticks: { show: false },
          values: (_, at) => at.map((x) => `${x} s`),
        },
        { stroke: ink, grid, font, size: 38, ticks: { show: false } },
      ],
      series: [
        {},
        ...lines.map((line) => ({
          stroke: css.getPropertyValue(`--${line.colour}`).trim(),
          width: 1.5,
          points: { show: false },
          ...(line.dash ? { dash: line.dash } : {}),
        })),
      ],
    },
    [[], ...lines.map(() => [])] as uPlot.AlignedData,
    element,
  );
}
