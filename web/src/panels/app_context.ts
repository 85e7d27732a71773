import type { Signal } from '@preact/signals';
import { createContext } from 'preact';
import { useContext } from 'preact/hooks';
import type { MapView } from '../map/map_view';
import type { Editor } from '../session/editor';
import type { FleetOrders } from '../session/fleet_orders';
import type { Foresight } from '../session/foresight';
import type { Reasons } from '../session/reasons';
import type { Session } from '../session/session';
import type { Settings } from '../session/settings';

/** What every panel works with. */
export interface App {
  readonly session: Session;
  readonly editor: Editor;
  readonly orders: FleetOrders;
  readonly foresight: Foresight;
  readonly reasons: Reasons;
  readonly settings: Settings;
  /** There once the page has its first layout. */
  readonly map: Signal<MapView | null>;
  readonly isHelpOpen: Signal<boolean>;
  readonly isLogOpen: Signal<boolean>;
  /** The first of the two presses of the emergency stop was just made. */
  readonly isStopArmed: Signal<boolean>;
  /** Who is at this console; the token stays in memory alone. */
  readonly introduce: (name: string, token: string, role: string) => void;
  readonly token: () => string;
}

export const AppContext = createContext<App | null>(null);

export function useApp(): App {
  const app = useContext(AppContext);
  if (!app) throw new Error('a panel outside of the console');
  return app;
}
