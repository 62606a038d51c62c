/** Start the fleet's page: Stop first, then what is asked each second, then what is seen. */
import "../styles/base.css";
import "../styles/layout.css";
import "../styles/panels.css";
import "../styles/map.css";
import "../styles/nameplates.css";
import "../styles/talk.css";
import "../styles/stop.css";
import "../styles/fleet.css";
import { render } from "preact";
import { startLanguage } from "../i18n";
import { startToken } from "../net/token";
import { startTheme } from "../state/theme";
import { startVisible } from "../state/visible";
import { listen } from "../stop/keys";
import { startFleet } from "./fleet";
import { FleetApp } from "./FleetApp";
import { stopAll } from "./stopAll";
import { ft } from "./words";

listen(stopAll);
startToken();
startLanguage(() => ft("title"));
startTheme();
startVisible();
startFleet();

const page = document.getElementById("page");
if (page) render(<FleetApp />, page);
