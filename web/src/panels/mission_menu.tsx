import { readAreas, writeAreas } from '../model/geojson';
import type { Edit } from '../model/targets';
import { useApp } from './app_context';
import { Icon } from './icons';
import { PopoverButton } from './popover_button';

const kMostFileBytes = 1024 * 1024;

const kFace = (
  <>
    <Icon name="file" />
    <span class="label">Mission</span>
  </>
);

/** Save and load missions (YAML), import and export areas (GeoJSON). */
export function MissionMenu() {
  const app = useApp();
  const { session, editor } = app;
  const exportAreas = (): void => {
    const name = session.mission.value?.mission.name ?? 'mission';
    download(`${name}.geojson`, 'application/geo+json', JSON.stringify(writeAreas(session.committed.value), null, 2));
  };
  const isTooLarge = (file: File): boolean => {
    if (file.size > kMostFileBytes) session.notify('warning', `${file.name} is larger than 1 MiB.`);
    return file.size > kMostFileBytes;
  };
  const importAreas = async (file: File): Promise<void> => {
    if (isTooLarge(file)) return;
    const result = readAreas(await file.text(), session.draft.value);
    if (typeof result === 'string') session.notify('warning', `${file.name}: ${result}`);
    else if (editor.stage(`${result.length} entries of ${file.name}`, ...result.map((edit): Edit => edit)))
      session.notify('info', `${result.length} entries staged: Enter commits them.`);
  };
  const loadMission = async (file: File): Promise<void> => {
    if (isTooLarge(file)) return;
    await session.command({ type: 'load_mission', yaml: await file.text() }, `${file.name} is flown now.`);
  };
  return (
    <PopoverButton label="Mission" title="Mission" face={kFace}>
      {(close) => {
        const act = (work: () => void) => () => {
          close();
          work();
        };
        return (
          <>
            <button
              type="button"
              onClick={act(() => void saveMission(app.token(), session.mission.value?.mission.name))}
            >
              Save mission (YAML)
            </button>
            <FileButton
              label="Load mission (YAML)…"
              accept=".yaml,.yml"
              disabled={!session.mayOperate.value}
              take={(file) => act(() => void loadMission(file))()}
            />
            <button type="button" onClick={act(exportAreas)}>
              Export areas (GeoJSON)
            </button>
            <FileButton
              label="Import areas (GeoJSON)…"
              accept=".geojson,.json"
              disabled={!session.mayOperate.value}
              take={(file) => act(() => void importAreas(file))()}
            />
            <button
              type="button"
              disabled={!session.mayOperate.value}
              onClick={act(() => void session.command({ type: 'start_afresh' }, 'Coverage starts afresh.'))}
            >
              Start coverage afresh
            </button>
          </>
        );
      }}
    </PopoverButton>
  );

  async function saveMission(token: string, name = 'mission'): Promise<void> {
    const headers: Record<string, string> = { accept: 'application/yaml' };
    if (token) headers['authorization'] = `Bearer ${token}`;
    try {
      const answer = await fetch('/api/mission?format=yaml', { headers });
      if (!answer.ok) throw new Error(`the program answered ${answer.status}`);
      download(`${name}.yaml`, 'application/yaml', await answer.text());
    } catch (error) {
      session.notify('warning', `The mission was not saved: ${error instanceof Error ? error.message : 'no answer'}.`);
    }
  }
}

interface FileButtonProps {
  readonly label: string;
  readonly accept: string;
  readonly disabled: boolean;
  readonly take: (file: File) => void;
}

/** A button that opens the browser's file dialog: the input itself is hidden, and the button has the focus. */
function FileButton({ label, accept, disabled, take }: FileButtonProps) {
  const open = (): void => {
    const input = document.createElement('input');
    input.type = 'file';
    input.accept = accept;
    input.addEventListener('change', () => {
      const file = input.files?.[0];
      if (file) take(file);
    });
    input.click();
  };
  return (
    <button type="button" disabled={disabled} onClick={open}>
      {label}
    </button>
  );
}

function download(name: string, type: string, text: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  link.click();
  // The browser has the bytes once the click is handled.
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
