import { apply, find, type Edit, type EntryName, type Targets } from './targets';

/** Edits that only this console has: shown as a ghost until they are committed or dropped. All functions are pure. */

/** What one gesture did: undone and redone as a whole. */
export interface Step {
  readonly what: string;
  readonly edits: readonly Edit[];
}

export interface Staging {
  /** The revision that the operator saw when the first of these steps was made. */
  readonly basedOn: number;
  readonly steps: readonly Step[];
  /** Steps taken back, the last first. */
  readonly undone: readonly Step[];
}

export const nothingStaged = (revision: number): Staging => ({ basedOn: revision, steps: [], undone: [] });

export const isStaged = (staging: Staging): boolean => staging.steps.length > 0;

export const editsOf = (staging: Staging): Edit[] => staging.steps.flatMap((step) => step.edits);

export function stage(staging: Staging, step: Step, revision: number): Staging {
  const basedOn = isStaged(staging) ? staging.basedOn : revision;
  return { basedOn, steps: [...staging.steps, step], undone: [] };
}

/** The last step with what the newest gesture makes of it: a drag is one step however many moves it has. */
export function restage(staging: Staging, step: Step, revision: number): Staging {
  return stage({ ...staging, steps: staging.steps.slice(0, -1) }, step, isStaged(staging) ? staging.basedOn : revision);
}

export function undoStep(staging: Staging): Staging {
  const last = staging.steps[staging.steps.length - 1];
  if (!last) return staging;
  return { ...staging, steps: staging.steps.slice(0, -1), undone: [last, ...staging.undone] };
}

export function redoStep(staging: Staging): Staging {
  const [next, ...rest] = staging.undone;
  return next ? { ...staging, steps: [...staging.steps, next], undone: rest } : staging;
}

/** The targets as they would be; null where a step no longer fits. */
export function draftOf(base: Targets, staging: Staging): Targets | null {
  return editsOf(staging).reduce<Targets | null>((targets, edit) => targets && apply(targets, edit), base);
}

/** The steps that still fit when others have changed the targets, and those that do not. */
export function rebase(base: Targets, staging: Staging): { staging: Staging; lost: Step[] } {
  const lost: Step[] = [];
  const kept: Step[] = [];
  let targets = base;
  for (const step of staging.steps) {
    const after = step.edits.reduce<Targets | null>((draft, edit) => draft && apply(draft, edit), targets);
    if (after) {
      targets = after;
      kept.push(step);
    } else lost.push(step);
  }
  return { staging: { ...staging, steps: kept, undone: lost.length > 0 ? [] : staging.undone }, lost };
}

/**
 * What is left when the steps that were sent have become the committed targets: what was staged, or taken back, after
 * they were sent. A step is told by its identity: who changes a step makes another.
 */
export function unsent(staging: Staging, sent: readonly Step[], revision: number): Staging {
  const isUnsent = (step: Step): boolean => !sent.includes(step);
  return { basedOn: revision, steps: staging.steps.filter(isUnsent), undone: staging.undone.filter(isUnsent) };
}

/** The entries that staged edits change, for other operators to see. */
export function touched(staging: Staging): EntryName[] {
  const names = new Map<string, EntryName>();
  for (const edit of editsOf(staging)) {
    if (edit.op === 'set_uniform_floor') continue;
    const name = edit.op === 'add' ? edit.entry.name : edit.name;
    names.set(`${edit.kind} ${name}`, { kind: edit.kind, name });
  }
  return [...names.values()].slice(0, 20);
}

/** What draws an entry differently from its committed self. */
export const isChanged = (base: Targets, draft: Targets, which: EntryName): boolean =>
  find(base, which) !== find(draft, which);
