import type { ComponentChildren } from 'preact';
import { usePopover } from './use_popover';

interface Props {
  /** What the button is called. */
  readonly label: string;
  /** Shown where the pointer rests on it; none where its face says enough. */
  readonly title?: string;
  /** What the button shows. */
  readonly face: ComponentChildren;
  readonly isForNarrow?: boolean;
  /** The menu, made while it is open. */
  readonly children: (close: () => void) => ComponentChildren;
}

/** A quiet button with a menu under it. */
export function PopoverButton({ label, title, face, isForNarrow = false, children }: Props) {
  const { isOpen, setOpen, root } = usePopover();
  return (
    <div class={isForNarrow ? 'popover when-narrow' : 'popover'} ref={root}>
      <button
        type="button"
        class="quiet"
        aria-label={label}
        title={title}
        aria-expanded={isOpen}
        onClick={() => setOpen(!isOpen)}
      >
        {face}
      </button>
      {isOpen && <div class="menu">{children(() => setOpen(false))}</div>}
    </div>
  );
}
