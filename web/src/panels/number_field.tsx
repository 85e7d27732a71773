import { useRef, useState } from 'preact/hooks';
import { parseNumber } from '../model/units';

interface Props {
  readonly label: string;
  readonly value: number | null;
  /** Shown where the value is null, which an empty field means. */
  readonly empty?: string;
  readonly least?: number;
  readonly most?: number;
  readonly decimals?: number;
  readonly wide?: boolean;
  readonly hidesLabel?: boolean;
  readonly disabled?: boolean;
  readonly set: (value: number | null) => void;
}

/**
 * A number that takes effect when the field is left. Enter leaves it with what was typed, Escape with what was there before:
 * the next key is the page's. The wheel and the arrow keys change it by a tenth.
 */
export function NumberField(props: Props) {
  const { label, value, least = -Infinity, most = Infinity, decimals = 3 } = props;
  const [typed, setTyped] = useState<string | null>(null);
  const shown = typed ?? (value === null ? '' : String(Number(value.toFixed(decimals))));
  const parsed = shown.trim() === '' && props.empty !== undefined ? null : parseNumber(shown);
  const isWrong =
    typed !== null &&
    !(shown.trim() === '' && props.empty !== undefined) &&
    (parsed === null || parsed < least || parsed > most);
  const isGivenUp = useRef(false);
  const settle = (): void => {
    if (!isGivenUp.current && typed !== null && !isWrong && parsed !== value) props.set(parsed);
    isGivenUp.current = false;
    setTyped(null);
  };
  const nudge = (factor: number): void => {
    const from = value ?? 1;
    const next = Math.min(most, Math.max(least, from + factor * Math.max(0.1, Math.abs(from) * 0.1)));
    props.set(Number(next.toFixed(decimals)));
  };
  const input = (
    <input
      inputMode="decimal"
      value={shown}
      placeholder={props.empty}
      disabled={props.disabled}
      aria-label={props.hidesLabel ? label : undefined}
      aria-invalid={isWrong}
      onInput={(event) => setTyped(event.currentTarget.value)}
      onBlur={settle}
      onKeyDown={(event) => {
        if (event.key === 'Enter' || event.key === 'Escape') {
          event.stopPropagation();
          isGivenUp.current = event.key === 'Escape';
          event.currentTarget.blur();
        } else if (event.key === 'ArrowUp' || event.key === 'ArrowDown') {
          event.preventDefault();
          nudge(event.key === 'ArrowUp' ? 1 : -1);
        }
      }}
      onWheel={(event) => {
        if (document.activeElement !== event.currentTarget) return;
        event.preventDefault();
        nudge(event.deltaY < 0 ? 1 : -1);
      }}
    />
  );
  if (props.hidesLabel) return input;
  return (
    <label class={props.wide ? 'wide' : ''}>
      {label}
      {input}
    </label>
  );
}
