import { kActions } from '../model/keyboard';
import { kTools, type Tool } from '../session/editor';
import { useApp } from './app_context';
import { Icon, type IconName } from './icons';

const kLooks: Record<Tool, { icon: IconName; word: string; action: keyof typeof kActions }> = {
  select: { icon: 'select', word: 'Select', action: 'tool-select' },
  point: { icon: 'point', word: 'Point', action: 'tool-point' },
  lasso: { icon: 'lasso', word: 'Lasso', action: 'tool-lasso' },
  brush: { icon: 'brush', word: 'Brush', action: 'tool-brush' },
  area: { icon: 'area', word: 'Area', action: 'tool-area' },
  'no-fly': { icon: 'noFly', word: 'No-fly', action: 'tool-no-fly' },
  measure: { icon: 'measure', word: 'Measure', action: 'tool-measure' },
  'go-to': { icon: 'goTo', word: 'Go to', action: 'tool-go-to' },
};

const isEditing = (tool: Tool): boolean => tool !== 'select' && tool !== 'measure';

export function Tools() {
  const { editor, session, settings } = useApp();
  const keys = settings.keys.value;
  return (
    <section class="panel" aria-label="Tools">
      <div class="tools" role="radiogroup" aria-label="Tool in hand">
        {kTools.map((tool) => {
          const look = kLooks[tool];
          return (
            <button
              key={tool}
              type="button"
              role="radio"
              aria-checked={editor.tool.value === tool}
              disabled={isEditing(tool) && !session.mayOperate.value}
              title={`${kActions[look.action].does} (${keys[look.action]})`}
              onClick={() => editor.take(tool)}
            >
              <Icon name={look.icon} />
              {look.word}
            </button>
          );
        })}
      </div>
    </section>
  );
}
