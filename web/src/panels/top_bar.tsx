import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { age, clock } from '../model/units';
import { useApp } from './app_context';
import { HoldButton } from './hold_button';
import { Icon } from './icons';
import { MissionMenu } from './mission_menu';
import { PopoverButton } from './popover_button';
import { SpeedChoice } from './speed_choice';
import { WhoMenu } from './who_menu';

const kSpeeds = [1, 2, 5, 10, 20];

export function TopBar() {
  const { session, orders, isStopArmed } = useApp();
  const choices = useChoices();
  return (
    <header class="top">
      <h1 class="unseen">vigil, operator’s console</h1>
      <WhatFlies />
      <DataAge />
      <MissionClock />
      <span class="space" />
      <div class="group">
        <MissionMenu />
        <div class="group when-wide">
          {choices.map(({ icon, label, pressed, act }) => (
            <IconButton key={label} icon={icon} label={label} pressed={pressed} act={act} />
          ))}
        </div>
        <MoreMenu choices={choices} />
        <WhoMenu />
      </div>
      <div class="group alarms">
        <button
          type="button"
          class="land-all"
          disabled={!session.mayLand.value}
          title="Every drone lands where it is (Shift+L)"
          onClick={() => orders.landAll()}
        >
          <Icon name="land" />
          LAND ALL
        </button>
        <HoldButton
          label="Emergency stop of all drones: hold for one second"
          title="Motors off, all drones: hold for one second, or press . twice"
          disabled={!session.mayStopMotors.value}
          isArmed={isStopArmed.value}
          onConfirmed={() => orders.emergencyStop('all')}
          onLetGo={() => orders.stopLetGo('or press . twice within 0.8 s')}
        >
          <span>EMERGENCY STOP</span>
        </HoldButton>
      </div>
    </header>
  );
}

interface Choice {
  readonly icon: Parameters<typeof Icon>[0]['name'];
  readonly label: string;
  readonly pressed?: boolean | undefined;
  readonly act: () => void;
}

/** What is there as buttons where the window is wide, and as a menu where it is not. */
function useChoices(): readonly Choice[] {
  const { isHelpOpen, isLogOpen, settings } = useApp();
  const isDark = settings.theme.value === 'dark';
  const isMuted = settings.isMuted.value;
  return [
    {
      icon: 'log',
      label: 'Event log',
      pressed: isLogOpen.value,
      act: () => (isLogOpen.value = !isLogOpen.value),
    },
    {
      icon: isMuted ? 'mute' : 'sound',
      label: isMuted ? 'Sound the alarms' : 'Mute the alarms',
      act: () => (settings.isMuted.value = !isMuted),
    },
    {
      icon: isDark ? 'sun' : 'moon',
      label: isDark ? 'Light theme' : 'Dark theme',
      act: () => (settings.theme.value = isDark ? 'light' : 'dark'),
    },
    { icon: 'help', label: 'Help and keys', act: () => (isHelpOpen.value = true) },
  ];
}

function MoreMenu({ choices }: { choices: readonly Choice[] }) {
  return (
    <PopoverButton label="More" title="More" face="⋯" isForNarrow>
      {(close) =>
        choices.map(({ icon, label, act }) => (
          <button key={label} type="button" onClick={() => (close(), act())}>
            <Icon name={icon} />
            {label}
          </button>
        ))
      }
    </PopoverButton>
  );
}

function IconButton({ icon, label, pressed, act }: Choice) {
  return (
    <button type="button" class="quiet" aria-label={label} title={label} aria-pressed={pressed} onClick={act}>
      <Icon name={icon} />
    </button>
  );
}

function WhatFlies() {
  const { session } = useApp();
  const mission = session.mission.value;
  const isLive = session.isLive.value;
  return (
    <div class="group flies">
      <span class={`badge ${isLive ? 'is-fresh ok' : 'alarm'}`} data-testid="badge">
        <span class="dot" />
        {isLive ? (mission?.fleet ?? '…') : 'STALE'}
      </span>
      <div class="brand">
        <strong title={mission?.mission.name}>{mission?.mission.name ?? 'vigil'}</strong>
        <span>{mission ? `${session.fleetSize.value} drones` : 'connecting'}</span>
      </div>
    </div>
  );
}

/** Counts on its own while nothing comes: old data must be seen to age. */
function DataAge() {
  const { session } = useApp();
  const now = useSignal(0);
  useEffect(() => {
    const timer = window.setInterval(() => now.value++, 100);
    return () => window.clearInterval(timer);
  }, []);
  void session.beat.value;
  void now.value;
  const seconds = session.dataAgeS();
  const isOld = !session.isLive.value || seconds > 0.5;
  return (
    <div class="figure" title="Time since what is shown was true">
      <span class="name">data age</span>
      <span class={`value ${isOld ? 'alarm' : ''}`} data-testid="data-age">
        {age(seconds)}
      </span>
    </div>
  );
}

function MissionClock() {
  const { session } = useApp();
  void session.beat.value;
  const { snapshot } = session;
  const display = session.mission.value?.display;
  const isPaused = snapshot?.isPaused ?? false;
  return (
    <div class="group">
      <div class="figure">
        <span class="name">mission</span>
        <span class="value" data-testid="mission-clock">
          {snapshot ? clock(snapshot.timeS) : '–'}
          {isPaused && <small> paused</small>}
        </span>
      </div>
      {display?.can_pause && !session.isRecording.value && (
        <IconButton
          icon={isPaused ? 'play' : 'pause'}
          label={isPaused ? 'Go on' : 'Pause the simulation'}
          act={() => void session.command({ type: isPaused ? 'resume_clock' : 'pause' })}
        />
      )}
      {display?.can_change_speed && !session.isRecording.value && (
        <SpeedChoice label="Speed of the simulation" factors={kSpeeds} />
      )}
    </div>
  );
}
