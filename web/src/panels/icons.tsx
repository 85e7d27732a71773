/** Line icons on a 20 x 20 grid, drawn for this console. They stand beside words or have a label; alone they are hidden from screen readers. */
const kPaths = {
  select: 'M5 3l10 6-4.5 1.2L8 15z',
  point: 'M10 17c3.5-4 5-6.3 5-8.5A5 5 0 0 0 5 8.5C5 10.7 6.5 13 10 17zM10 7v3M8.5 8.5h3',
  lasso:
    'M10 4c4 0 7 1.8 7 4.2S14 12.5 10 12.5 3 10.7 3 8.2 6 4 10 4zM6.5 12c-1.5.8-1.5 3 .5 3.5M7 15.5c1 .3 1 1.3.5 2',
  brush: 'M16 4L9 11M9 11l-1.5-.5C5.5 10.5 5 13 3.5 15c3 .8 6 .2 6.5-2z',
  area: 'M4 7l6-3 6 4-2 8H6zM4 7h0M10 4h0M16 8h0M14 16h0M6 16h0',
  noFly: 'M10 3a7 7 0 1 0 0 14 7 7 0 0 0 0-14zM5.2 5.2l9.6 9.6',
  measure: 'M3 13L13 3l4 4L7 17zM6 10l2 2M9 7l2 2M12 4l2 2',
  undo: 'M7 5L3.5 8.5 7 12M3.5 8.5H12a4 4 0 0 1 0 8H9',
  redo: 'M13 5l3.5 3.5L13 12M16.5 8.5H8a4 4 0 0 0 0 8h3',
  layers: 'M10 3l7 4-7 4-7-4zM3.5 11l6.5 3.7 6.5-3.7M3.5 14l6.5 3.7 6.5-3.7',
  fit: 'M3 7V3h4M13 3h4v4M17 13v4h-4M7 17H3v-4M8 8h4v4H8z',
  plus: 'M10 4v12M4 10h12',
  minus: 'M4 10h12',
  close: 'M5 5l10 10M15 5L5 15',
  pause: 'M7 4v12M13 4v12',
  play: 'M6 4l10 6-10 6z',
  stepBack: 'M15 4l-8 6 8 6zM5 4v12',
  stepOn: 'M5 4l8 6-8 6zM15 4v12',
  sun: 'M10 6.5a3.5 3.5 0 1 0 0 7 3.5 3.5 0 0 0 0-7zM10 2v1.5M10 16.5V18M2 10h1.5M16.5 10H18M4.3 4.3l1.1 1.1M14.6 14.6l1.1 1.1M15.7 4.3l-1.1 1.1M5.4 14.6l-1.1 1.1',
  moon: 'M16 11.5A6.5 6.5 0 0 1 8.5 4 6.5 6.5 0 1 0 16 11.5z',
  sound: 'M3 8v4h3l4 3.5v-11L6 8zM13 7.5c1.3 1.5 1.3 3.5 0 5M15.3 5.5c2.5 2.6 2.5 6.4 0 9',
  mute: 'M3 8v4h3l4 3.5v-11L6 8zM13 8l4 4M17 8l-4 4',
  help: 'M7.5 7.5a2.5 2.5 0 1 1 3.6 2.2c-.8.5-1.1.9-1.1 1.8M10 14.5v.1M10 2.5a7.5 7.5 0 1 0 0 15 7.5 7.5 0 0 0 0-15z',
  plots: 'M3.5 3v13.5H17M6 13l3.5-5 3 3L17 5',
  log: 'M4 5h12M4 10h12M4 15h8',
  file: 'M5 3h7l3 3v11H5zM12 3v3h3M8 10h4M8 13h4',
  person: 'M10 4a3 3 0 1 0 0 6 3 3 0 0 0 0-6zM4 17c.5-3.5 3-5 6-5s5.5 1.5 6 5',
  ok: 'M4 10.5l4 4 8-9',
  info: 'M10 9v5M10 6v.1M10 2.5a7.5 7.5 0 1 0 0 15 7.5 7.5 0 0 0 0-15z',
  warning: 'M10 3l7.5 13.5h-15zM10 8v4M10 14.2v.1',
  alarm: 'M6.5 3h7L17 6.5v7L13.5 17h-7L3 13.5v-7zM7.5 7.5l5 5M12.5 7.5l-5 5',
  shield: 'M10 3l6 2v5c0 4-3 6-6 7-3-1-6-3-6-7V5z',
  takeOff: 'M10 16V5M5.5 9L10 4.5 14.5 9M4 17.5h12',
  land: 'M10 3v11M5.5 10L10 14.5 14.5 10M4 17.5h12',
  home: 'M3 10l7-6 7 6M5 9v8h10V9M8.5 17v-4h3v4',
  goTo: 'M4 16c0-6 3-8 9-8M10 4.5L13.5 8 10 11.5M16.5 4v8',
  resume: 'M4 10a6 6 0 1 1 2 4.5M4 15v-4h4',
  giveBack: 'M3 10h11M10 6l4 4-4 4M17 4v12',
  cluster:
    'M6 5a1 1 0 1 0 .01 0zM13 4a1 1 0 1 0 .01 0zM9.5 9a1 1 0 1 0 .01 0zM5 13a1 1 0 1 0 .01 0zM14.5 11.5a1 1 0 1 0 .01 0zM10.5 15a1 1 0 1 0 .01 0z',
  ahead: 'M3 15c2-7 5-9 9-9M12 3l4 3-4 3M16 12.5a1.5 1.5 0 1 0 .01 0zM4 17.5h1.5M8 17.5h1.5M12 17.5h1.5',
  edit: 'M4 16l1-4 8-8 3 3-8 8zM11.5 5.5l3 3',
} as const;

export type IconName = keyof typeof kPaths;

export function Icon({ name, small = false }: { name: IconName; small?: boolean }) {
  return (
    <svg class={small ? 'icon small' : 'icon'} viewBox="0 0 20 20" aria-hidden="true">
      <path d={kPaths[name]} />
    </svg>
  );
}
