import { useState } from 'preact/hooks';
import { useApp } from './app_context';
import { Icon } from './icons';
import { PopoverButton } from './popover_button';

const kRoleNames = { viewer: 'viewer', operator: 'operator', safety_pilot: 'safety pilot' } as const;

/** Who is at this console, and who else is there. */
export function WhoMenu() {
  const { session } = useApp();
  const hello = session.hello.value;
  const others = session.operators.value.filter((operator) => operator.client !== hello?.client);
  const who = hello ? `${hello.name}, ${kRoleNames[hello.role]}` : 'nobody yet';
  return (
    <PopoverButton
      label={`Operators: ${who}${others.length > 0 ? ` and ${others.length} more` : ''}`}
      face={
        <>
          <Icon name="person" />
          <span data-testid="who">
            <span class="own-name">{hello?.name ?? '–'}</span>
            {others.length > 0 && <span class="ok"> +{others.length}</span>}
          </span>
        </>
      }
    >
      {(close) => (
        <>
          <p class="pad" style={{ margin: '6px 0 0' }}>
            You are <strong>{who}</strong>.
          </p>
          {others.length > 0 && (
            <ul class="pad" aria-label="Other operators" style={{ margin: 0, listStyle: 'none' }}>
              {others.map((operator) => (
                <li key={operator.client}>
                  <strong>{operator.name}</strong> <span class="dim">{kRoleNames[operator.role]}</span>
                  {operator.editing.length > 0 && (
                    <span class="ok"> edits {operator.editing.map((what) => what.name).join(', ')}</span>
                  )}
                </li>
              ))}
            </ul>
          )}
          <WhoForm done={close} />
        </>
      )}
    </PopoverButton>
  );
}

/** Name, role and, where the program wants one, a token. */
export function WhoForm({ done }: { done: () => void }) {
  const { session, settings, introduce } = useApp();
  const hello = session.hello.value;
  const wantsToken = hello?.login ?? session.linkState.value.phase === 'refused';
  const [name, setName] = useState(settings.name.value);
  const [role, setRole] = useState<string>(hello?.role ?? '');
  const [token, setToken] = useState('');
  return (
    <form
      class="fields pad"
      onSubmit={(event) => {
        event.preventDefault();
        introduce(name.trim(), token, role);
        done();
      }}
    >
      <label class="wide">
        Name
        <input value={name} maxLength={32} autocomplete="off" onInput={(event) => setName(event.currentTarget.value)} />
      </label>
      {hello && (
        <label class="wide">
          Role
          <select value={role} onChange={(event) => setRole(event.currentTarget.value)}>
            {hello.roles.map((word) => (
              <option key={word} value={word}>
                {kRoleNames[word]}
              </option>
            ))}
          </select>
        </label>
      )}
      {wantsToken && (
        <label class="wide">
          Token
          <input
            type="password"
            value={token}
            autocomplete="off"
            onInput={(event) => setToken(event.currentTarget.value)}
          />
        </label>
      )}
      <button type="submit" class="primary wide">
        Connect
      </button>
    </form>
  );
}
