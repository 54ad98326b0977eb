// Paths of chosen points over the whole run, with a bead where each point is now.
//
// places, film => rods between the frames of each path.
(function (dbd) {
  'use strict';

  const T = window.THREE;
  const { between, at } = dbd.batch;
  const { placed, WORDS } = dbd.film;
  const COLOURS = ['--accent-2', '--accent', '--accent-3', '--accent-4', '--accent-5', '--accent-6'];
  // Points offered; beyond, a list would be no help.
  const MOST = 300;

  // What can be traced: point read-outs first, then centres of bodies.
  function choices(mechanism, film) {
    const named = film.traces.map(({ name, place }) => ({ name, place }));
    const bodies = mechanism.bodies
      .map((body, row) => ({ name: body.name, place: { body: row, point: [0, 0, 0] }, spider: body.outline === 'Spider' }))
      .filter(({ spider }) => !spider);
    return named.concat(bodies).slice(0, MOST);
  }

  class Traces {
    constructor(machine) {
      this.machine = machine;
      this.choices = machine.film ? choices(machine.mechanism, machine.film) : [];
      this.paths = new Map();
    }

    // The points that are shown at first: read-outs, else the body that travels most.
    first() {
      const named = this.machine.film ? this.machine.film.traces.length : 0;
      if (named) return Array.from({ length: Math.min(named, 2) }, (_, i) => i);
      let [best, most] = [-1, 0.05 * this.machine.size];
      this.choices.slice(0, 50).forEach((choice, i) => {
        const points = this.path(choice.place, 60);
        const far = Math.max(...points.map((point) => Math.hypot(...point.map((v, k) => v - points[0][k]))));
        if (far > most * 1.02) [best, most] = [i, far];
      });
      return best < 0 ? [] : [best];
    }

    path(place, most) {
      const { film } = this.machine;
      const pose = new Float64Array(film.bodies * WORDS);
      return film.spread(most).map((frame) => {
        if (place.body === null) return place.point;
        film.pose([frame, 0], place.body, pose, place.body * WORDS);
        return placed(pose, place.body, place.point, [0, 0, 0]);
      });
    }

    show(index, shown) {
      const known = this.paths.get(index);
      if (known) {
        known.group.visible = shown;
      } else if (shown) {
        this.add(index);
      }
    }

    add(index) {
      const { place, name } = this.choices[index];
      const { radius, group } = this.machine;
      const paint = COLOURS[index % COLOURS.length];
      const rods = new dbd.batch.Batch('cylinder', {}, true);
      const points = this.path(place, 1200);
      const least = 0.05 * radius;
      let from = points[0];
      points.slice(1).forEach((to, i) => {
        const far = Math.hypot(...to.map((value, k) => value - from[k]));
        if (far < least && i < points.length - 2) return;
        rods.add(null, between(from, to, 0.16 * radius), paint, { what: 'trace', name });
        from = to;
      });
      const bead = new dbd.batch.Batch('sphere', {});
      bead.add(null, at(points[0], 0.5 * radius), paint, { what: 'trace', name });
      const made = new T.Group();
      made.add(rods.build(), bead.build());
      group.add(made);
      this.paths.set(index, { group: made, rods, bead, place });
      this.update();
    }

    update() {
      const { owners, radius } = this.machine;
      const point = new T.Vector3();
      for (const { group, bead, place } of this.paths.values()) {
        if (!group.visible) continue;
        point.fromArray(place.point).applyMatrix4(owners[this.machine.owner(place)]);
        bead.set(0, at(point.toArray(), 0.5 * radius));
      }
    }

    recolour() {
      for (const { rods, bead } of this.paths.values()) [rods, bead].forEach((batch) => batch.recolour());
    }
  }

  dbd.traces = { Traces };
}(window.dbd = window.dbd || {}));
