// Loads and inputs as arrows: straight for forces and shifts, arcs for torques.
//
// (place, direction, value) => length or size of each arrow; the largest value of the run has the full one.
(function (dbd) {
  'use strict';

  const T = window.THREE;
  const { between } = dbd.batch;

  class Arrows {
    constructor(machine) {
      this.machine = machine;
      const { mechanism, film, look } = machine;
      const forces = mechanism.forces;
      this.values = new Float32Array(forces.length);
      [this.shafts, this.heads, this.arcs] = ['cylinder', 'cone', 'arc'].map((kind) => machine.batch(kind, false, { above: true }));
      this.largest = {};
      for (const { unit } of forces) {
        this.largest[unit] = film ? film.largest('forces', (row) => forces[row].unit === unit) : 0;
      }
      this.rows = forces.map((force, row) => {
        const name = force.input || 'load';
        const label = { what: 'force', row, name, unit: force.unit };
        const torque = force.kind === 'torque';
        return {
          name, label, unit: force.unit, torque, kind: force.kind,
          shaft: torque ? this.arcs.add(null, null, '--force', label) : this.shafts.add(null, null, '--force', label),
          head: this.heads.add(null, null, '--force', label),
          owner: machine.owner(force.at), at: force.at.point,
          direction: new T.Vector3().fromArray(force.direction.vector),
          axes: force.direction.body, tip: new T.Vector3(),
        };
      });
      this.shown = !look.ghost;
    }

    show(shown) {
      this.shown = shown;
      for (const batch of [this.shafts, this.heads, this.arcs]) batch.mesh.visible = shown;
    }

    update(time) {
      const { film, owners, radius, size } = this.machine;
      if (film) film.values('forces', time, this.values);
      if (!this.shown) return;
      const none = new T.Matrix4().makeScale(0, 0, 0);
      const turn = new T.Quaternion();
      this.rows.forEach((row, i) => {
        const value = this.values[i];
        const share = this.largest[row.unit] > 0 ? value / this.largest[row.unit] : 0;
        const batch = row.torque ? this.arcs : this.shafts;
        if (!(Math.abs(share) > 1e-3)) {
          batch.set(row.shaft, none);
          this.heads.set(row.head, none);
          row.tip.set(NaN, NaN, NaN);
          return;
        }
        const from = new T.Vector3().fromArray(row.at).applyMatrix4(owners[row.owner]);
        const direction = row.direction.clone();
        if (row.axes !== null) direction.applyQuaternion(turn.setFromRotationMatrix(owners[row.axes]));
        direction.multiplyScalar(Math.sign(share));
        if (row.torque) this.arc(row, from, direction, Math.abs(share), radius, size);
        else this.straight(row, from, direction, Math.abs(share), radius, size);
      });
    }

    straight(row, from, direction, share, radius, size) {
      const thick = 0.5 * radius;
      const head = 3.2 * thick * Math.min(1, 0.35 + share);
      const start = from.clone().addScaledVector(direction, 1.8 * radius);
      const length = 0.05 * size + 0.2 * size * share;
      const neck = start.clone().addScaledVector(direction, Math.max(length - head, 0.2 * length));
      row.tip.copy(neck).addScaledVector(direction, head * 1.6);
      this.shafts.set(row.shaft, between(start.toArray(), neck.toArray(), thick));
      this.heads.set(row.head, between(neck.toArray(), row.tip.toArray(), 0.62 * head));
    }

    // Three quarters of a circle about the axis, its head at the end, by the right hand.
    arc(row, from, direction, share, radius, size) {
      const wide = Math.max(4.4 * radius, 0.06 * size) * (0.6 + 0.5 * share);
      const turn = new T.Quaternion().setFromUnitVectors(new T.Vector3(0, 0, 1), direction);
      const lift = from.clone().addScaledVector(direction, 1.2 * radius);
      this.arcs.set(row.shaft, new T.Matrix4().compose(lift, turn, new T.Vector3(wide, wide, wide)));
      // The arc ends at −y of its plane and runs on along +x.
      const end = new T.Vector3(0, -wide, 0).applyQuaternion(turn).add(lift);
      const ahead = new T.Vector3(1, 0.12, 0).normalize().applyQuaternion(turn);
      row.tip.copy(end).addScaledVector(ahead, 0.5 * wide);
      this.heads.set(row.head, between(end.toArray(), row.tip.toArray(), 0.22 * wide));
    }
  }

  dbd.arrows = { Arrows };
}(window.dbd = window.dbd || {}));
