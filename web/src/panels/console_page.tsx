import { Areas } from './areas';
import { useApp } from './app_context';
import { ChargingPlan } from './charging_plan';
import { EventLog } from './event_log';
import { FleetTable } from './fleet_table';
import { ForesightPanel } from './foresight_panel';
import { Help } from './help';
import { Inspector, Orders } from './inspector';
import { MapPanel } from './map_panel';
import { Notices } from './notices';
import { Plots } from './plots';
import { ReplayBar } from './replay_bar';
import { Timeline } from './timeline';
import { Tools } from './tools';
import { TopBar } from './top_bar';

export function ConsolePage() {
  const { session } = useApp();
  const isStale = session.hasSnapshot.value && !session.isLive.value;
  return (
    <>
      <div class={`console ${isStale ? 'is-stale' : ''}`} data-phase={session.linkState.value.phase}>
        <TopBar />
        <nav class="left" aria-label="Tools and areas">
          <Tools />
          <Areas />
        </nav>
        <MapPanel />
        <aside class="right" aria-label="Fleet and drone">
          <FleetTable />
          <ChargingPlan />
          <ForesightPanel />
          <Inspector />
          <Orders />
        </aside>
        <section class="bottom" aria-label="Timeline and plots">
          {session.isRecording.value ? <ReplayBar /> : <Timeline />}
          <Plots />
        </section>
      </div>
      <EventLog />
      <Help />
      <Notices />
    </>
  );
}
