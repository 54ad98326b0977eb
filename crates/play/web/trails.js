// Paths that the scene's points have taken, of the last seconds.
//
// points, frames => rods between places; the oldest are overwritten.
(function (dbd) {
  'use strict';

  const T = window.THREE;
  const { between, at, Batch } = dbd.batch;
  const { placed } = dbd.film;
  const COLOURS = ['--accent-2', '--accent', '--accent-3', '--accent-4', '--accent-5', '--accent-6'];
  const MOST = 6;
  const RODS = 500;

  class Trails {
    constructor(machine, traces) {
      this.machine = machine;
      this.group = new T.Group();
      this.paths = traces.slice(0, MOST).map(({ name, place }, i) => {
        const rods = new Batch('cylinder', {}, true);
        const bead = new Batch('sphere', {});
        for (let rod = 0; rod < RODS; rod += 1) rods.add(null, new T.Matrix4().makeScale(0, 0, 0), COLOURS[i], { what: 'trace', name });
        bead.add(null, at(place.point, 0.5 * machine.radius), COLOURS[i], { what: 'trace', name });
        this.group.add(rods.build(), bead.build());
        return { place, rods, bead, last: null, next: 0 };
      });
      machine.group.add(this.group);
    }

    point({ body, point }) { return body === null ? point : placed(this.machine.poses, body, point, [0, 0, 0]); }

    // Goes on to where the points are now; `jump` where time was taken back.
    update(jump) {
      const { radius } = this.machine;
      for (const path of this.paths) {
        const to = this.point(path.place);
        if (!to.every(Number.isFinite)) continue;
        path.bead.set(0, at(to, 0.5 * radius));
        if (jump || !path.last) {
          if (jump) this.clear(path);
          path.last = to;
          continue;
        }
        if (Math.hypot(...to.map((value, i) => value - path.last[i])) < 0.2 * radius) continue;
        path.rods.set(path.next, between(path.last, to, 0.16 * radius));
        path.next = (path.next + 1) % RODS;
        path.last = to;
      }
    }

    clear(path) {
      const none = new T.Matrix4().makeScale(0, 0, 0);
      for (let rod = 0; rod < RODS; rod += 1) path.rods.set(rod, none);
      path.next = 0;
    }

    recolour() { for (const { rods, bead } of this.paths) [rods, bead].forEach((batch) => batch.recolour()); }
  }

  dbd.trails = { Trails };
}(window.dbd = window.dbd || {}));
