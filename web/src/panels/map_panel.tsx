import { useEffect, useRef } from 'preact/hooks';
import { Gestures } from '../map/gestures';
import { MapView } from '../map/map_view';
import { kPalettes } from '../map/palette';
import { duration } from '../model/units';
import { kLayerNames, kLayers } from '../session/settings';
import { useApp } from './app_context';
import { Covers } from './covers';
import { Icon } from './icons';
import { SwarmHealth } from './program_health';
import { StagingBar } from './staging_bar';
import { usePopover } from './use_popover';

export function MapPanel() {
  const { session, editor, settings, foresight, map } = useApp();
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const view = new MapView(host.current!, session, editor, settings, foresight);
    new Gestures(host.current!, view);
    map.value = view;
    return () => view.close();
  }, []);
  const cursor = editor.cursor.value;
  return (
    <main class="map">
      <div
        class="map-field"
        ref={host}
        tabIndex={0}
        role="application"
        aria-roledescription="map"
        aria-label="Field. Arrow keys move the cursor, Space uses the tool there. The tables beside it say the same."
        data-tool={editor.tool.value}
      />
      <p class="unseen" role="status">
        {cursor ? `cursor ${cursor[0].toFixed(2)}, ${cursor[1].toFixed(2)} metres` : ''}
      </p>
      <div class="map-corner upper-left">
        <Legend />
        <HowMany />
        <SwarmHealth />
      </div>
      <div class="map-corner upper-right">
        <LayersMenu />
        <MapButton icon="fit" label="Fit the field" act={() => map.value?.fitField()} />
        <MapButton icon="plus" label="Zoom in" act={() => map.value?.zoom(1.4)} />
        <MapButton icon="minus" label="Zoom out" act={() => map.value?.zoom(1 / 1.4)} />
        <MapButton icon="undo" label="Undo" act={() => editor.undo()} />
        <MapButton icon="redo" label="Redo" act={() => editor.redo()} />
        <AheadButton />
      </div>
      <StagingBar />
      <Covers />
    </main>
  );
}

function MapButton({
  icon,
  label,
  act,
}: {
  icon: 'fit' | 'plus' | 'minus' | 'undo' | 'redo';
  label: string;
  act: () => void;
}) {
  return (
    <button type="button" aria-label={label} title={label} onClick={act}>
      <Icon name={icon} />
    </button>
  );
}

function AheadButton() {
  const { foresight } = useApp();
  return (
    <button
      type="button"
      aria-pressed={foresight.isOn.value}
      aria-label="Look ahead"
      title="Look ahead: what if the selected drones were missing? (W)"
      onClick={() => foresight.toggle()}
    >
      <Icon name="ahead" />
    </button>
  );
}

function LayersMenu() {
  const { settings } = useApp();
  const { isOpen, setOpen, root } = usePopover();
  const layers = settings.layers.value;
  return (
    <div class="popover" ref={root}>
      <button type="button" aria-expanded={isOpen} aria-label="Layers" title="Layers" onClick={() => setOpen(!isOpen)}>
        <Icon name="layers" />
      </button>
      {isOpen && (
        <fieldset class="menu" style={{ margin: 0 }}>
          <legend class="unseen">Layers of the map</legend>
          {kLayers.map((layer) => (
            <label key={layer} class="check">
              <input type="checkbox" checked={layers.has(layer)} onChange={() => settings.toggle(layer)} />
              <span>{kLayerNames[layer]}</span>
            </label>
          ))}
        </fieldset>
      )}
    </div>
  );
}

/** Of very many drones the program shows some. */
function HowMany() {
  const { session } = useApp();
  const [shown, all] = [session.droneIds.value.length, session.fleetSize.value];
  return shown < all ? (
    <div class="legend">
      {shown} of {all} drones are shown; densities, figures and LAND ALL are of all
    </div>
  ) : null;
}

const css = (colour: readonly number[]): string => `rgb(${colour.map((part) => Math.round(255 * part)).join(' ')})`;

/** What the tints mean, for the layers that are on. */
function Legend() {
  const { settings, map, session } = useApp();
  const palette = kPalettes[settings.theme.value];
  const layers = settings.layers.value;
  const ramps = [
    layers.has('density') && (['importance', css(palette.density), ''] as const),
    layers.has('coverage') && (['time spent', css(palette.coverage), ''] as const),
    layers.has('age') && (['not seen for', css(palette.age), duration(map.value?.ageScaleS.value ?? 0)] as const),
  ].filter((ramp) => ramp !== false);
  const separation = session.mission.value?.display.separation_m;
  const hasRadii = layers.has('radii') && separation !== undefined;
  if (ramps.length === 0 && !hasRadii) return null;
  return (
    <div class="legend">
      {ramps.map(([name, colour, most]) => (
        <span key={name} class="state">
          {name}
          <span
            class="ramp"
            style={{ background: `linear-gradient(90deg, transparent, ${colour})` }}
            aria-hidden="true"
          />
          {most}
        </span>
      ))}
      {hasRadii && <span>circles touch at R_s = {separation} m</span>}
    </div>
  );
}
