/** Tell localization where the robot is: by a click on the map, or by a room's name. */
import { signal } from "@preact/signals";
import { say, t } from "../i18n";
import { hint } from "../state/acts";
import { pointAsked } from "../state/picking";
import { places } from "../state/store";

const busy = signal(false);
const room = signal("");

async function send(where: Parameters<typeof hint>[0]): Promise<void> {
  if (busy.value) return;
  busy.value = true;
  await hint(where);
  busy.value = false;
}

export function Here() {
  const rooms = places.value.filter((place) => place.kind === "room");
  const waits = pointAsked.value !== null;
  return (
    <span class="here buttons">
      <button
        type="button"
        aria-pressed={waits}
        disabled={busy.value}
        onClick={() => {
          pointAsked.value = waits ? null : ({ x, y }) => void send({ point: { x_m: x, y_m: y } });
        }}
      >
        {t(waits ? "here.click" : "here.point")}
      </button>
      {rooms.length > 0 && (
        <>
          <select
            aria-label={t("here.room")}
            value={room.value}
            onChange={(event) => (room.value = event.currentTarget.value)}
          >
            <option value="">{t("here.room")}</option>
            {rooms.map((place) => (
              <option key={place.id} value={place.id}>
                {say(place.name)}
              </option>
            ))}
          </select>
          <button
            type="button"
            disabled={busy.value || room.value === ""}
            onClick={() => void send({ place: room.value })}
          >
            {t("here.tell")}
          </button>
        </>
      )}
    </span>
  );
}
