/** Show wheel speeds as asked, sent and measured, and how late the bridge's ticks were. */
import { useMemo } from "preact/hooks";
import { language, t } from "../i18n";
import type { Sample } from "../state/history";
import { type Line, Plot } from "./Plot";

export function Plots() {
  return <Lines key={language.value} />; // in another language they are other lines
}

function Lines() {
  const left = useMemo(() => wheel("left"), []);
  const right = useMemo(() => wheel("right"), []);
  const late = useMemo(() => lateness(), []);
  return (
    <section class="card" aria-label={t("plot.window")}>
      <h2>{t("plot.window")}</h2>
      <Plot title={t("plot.left")} lines={left} least={1} />
      <Plot title={t("plot.right")} lines={right} least={1} />
      <Plot title={t("plot.late")} lines={late} least={0.2} />
    </section>
  );
}

function wheel(side: "left" | "right"): Line[] {
  return [
    { label: t("plot.asked"), colour: "plot-a", dash: [4, 3], value: (s: Sample) => s.asked[side] },
    { label: t("plot.sent"), colour: "plot-b", value: (s: Sample) => s.sent[side] },
    { label: t("plot.measured"), colour: "plot-c", value: (s: Sample) => s.measured[side] },
  ];
}

function lateness(): Line[] {
  return [
    { label: t("plot.p50"), colour: "plot-b", value: (s: Sample) => s.lateP50Ms },
    { label: t("plot.max"), colour: "plot-d", value: (s: Sample) => s.lateMaxMs },
  ];
}
