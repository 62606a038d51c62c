/** Lay the page out: the bar above, map and views, Stop below on every view. */
import { MapPanel } from "./map/MapPanel";
import { Camera } from "./eyes/Camera";
import { HandPanel } from "./hand/HandPanel";
import { tokenNeeded } from "./net/token";
import { Announcer } from "./panels/Announcer";
import { Asked } from "./panels/Asked";
import { Boundary } from "./panels/Boundary";
import { Lost } from "./panels/Lost";
import { Notice } from "./panels/Notice";
import { Tabs } from "./panels/Tabs";
import { TokenForm } from "./panels/TokenForm";
import { TopBar } from "./panels/TopBar";
import { RehearsalPanel } from "./rehearse/RehearsalPanel";
import { inSetup } from "./state/trial";
import { StopBar } from "./stop/StopBar";

export function App({ again }: { again: () => void }) {
  return (
    <>
      <Boundary>
        <TopBar />
        <Lost />
      </Boundary>
      <main class={inSetup.value ? "set-up" : ""}>
        {!inSetup.value && (
          <Boundary>
            <Asked />
          </Boundary>
        )}
        {!inSetup.value && (
          <Boundary>
            <MapPanel />
          </Boundary>
        )}
        <div class="side">
          <Boundary>
            {tokenNeeded.value ? <TokenForm used={again} /> : null}
            {!inSetup.value && <Notice />}
            {!inSetup.value && <RehearsalPanel />}
            {!inSetup.value && <Camera />}
            <HandPanel />
            <Tabs />
          </Boundary>
        </div>
      </main>
      <Boundary>
        <Announcer />
      </Boundary>
      <StopBar />
    </>
  );
}
