/** Say in a whole sentence, over everything, that what is shown is not now. */
import { t } from "../i18n";
import { age, open, pageFresh } from "../state/store";
import { fresh } from "../state/moment";
import { seconds } from "./format";

export function Lost() {
  const [page, bridge] = [age("page"), age("status")];
  if (page === null) return null; // nothing has been shown yet
  if (!open.value || !pageFresh.value) return <Strip why="planner" forS={page} />;
  if (bridge === null) return <p class="lost">{t("lost.never")}</p>;
  return fresh(bridge) ? null : <Strip why="bridge" forS={bridge} />;
}

function Strip({ why, forS }: { why: "planner" | "bridge"; forS: number }) {
  return (
    <p class="lost" id="lost" data-why={why} role="status">
      {t(`lost.${why}`)}
      {/* not read aloud at each tick */}
      <span aria-hidden="true"> · {seconds(forS)}</span>
    </p>
  );
}
