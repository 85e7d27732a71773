import { effect, signal } from '@preact/signals';
import { render } from 'preact';
import './look/colours.css';
import './look/layout.css';
import './look/controls.css';
import './look/top_bar.css';
import './look/panels.css';
import './look/charging.css';
import './look/overlays.css';
import './look/foresight.css';
import './look/replay.css';
import './look/why.css';
import type { Socket, World } from './link/console_link';
import type { MapView } from './map/map_view';
import { AppContext, type App } from './panels/app_context';
import { ConsolePage } from './panels/console_page';
import { listenForKeys } from './panels/shortcuts';
import { Editor } from './session/editor';
import { FleetOrders } from './session/fleet_orders';
import { Foresight } from './session/foresight';
import { Reasons } from './session/reasons';
import { Session } from './session/session';
import { Settings } from './session/settings';

const kProtocol = 'vigil.v1';

const world: World = {
  openSocket(): Socket {
    const scheme = location.protocol === 'https:' ? 'wss:' : 'ws:';
    return new WebSocket(`${scheme}//${location.host}/live`, kProtocol) as unknown as Socket;
  },
  nowMs: () => performance.now(),
  after(ms, call) {
    const timer = setTimeout(call, ms);
    return () => clearTimeout(timer);
  },
  random: Math.random,
};

/** By which the program knows this page again when it connects anew, and lets its older connection go. */
const kPage = Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, '0')).join(
  '',
);

function identityOf(name: string, token: string, role: string): Record<string, unknown> {
  return { page: kPage, ...(name ? { name } : {}), ...(token ? { token } : {}), ...(role ? { role } : {}) };
}

function makeApp(): App {
  const settings = new Settings();
  const session = new Session(world, identityOf(settings.name.value, '', ''));
  const editor: Editor = new Editor(session, (place) => orders.goTo(place));
  const orders = new FleetOrders(session, editor);
  let token = '';
  return {
    session,
    editor,
    settings,
    orders,
    foresight: new Foresight(session, editor),
    reasons: new Reasons(session, editor),
    map: signal<MapView | null>(null),
    isHelpOpen: signal(false),
    isLogOpen: signal(false),
    isStopArmed: signal(false),
    token: () => token,
    introduce(name, newToken, role) {
      token = newToken || token;
      settings.name.value = name;
      session.link.introduce(identityOf(name, token, role));
    },
  };
}

const app = makeApp();
effect(() => {
  document.documentElement.dataset['theme'] = app.settings.theme.value;
});
effect(() => {
  const mission = app.session.mission.value;
  const badge = app.session.isLive.value ? mission?.fleet : 'STALE';
  document.title = mission ? `${badge} ${mission.mission.name} – vigil` : 'vigil';
});
render(
  <AppContext.Provider value={app}>
    <ConsolePage />
  </AppContext.Provider>,
  document.getElementById('console')!,
);
listenForKeys(app);
app.session.link.open();
