/** List the robots: state, battery, version, what each does, and the way to its own page. */
import { say } from "../i18n";
import { percent, when } from "../panels/format";
import type { Robot } from "./decode";
import { lookAt } from "./FleetMap";
import { link, missions, robots, stopOne } from "./fleet";
import { ft } from "./words";

const LOW = 0.2;
const CANNOT = new Set(["BOOT", "SELFTEST", "DISARMED", "ESTOPPED", "FAULT"]);

export function Robots() {
  const all = robots.value ?? [];
  return (
    <section class="card" aria-labelledby="robots-title" id="robots">
      <h2 id="robots-title">{ft("robots.title")}</h2>
      {robots.value?.length === 0 && <p class="fine">{ft("robots.none")}</p>}
      <ul class={`fleet-list ${link.value === "good" ? "" : "stale"}`}>
        {all.map((robot) => (
          <li key={robot.name} data-robot={robot.name} data-state={robot.state}>
            <One robot={robot} />
          </li>
        ))}
      </ul>
    </section>
  );
}

/** Say what a robot is at, and how good that is. */
export function standing(robot: Robot): readonly [words: string, tone: string] {
  const { state, heard_unix_s: heard } = robot;
  if (state === "ready") {
    if (robot.mode !== null && CANNOT.has(robot.mode)) return [ft("robot.held"), "warn"];
    return robot.mission === null ? [ft("robot.ready"), "good"] : [ft("robot.busy"), "busy"];
  }
  if (robot.is_silent) {
    return heard === null
      ? [ft("robot.never"), "bad"]
      : [ft("robot.unknown", { time: when(1000 * heard, Date.now()) }), "bad"];
  }
  if (state === "connecting") return [ft("robot.connecting"), ""];
  if (state === "robot_silent") return [ft("robot.quiet"), "warn"];
  return [ft("robot.trouble", { code: state }), "bad"];
}

/** Return an address that a click may go to; a robot is added by http or https alone. */
export const pageOf = ({ url }: Robot): string | null => (/^https?:\/\//.test(url) ? url : null);

function One({ robot }: { robot: Robot }) {
  const [words, tone] = standing(robot);
  const { name, room, battery, release } = robot;
  const does = robot.mission === null ? null : missions.value.get(robot.mission);
  const page = pageOf(robot);
  const facts = [
    robot.site,
    robot.map === null ? null : robot.base_in_map === null ? ft("robot.no_place") : room,
    robot.map === null ? room : null,
    release && ft("robot.release", { release }),
    robot.map_trouble && ft("robot.no_map", { code: robot.map_trouble }),
  ].filter((fact) => fact);
  return (
    <>
      <header class="fleet-row">
        <strong class="clip">{name}</strong>
        <span class={`chip ${tone}`}>{words}</span>
        {battery !== null && (
          <span
            class={`chip battery ${battery < LOW ? "warn" : ""}`}
            role="img"
            aria-label={ft("robot.battery", { share: percent(battery) })}
          >
            {percent(battery)}
          </span>
        )}
      </header>
      {facts.length > 0 && (
        <p class="fine" dir="auto">
          {facts.join(" · ")}
        </p>
      )}
      {does && (
        <p class="clip-3" dir="auto">
          {does.text}
        </p>
      )}
      {robot.state !== "ready" && robot.message && <p class="reason">{say(robot.message)}</p>}
      {robot.unstopped && (
        <p class="bad-words">
          {name}: {ft("stop.one_waits")}
        </p>
      )}
      <div class="buttons">
        <button type="button" onClick={() => void stopOne(name)}>
          {ft("stop.one", { name })}
        </button>
        {robot.map !== null && (
          <button
            type="button"
            onClick={() => lookAt(robot)}
            aria-label={`${ft("map.show")}: ${name}`}
          >
            {ft("map.show")}
          </button>
        )}
        {page !== null && (
          <a href={page} target="_blank" rel="noreferrer noopener">
            {ft("robot.page", { name })}
          </a>
        )}
      </div>
    </>
  );
}
