import type { AreaStatus } from '../link/messages';
import { isChanged } from '../model/staging';
import { allEntries, type Entry, type EntryName, type Kind } from '../model/targets';
import { duration, percent } from '../model/units';
import { useApp } from './app_context';
import { EntryEditor } from './entry_editor';
import { Icon, type IconName } from './icons';

const kKindIcons: Record<Kind, IconName> = { cluster: 'cluster', area: 'area', no_fly: 'noFly' };
const kKindWords: Record<Kind, string> = { cluster: 'cluster', area: 'area', no_fly: 'no-fly polygon' };

/** An outlook errs by about a fifth. */
const kWorthTelling = 1.2;

/** Everything that is watched or forbidden, with how well it is served. */
export function Areas() {
  const { session, editor } = useApp();
  const entries = allEntries(session.draft.value);
  const selected = editor.selected.value;
  return (
    <section class="panel panel-body" aria-label="Areas" style={{ flex: 1 }}>
      <header>
        <h2>Areas</h2>
        <span class="dim">{entries.length}</span>
      </header>
      {entries.length === 0 && (
        <p class="pad dim">Nothing is watched yet. Take the point tool and click on the field.</p>
      )}
      <ul class="areas">
        {entries.map(({ kind, entry }) => (
          <li key={`${kind} ${entry.name}`}>
            <AreaRow which={{ kind, name: entry.name }} entry={entry} />
            {selected?.kind === kind && selected.name === entry.name && <EntryEditor which={selected} entry={entry} />}
          </li>
        ))}
      </ul>
      <FloorNote />
    </section>
  );
}

function AreaRow({ which, entry }: { which: EntryName; entry: Entry }) {
  const { session, editor } = useApp();
  const status = session.status.value?.areas.find((area) => area.kind === which.kind && area.name === which.name);
  const selected = editor.selected.value;
  const isSelected = selected?.kind === which.kind && selected.name === which.name;
  const isGhost = isChanged(session.committed.value, session.draft.value, which);
  const own = session.hello.value?.client;
  const others = session.operators.value.filter(
    (o) => o.client !== own && o.editing.some((what) => what.kind === which.kind && what.name === which.name),
  );
  return (
    <button
      type="button"
      aria-pressed={isSelected}
      onClick={() => editor.select(isSelected ? null : which)}
      data-testid={`area-${which.name}`}
    >
      <span class={status?.is_overdue ? 'alarm' : which.kind === 'no_fly' ? 'warning' : 'dim'}>
        <Icon name={status?.is_overdue ? 'alarm' : kKindIcons[which.kind]} small />
        <span class="unseen">{kKindWords[which.kind]}</span>
      </span>
      <span class="entry-name">
        {entry.name}
        {'protect' in entry && entry.protect && (
          <span title="Protected: keeps its drones where there are fewer">
            {' '}
            <Icon name="shield" small />
            <span class="unseen">protected</span>
          </span>
        )}
        {isGhost && <span class="ok"> staged</span>}
        {others.map((o) => (
          <span key={o.client} class="ok">
            {' '}
            ✎ {o.name}
          </span>
        ))}
      </span>
      {'weight' in entry ? (
        <span title="Weight">×{Number(entry.weight.toPrecision(4))}</span>
      ) : (
        <span class="dim">no entry</span>
      )}
      {'weight' in entry && <Served status={status} />}
    </button>
  );
}

/** Share of attention asked (mark) and achieved (bar), time since the last visit, and the deadline. */
function Served({ status }: { status: AreaStatus | undefined }) {
  if (!status) return <span class="entry-share">waiting for figures</span>;
  const { asked, achieved, age_s, deadline_s } = status;
  const left = deadline_s === null || age_s === null ? null : deadline_s - age_s;
  const foreseen = status.foreseen_s;
  const lateBy =
    deadline_s !== null && foreseen !== null && foreseen > kWorthTelling * deadline_s ? foreseen - deadline_s : 0;
  return (
    <>
      <span class="entry-share" title="Share of attention: achieved (bar) of asked (mark)">
        <span class="bars" aria-hidden="true">
          <i style={{ width: `${Math.min(100, 100 * Math.max(0, achieved ?? 0))}%` }} />
          <b style={{ left: `${Math.min(99, 100 * Math.max(0, asked ?? 0))}%` }} />
        </span>
        <span>
          {percent(achieved).replace(' %', '')} <span class="unseen">percent achieved </span>of {percent(asked)}
        </span>
      </span>
      <span
        title="Time since its longest unseen part was seen; or what is left until its deadline"
        class={`entry-age ${status.is_overdue ? 'alarm' : left !== null && left < 5 ? 'warning' : ''}`}
      >
        {left === null ? `${duration(age_s)} ago` : left >= 0 ? `${duration(left)} left` : `late ${duration(-left)}`}
      </span>
      {lateBy > 0 && (
        <span class="entry-foreseen warning" title="With the drones that cover now, looked ahead">
          will be late by {duration(lateBy)}
        </span>
      )}
    </>
  );
}

function FloorNote() {
  const floor = useApp().session.draft.value.uniform_floor;
  if (floor === 0) return null;
  return <p class="pad dim">{percent(floor)} of all attention is spread evenly over the field.</p>;
}
