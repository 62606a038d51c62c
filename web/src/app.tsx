/** Lay the page out: the bar above, map and views, Stop below on every view. */
import { MapPanel } from "./map/MapPanel";
import { Camera } from "./eyes/Camera";
import { tokenNeeded } from "./net/token";
import { Announcer } from "./panels/Announcer";
import { Boundary } from "./panels/Boundary";
import { Lost } from "./panels/Lost";
import { Notice } from "./panels/Notice";
import { Tabs } from "./panels/Tabs";
import { TokenForm } from "./panels/TokenForm";
import { TopBar } from "./panels/TopBar";
import { StopBar } from "./stop/StopBar";

export function App({ again }: { again: () => void }) {
  return (
    <>
      <Boundary>
        <TopBar />
        <Lost />
      </Boundary>
      <main>
        <Boundary>
          <MapPanel />
        </Boundary>
        <div class="side">
          <Boundary>
            {tokenNeeded.value ? <TokenForm used={again} /> : null}
            <Notice />
            <Camera />
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
