import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { chordOf, kActions, kUsualKeys, remapped, type Action } from '../model/keyboard';
import { useApp } from './app_context';
import { Icon } from './icons';

const kGroups = ['Tools', 'Edits', 'Drones', 'View'] as const;

/** What the keys do, and how to change them. */
export function Help() {
  const { isHelpOpen, settings } = useApp();
  const dialog = useRef<HTMLDialogElement>(null);
  const asking = useSignal<Action | null>(null);
  const problem = useSignal('');
  useEffect(() => {
    if (isHelpOpen.value) dialog.current?.showModal();
    else dialog.current?.close();
  }, [isHelpOpen.value]);

  const pressed = (event: KeyboardEvent): void => {
    const action = asking.value;
    if (action === null) return;
    event.stopPropagation();
    event.preventDefault();
    if (['Shift', 'Control', 'Alt', 'Meta'].includes(event.key)) return;
    asking.value = null;
    const chord = chordOf({
      key: event.key,
      ctrl: event.ctrlKey || event.metaKey,
      shift: event.shiftKey,
      alt: event.altKey,
    });
    const changed = remapped(settings.keys.value, action, chord);
    if (typeof changed === 'string') problem.value = changed;
    else {
      problem.value = '';
      settings.keys.value = changed;
    }
  };

  return (
    <dialog ref={dialog} aria-labelledby="help-title" onClose={() => (isHelpOpen.value = false)} onKeyDown={pressed}>
      <header>
        <h2 id="help-title">Help and keys</h2>
        <button type="button" class="quiet" aria-label="Close the help" onClick={() => (isHelpOpen.value = false)}>
          <Icon name="close" />
        </button>
      </header>
      {isHelpOpen.value && (
        <div class="body">
          <p style={{ marginTop: 0 }}>
            Point at places, and the swarm spends its time there. Edits are <strong>staged</strong>: the map shows what
            would become of them; Enter commits, Esc drops. Wheel or pinch zooms, dragging the ground pans, Shift and
            drag selects drones. With the map in focus the arrow keys move a cursor, Space uses the tool there, Ctrl and
            arrows pan. Digits 1 to 9 select drones.
          </p>
          <p role="status" class="warning">
            {problem.value}
          </p>
          <div class="keys">
            {kGroups.map((group) => (
              <>
                <h3 key={group}>{group}</h3>
                {(Object.keys(kActions) as Action[])
                  .filter((action) => kActions[action].group === group)
                  .map((action) => (
                    <div key={action}>
                      <span>{kActions[action].does}</span>
                      <button
                        type="button"
                        class="quiet"
                        aria-label={`${kActions[action].does}: ${settings.keys.value[action]}. Change the key`}
                        onClick={() => (asking.value = asking.value === action ? null : action)}
                      >
                        <kbd>{asking.value === action ? 'press a key' : settings.keys.value[action]}</kbd>
                      </button>
                    </div>
                  ))}
              </>
            ))}
          </div>
          <button type="button" onClick={() => (settings.keys.value = kUsualKeys)} style={{ marginTop: '14px' }}>
            Back to the usual keys
          </button>
        </div>
      )}
    </dialog>
  );
}
