/** Say in a whole sentence, over everything, that what is shown is not now. */
import { say, t } from "../i18n";
import {
  age,
  bridgeFresh,
  bridgeHeard,
  open,
  pageFresh,
  pageHeard,
  poseLost,
  poseTrouble,
} from "../state/store";
import { seconds } from "./format";
import { Here } from "./Here";
import { Guesses } from "./Match";

export function Lost() {
  if (!pageHeard.value) return null; // nothing has been shown yet
  if (!open.value || !pageFresh.value) return <Strip why="planner" />;
  if (!bridgeHeard.value) return <p class="lost">{t("lost.never")}</p>;
  if (!bridgeFresh.value) return <Strip why="bridge" />;
  return poseLost.value && <Whereabouts state={poseLost.value} />;
}

/** Say that the robot does not know where it is, and let a person tell it. */
function Whereabouts({ state }: { state: "searching" | "lost" }) {
  const trouble = poseTrouble.value;
  return (
    <div class="lost" id="pose-lost" data-state={state} data-why={trouble?.code} role="status">
      <span>{trouble ? say(trouble.message) : t(`here.${state}`)}</span>
      <Guesses />
      <Here />
    </div>
  );
}

function Strip({ why }: { why: "planner" | "bridge" }) {
  const forS = age(why === "planner" ? "page" : "status");
  return (
    <p class="lost" id="lost" data-why={why} role="status">
      {t(`lost.${why}`)}
      {/* not read aloud at each tick */}
      <span aria-hidden="true"> · {seconds(forS)}</span>
    </p>
  );
}
