/**
 * Show the camera's picture with what the detector found, drawn over it here. Pictures are fetched
 * only while this is open and somebody can see it.
 */
import { computed, effect, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { t } from "../i18n";
import { fetchPicture } from "../net/api";
import { moment, since, type Moment } from "../state/moment";
import { now, shownStatus, sight, sightAt } from "../state/store";
import { visible } from "../state/visible";
import { Boxes } from "./Boxes";
import { PERIOD_MS, Puller } from "./pull";
import { blind, blindFor, blindWords, boxed, hasCamera, type Drawn } from "./sight";
import { lookWords, pictureAgeWords } from "./words";

const SLOT = "pons.camera";
const DRIVEN = new Set(["ACTIVE", "TELEOP", "STOPPING"]);
/** Blind for one of these, there is a picture all the same, with nothing found in it. */
const PICTURED = new Set(["no_detector", "detector_down"]);
const UNNUMBERED_MS = 1000;

const opened = signal(false);
/** What was found in the picture that is on the screen, and when that picture came; null where there is none. */
const drawn = signal<Drawn | null>(null);
const pictured = signal<Moment | null>(null);
/** How old the grey picture is, in words that change once a second; null where it is not grey. */
const pictureAge = computed(() =>
  blind.value === null || pictured.value === null
    ? null
    : pictureAgeWords(since(pictured.value, now.value)),
);
/** The look whose boxes lie over the picture now. */
const shown = computed(() => boxed(drawn.value, blind.value, now.value));

/** Take up whether the person had the picture open. */
export function startCamera(): void {
  opened.value = localStorage.getItem(SLOT) === "open";
}

function keepOpen(open: boolean): void {
  opened.value = open;
  localStorage.setItem(SLOT, open ? "open" : "shut");
}

export function Camera() {
  if (!hasCamera.value) return null;
  return (
    <section class="card camera" id="camera" aria-label={t("camera.title")}>
      <details open={opened.value} onToggle={(event) => keepOpen(event.currentTarget.open)}>
        <summary>{t("camera.title")}</summary>
        {opened.value && <Picture />}
      </details>
      {blind.value !== null && (
        <p class="reason" id="blind" data-blind={blind.value} role="status">
          {blindWords.value}
          {/* not read aloud at each second */}
          <span aria-hidden="true"> {blindFor.value}</span>
        </p>
      )}
    </section>
  );
}

const beat = (periodMs: number): number => Math.floor(now.value.monotonicMs / periodMs);

/** Name the newest picture worth fetching: one with a new look; others while the robot drives. */
const wanted = computed(() => {
  const code = blind.value;
  if (!visible.value || !opened.value || (code !== null && !PICTURED.has(code))) return null;
  const seq = sight.value?.look?.seq ?? 0;
  if (DRIVEN.has(shownStatus.value?.mode ?? "")) return `driven ${beat(PERIOD_MS)} ${seq}`;
  return code === null ? `seq ${seq}` : `unseen ${beat(UNNUMBERED_MS)}`;
});

function Picture() {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const puller = new Puller(() => show(canvas.current));
    const end = effect(() => puller.want(wanted.value));
    return () => {
      end();
      puller.want(null);
      drawn.value = null;
      pictured.value = null;
    };
  }, []);
  const look = shown.value;
  return (
    <figure class={`picture ${blind.value === null ? "" : "stale"}`}>
      <div class="screen" hidden={pictured.value === null}>
        <canvas ref={canvas} width={320} height={240} role="img" aria-label={t("camera.label")} />
        {look && <Boxes look={look} />}
      </div>
      <figcaption class="fine">{look ? lookWords(look) : pictureAge.value}</figcaption>
    </figure>
  );
}

/** Draw the newest picture with what was found in it; what fails leaves the one before. */
async function show(canvas: HTMLCanvasElement | null): Promise<void> {
  try {
    const bitmap = await createImageBitmap(await fetchPicture());
    if (canvas === null) return;
    if (canvas.width !== bitmap.width) canvas.width = bitmap.width;
    if (canvas.height !== bitmap.height) canvas.height = bitmap.height;
    canvas.getContext("2d")?.drawImage(bitmap, 0, 0);
    bitmap.close();
    pictured.value = moment();
    const [look, at] = [sight.peek()?.look, sightAt.peek()];
    drawn.value = look && at ? { look, at } : null;
  } catch {
    // Why it is blind comes over the socket; the next picture is asked for all the same.
  }
}
