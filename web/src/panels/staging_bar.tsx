import { useApp } from './app_context';
import { Icon } from './icons';

/** What is staged, and the two ways out. */
export function StagingBar() {
  const { session, editor } = useApp();
  const { steps, undone } = session.staging.value;
  const sketch = editor.sketch.value;
  const isPolygon = editor.tool.value === 'area' || editor.tool.value === 'no-fly';
  if (isPolygon && sketch.length > 0) return <SketchBar corners={sketch.length} />;
  if (steps.length === 0 && undone.length === 0) return null;
  const last = steps[steps.length - 1]?.what ?? 'all taken back';
  return (
    <div class="staging" role="region" aria-label="Staged edits">
      <p>
        <strong role="status">
          {steps.length} staged {steps.length === 1 ? 'edit' : 'edits'}
        </strong>
        {session.previewProblem.value ? (
          <span class="what warning">{session.previewProblem.value}</span>
        ) : (
          <span class="what">{last}</span>
        )}
      </p>
      <button type="button" class="quiet" aria-label="Undo" title="Undo (Ctrl+Z)" onClick={() => editor.undo()}>
        <Icon name="undo" />
      </button>
      <button
        type="button"
        class="quiet"
        aria-label="Redo"
        title="Redo (Ctrl+Shift+Z)"
        disabled={undone.length === 0}
        onClick={() => editor.redo()}
      >
        <Icon name="redo" />
      </button>
      <button type="button" onClick={() => editor.drop()}>
        Drop <kbd>Esc</kbd>
      </button>
      <button
        type="button"
        class="primary"
        disabled={!session.mayOperate.value || editor.isCommitting.value || steps.length === 0}
        onClick={() => void editor.commit()}
      >
        Commit <kbd>Enter</kbd>
      </button>
    </div>
  );
}

function SketchBar({ corners }: { corners: number }) {
  const { editor } = useApp();
  return (
    <div class="staging" role="region" aria-label="Outline">
      <p>
        <strong role="status">
          {corners} {corners === 1 ? 'corner' : 'corners'}
        </strong>
      </p>
      <button type="button" onClick={() => editor.drop()}>
        Drop <kbd>Esc</kbd>
      </button>
      <button type="button" class="primary" disabled={corners < 3} onClick={() => editor.finishSketch()}>
        Close outline <kbd>Enter</kbd>
      </button>
    </div>
  );
}
