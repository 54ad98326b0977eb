// The one time of the page: what plays, what is scrubbed, what charts point at.
//
// set, play, pause => listeners. Everything that shows a moment listens; nothing else keeps a time.
(function (dbd) {
  'use strict';

  const SPEEDS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];
  const SHOWN = [0.01, 10];
  // [s] of watching that a run is given at first.
  const AT_FIRST = 7;

  class Clock {
    constructor() {
      this.time = 0;
      this.start = 0;
      this.end = 0;
      this.speed = 1;
      this.loop = true;
      this.playing = false;
      this.listeners = [];
      this.watchers = [];
      this.last = null;
      this.tick = this.tick.bind(this);
    }

    // Takes the range of a run and chooses a speed at which it is watched in some seconds.
    range(start, end) {
      this.start = start;
      this.end = end;
      this.time = start;
      const wanted = (end - start) / AT_FIRST;
      const near = (a, b) => Math.abs(Math.log(a / wanted)) - Math.abs(Math.log(b / wanted));
      const usual = SPEEDS.filter((speed) => speed >= SHOWN[0] && speed <= SHOWN[1]);
      // Beyond the usual speeds only where a run would otherwise be over at once or never end.
      const extreme = wanted < SHOWN[0] / 3 || wanted > SHOWN[1] * 3;
      this.speeds = extreme ? SPEEDS : usual;
      this.speed = wanted > 0 ? [...this.speeds].sort(near)[0] : 1;
    }

    onTime(listener) { this.listeners.push(listener); }

    onState(watcher) { this.watchers.push(watcher); }

    set(time) {
      this.time = Math.min(Math.max(time, this.start), this.end);
      for (const listener of this.listeners) listener(this.time);
    }

    changed() { for (const watcher of this.watchers) watcher(this); }

    play() {
      if (this.playing || !(this.end > this.start)) return;
      if (this.time >= this.end) this.set(this.start);
      this.playing = true;
      this.last = null;
      this.changed();
      requestAnimationFrame(this.tick);
    }

    pause() {
      if (!this.playing) return;
      this.playing = false;
      this.changed();
    }

    toggle() { if (this.playing) this.pause(); else this.play(); }

    faster(steps) {
      const at = this.speeds.indexOf(this.speed);
      this.speed = this.speeds[Math.min(Math.max(at + steps, 0), this.speeds.length - 1)];
      this.changed();
    }

    tick(now) {
      if (!this.playing) return;
      // A tab that slept does not jump.
      const passed = this.last === null ? 0 : Math.min((now - this.last) / 1000, 0.1);
      this.last = now;
      const next = this.time + passed * this.speed;
      if (next < this.end) {
        this.set(next);
      } else if (this.loop) {
        this.set(this.start);
      } else {
        this.set(this.end);
        this.pause();
        return;
      }
      requestAnimationFrame(this.tick);
    }
  }

  dbd.clock = new Clock();
  dbd.clock.allSpeeds = SPEEDS;
}(window.dbd = window.dbd || {}));
