// What is seen of the plant now, with the questions that the stage asks a film.
//
// frames => poses, tensions, forces. A short look ahead of the run tells how far it reaches and how large its forces are.
(function (dbd) {
  'use strict';

  const { WORDS } = dbd.film;
  const TABLES = ['springs', 'joints', 'jointSprings', 'forces'];

  class Live {
    // opened: the module's description; ahead: frames of the look ahead.
    constructor(opened, ahead) {
      const { mechanism } = opened.run;
      this.layout = opened.layout;
      this.bodies = mechanism.bodies.length;
      this.ahead = ahead || [];
      this.frames = this.ahead.length;
      this.traces = [];
      const { layout } = this;
      const ends = { springs: layout.joints, joints: layout.jointSprings, jointSprings: layout.forces, forces: layout.watched };
      this.counts = Object.fromEntries(TABLES.map((table) => [table, ends[table] - layout[table]]));
      this.frame = null;
    }

    get joints() { return { length: this.counts.joints }; }

    show(frame) { this.frame = frame; }

    poses(time, out) {
      if (this.frame) out.set(this.frame.subarray(this.layout.poses, this.layout.poses + this.bodies * WORDS));
      return out;
    }

    values(table, time, out) {
      if (this.frame) out.set(this.frame.subarray(this.layout[table], this.layout[table] + out.length));
      return out;
    }

    // The largest absolute value so far of some rows of a table.
    largest(table, of) {
      let most = 0;
      for (const frame of [...this.ahead, this.frame].filter(Boolean)) {
        for (let row = 0; row < this.counts[table]; row += 1) {
          const size = Math.abs(frame[this.layout[table] + row]);
          if (size > most && Number.isFinite(size) && (!of || of(row))) most = size;
        }
      }
      return most;
    }

    // Frames of the look ahead, for the reach of the motion.
    spread(most) {
      const count = Math.min(this.frames, most);
      return Array.from({ length: count }, (_, i) => Math.round((i * (this.frames - 1)) / Math.max(count - 1, 1)));
    }

    pose([frame], body, out, offset) {
      const from = this.layout.poses + body * WORDS;
      out.set(this.ahead[frame].subarray(from, from + WORDS), offset);
      return out;
    }
  }

  // Scales of colours and arrows grow with the largest value that is shown.
  function rescale(machine) {
    const { springs, arrows, film, mechanism } = machine;
    const grow = (value, most) => (Number.isFinite(value) && Math.abs(value) > most ? Math.abs(value) : most);
    const from = film.layout;
    for (let row = 0; row < film.counts.springs; row += 1) springs.largest = grow(film.frame[from.springs + row], springs.largest);
    mechanism.forces.forEach(({ unit }, row) => { arrows.largest[unit] = grow(film.frame[from.forces + row], arrows.largest[unit]); });
    const inside = springs.ofJoints;
    if (!inside) return;
    for (let row = 0; row < film.counts.jointSprings; row += 1) inside.largest = grow(film.frame[from.jointSprings + row], inside.largest);
  }

  dbd.live = { Live, rescale };
}(window.dbd = window.dbd || {}));
