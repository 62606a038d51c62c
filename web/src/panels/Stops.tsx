/**
 * Show what a patrol saw at each of its stops, and on request the picture that was kept of each.
 * Pictures are fetched only while somebody has them open.
 */
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { say, t } from "../i18n";
import { fetchKeptPicture, forgetPicture, listPictures } from "../net/api";
import { attempt } from "../state/acts";
import type { KeptPicture, Step } from "../wire/types";
import { nameOf } from "./steps";

export function Stops({ goal, at, step }: { goal: string; at: number; step: Step }) {
  const stops = step.stops ?? [];
  const kept = useSignal<readonly KeptPicture[] | null>(null);
  if (stops.length === 0) return null;
  const load = () =>
    attempt(async () => {
      const all = await listPictures(goal);
      kept.value = all.filter((picture) => picture.step === at);
      return undefined;
    });
  const forget = async (id: number) => {
    await attempt(async () => {
      await forgetPicture(id);
      return undefined;
    });
    await load();
  };
  return (
    <span class="stops">
      <span class="came">{stops.map((stop) => say(stop.said)).join(" ")}</span>
      <details
        onToggle={(event) => {
          if (event.currentTarget.open) void load();
          else kept.value = null;
        }}
      >
        <summary>{t("stops.pictures")}</summary>
        {kept.value !== null && kept.value.length === 0 && (
          <span class="fine">{t("stops.none")}</span>
        )}
        <span class="shots">
          {(kept.value ?? []).map((picture) => (
            <Shot key={picture.id} picture={picture} forget={() => void forget(picture.id)} />
          ))}
        </span>
      </details>
    </span>
  );
}

function Shot({ picture, forget }: { picture: KeptPicture; forget: () => void }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => void draw(canvas.current, picture.id), [picture.id]);
  const things = picture.names.map(say).join(", ");
  const place = nameOf(picture.place);
  return (
    <figure class="shot">
      <canvas ref={canvas} width={160} height={120} role="img" aria-label={`${place} ${things}`} />
      <figcaption class="fine">
        {place}{" "}
        <button type="button" class="clip" onClick={forget}>
          {t("stops.forget")}
        </button>
      </figcaption>
    </figure>
  );
}

async function draw(canvas: HTMLCanvasElement | null, id: number): Promise<void> {
  await attempt(async () => {
    const bitmap = await createImageBitmap(await fetchKeptPicture(id));
    if (canvas !== null) {
      canvas.width = bitmap.width;
      canvas.height = bitmap.height;
      canvas.getContext("2d")?.drawImage(bitmap, 0, 0);
    }
    bitmap.close();
    return undefined;
  });
}
