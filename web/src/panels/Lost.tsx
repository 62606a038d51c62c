/** Say in a whole sentence, over everything, that what is shown is not now. */
import { t } from "../i18n";
import { age, bridgeFresh, bridgeHeard, open, pageFresh, pageHeard } from "../state/store";
import { seconds } from "./format";

export function Lost() {
  if (!pageHeard.value) return null; // nothing has been shown yet
  if (!open.value || !pageFresh.value) return <Strip why="planner" />;
  if (!bridgeHeard.value) return <p class="lost">{t("lost.never")}</p>;
  return bridgeFresh.value ? null : <Strip why="bridge" />;
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
