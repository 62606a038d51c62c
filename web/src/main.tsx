/** Start the page: Stop first, then the socket, then what is seen. */
import "uplot/dist/uPlot.min.css";
import "./styles/base.css";
import "./styles/layout.css";
import "./styles/panels.css";
import "./styles/places.css";
import "./styles/map.css";
import "./styles/nameplates.css";
import "./styles/points.css";
import "./styles/eyes.css";
import "./styles/people.css";
import "./styles/missions.css";
import "./styles/talk.css";
import "./styles/hand.css";
import "./styles/rehearsal.css";
import "./styles/settings.css";
import "./styles/driven.css";
import "./styles/stop.css";
import { effect } from "@preact/signals";
import { render } from "preact";
import { App } from "./app";
import { startCamera } from "./eyes/Camera";
import { startLanguage } from "./i18n";
import { fetchGrid, fetchObjects, fetchPlaces, fetchVoice } from "./net/api";
import { EventSocket } from "./net/socket";
import { setKey } from "./net/proof";
import { startToken, tokenNeeded } from "./net/token";
import { learnAsker } from "./state/asker";
import {
  began,
  grid,
  learnThings,
  mostTaught,
  proposedRooms,
  open,
  places,
  placesVersion,
  receive,
  sight,
  startClock,
  taught,
  wantsSnapshot,
} from "./state/store";
import { startTheme } from "./state/theme";
import { startDrives } from "./rehearse/drive";
import { startRehearsals } from "./rehearse/rehearsal";
import { startVisible } from "./state/visible";
import { listen } from "./stop/keys";
import { startStopper, stop } from "./stop/stopper";
import { hush, startAloud } from "./talk/aloud";
import { voice } from "./talk/Talk";
import type { Known } from "./wire/types";

const RETRY_MS = 2000;
const GROWN_MS = 2000;

const socket = new EventSocket({
  opened: () => {
    thingsVersion = -1; // another planner may count anew
    began();
    void load();
  },
  closed: () => {
    open.value = false;
    void load(); // tells a planner that wants a token from one that is gone
  },
  heard: receive,
});
startStopper((message) => socket.send(message), hush);
listen(stop);
setKey(startToken());
startLanguage();
startTheme();
startVisible();
startAloud();
startCamera();
startClock();
startRehearsals();
startDrives();
effect(() => {
  if (wantsSnapshot.value) socket.send({ snapshot: true });
});
socket.connect();

let knownVersion = 0;

function learnPlaces(known: Known): void {
  knownVersion = known.version;
  places.value = known.places;
  taught.value = known.taught;
  mostTaught.value = known.most;
  proposedRooms.value = known.proposed_rooms;
}

effect(() => {
  const version = placesVersion.value;
  if (grid.peek() !== null && version !== knownVersion) void again();
});

/** Load the places once more; what fails is tried at the next change or connection. */
async function again(): Promise<void> {
  await fetchPlaces().then(learnPlaces, () => undefined);
}

let thingsVersion = -1;

/** Load the things anew where some came or went; what fails is tried at the next change. */
effect(() => {
  const version = sight.value?.version ?? -1;
  if (version === thingsVersion) return;
  thingsVersion = version;
  void fetchObjects().then(learnThings, () => {
    thingsVersion = -1;
  });
});

let loading = false;
let growth: ReturnType<typeof setTimeout> | undefined;
void load(); // beside the socket's opening, not after it

/** Load what does not change while a planner runs; again until it is there. */
async function load(): Promise<void> {
  if (loading) return;
  loading = true;
  try {
    const [site, cells, heard] = await Promise.all([fetchPlaces(), fetchGrid(), fetchVoice()]);
    void learnAsker();
    voice.value = heard;
    learnPlaces(site);
    grid.value = cells;
    if (cells.growing) regrowLater();
  } catch {
    if (open.value || tokenNeeded.value) setTimeout(() => void load(), RETRY_MS);
  } finally {
    loading = false;
  }
}

/** Load the map anew where a home is mapped and more of it is known. */
async function regrow(): Promise<void> {
  const cells = await fetchGrid().catch(() => null);
  if (cells !== null && cells.growing?.revision !== grid.peek()?.growing?.revision)
    grid.value = cells;
  if (cells === null || cells.growing) regrowLater();
}

/** Of each connection only the newest goes on. */
function regrowLater(): void {
  clearTimeout(growth);
  growth = setTimeout(() => void regrow(), GROWN_MS);
}

const page = document.getElementById("page");
if (page) render(<App again={() => socket.again()} />, page);
