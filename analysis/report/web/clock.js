// The one time of the page: the replay, the curves and the keyboard all read and set it.

/// Index of the last of rising times at or before a time; 0 where there is none.
export function lastUpTo(times, time) {
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const mid = (low + high + 1) >> 1;
    if (times[mid] <= time) low = mid;
    else high = mid - 1;
  }
  return low;
}

export class Clock extends EventTarget {
  constructor(times) {
    super();
    this.times = times;
    this.time = times[0] ?? 0;
    this.rate = 1;
    this.playing = false;
  }

  get end() {
    return this.times[this.times.length - 1] ?? 0;
  }

  set(time) {
    this.time = Math.min(Math.max(time, this.times[0] ?? 0), this.end);
    this.dispatchEvent(new Event('time'));
  }

  /// To the next frame, or the one before.
  step(count) {
    this.pause();
    const near = this.index(this.time + 1e-9);
    const on = Math.abs(this.times[near] - this.time) < 1e-6;
    const to = near + count + (count < 0 && !on ? 1 : 0);
    this.set(this.times[Math.min(Math.max(to, 0), this.times.length - 1)]);
  }

  /// The last frame at or before a time.
  index(time) {
    return lastUpTo(this.times, time);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  play() {
    if (this.playing || this.times.length < 2) return;
    if (this.time >= this.end) this.set(this.times[0]);
    this.playing = true;
    this.dispatchEvent(new Event('state'));
    let last = performance.now();
    const tick = (now) => {
      if (!this.playing) return;
      // A tab that slept continues from its last time.
      const passed = Math.min(Math.max(now - last, 0), 250) / 1e3;
      last = now;
      this.set(this.time + passed * this.rate);
      if (this.time >= this.end) this.pause();
      else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.dispatchEvent(new Event('state'));
  }
}

/// Space plays, arrows step a frame (with shift a second), Home and End; not while a control that
/// needs these keys has the focus.
export function listenToKeys(clock) {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const on = event.target.closest?.('input, select, textarea, button, summary, a, [role=radio]');
    const key = event.key;
    const range = on?.matches('input[type=range]');
    if (key === ' ' && (!on || range)) clock.toggle();
    else if ((key === 'ArrowRight' || key === 'ArrowLeft') && (!on || range || on.matches('button, a, summary'))) {
      const way = key === 'ArrowRight' ? 1 : -1;
      if (event.shiftKey) { clock.pause(); clock.set(clock.time + way); }
      else clock.step(way);
    } else if (key === 'Home' && range) clock.set(clock.times[0]);
    else if (key === 'End' && range) clock.set(clock.end);
    else return;
    event.preventDefault();
  });
}
