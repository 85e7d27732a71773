import type { ComponentChildren } from 'preact';
import { useEffect, useRef, useState } from 'preact/hooks';

const kHoldMs = 1000;

interface Props {
  /** Where what is written on it does not say enough. */
  readonly label?: string;
  /** Drawn as about to act. */
  readonly isArmed?: boolean;
  readonly disabled: boolean;
  readonly title: string;
  readonly onConfirmed: () => void;
  /** It was let go too early. */
  readonly onLetGo: () => void;
  readonly children: ComponentChildren;
}

/** A button that acts only when it is held for a second, with pointer, Space or Enter. */
export function HoldButton({ label, isArmed, disabled, title, onConfirmed, onLetGo, children }: Props) {
  const [isHeld, setHeld] = useState(false);
  const timer = useRef(0);
  const release = (): void => {
    window.clearTimeout(timer.current);
    timer.current = 0;
    setHeld(false);
  };
  const letGo = (): void => {
    const wasHeld = timer.current !== 0;
    release();
    if (wasHeld) onLetGo();
  };
  const hold = (): void => {
    if (disabled || timer.current !== 0) return;
    setHeld(true);
    timer.current = window.setTimeout(() => {
      release();
      onConfirmed();
    }, kHoldMs);
  };
  useEffect(() => release, []);
  const isPress = (event: KeyboardEvent): boolean => event.key === ' ' || event.key === 'Enter';
  return (
    <button
      type="button"
      class={`stop ${isHeld ? 'is-held' : ''} ${isArmed ? 'is-armed' : ''}`}
      disabled={disabled}
      aria-label={label}
      title={title}
      onPointerDown={hold}
      onPointerUp={letGo}
      onPointerLeave={letGo}
      onPointerCancel={letGo}
      onBlur={letGo}
      onContextMenu={(event) => event.preventDefault()}
      onKeyDown={(event) => {
        if (!isPress(event)) return;
        event.preventDefault();
        event.stopPropagation();
        hold();
      }}
      onKeyUp={(event) => isPress(event) && letGo()}
    >
      <span class="fill" />
      {children}
    </button>
  );
}
