// Joints by their type, guides, torsion springs, interactions, and where the ground holds them.
//
// marks of the mechanism => shapes in the axes of their bodies.
(function (dbd) {
  'use strict';

  const T = window.THREE;
  const { between, at, turned } = dbd.batch;
  const { placed } = dbd.film;
  const Y = [0, 1, 0];

  const plus = (point, direction, length) => point.map((value, i) => value + length * direction[i]);
  const minus = (a, b) => a.map((value, i) => value - b[i]);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

  class Joints {
    constructor(machine) {
      this.machine = machine;
      this.size = 1.55 * machine.radius;
      const many = machine.mechanism.joints.length > 500;
      const batch = (kind) => machine.batch(kind, many);
      this.parts = { cylinder: batch('cylinder'), sphere: batch('sphere'), box: batch('box'),
        foot: batch('foot'), ring: batch('ring') };
      this.feet = [];
      machine.mechanism.joints.forEach((joint, row) =>
        this.joint(joint, { what: 'joint', row, name: joint.name, kind: joint.kind }));
      machine.mechanism.guides.forEach((guide, row) => this.guide(guide, row));
      machine.mechanism.torsions.forEach((torsion, row) => this.torsion(torsion, row));
      machine.mechanism.interactions.forEach((one, row) => this.interaction(one, row));
      for (const spring of machine.mechanism.springs) {
        spring.ends.filter((end) => end.body === null).forEach((end) => this.foot(end));
      }
    }

    // A direction of one owner's axes in those of another, at t = 0.
    into(owner, along) {
      const { start } = this.machine;
      if (along.body === owner || owner === undefined) return along.vector;
      const turn = (row, sign, [x, y, z]) => {
        if (row === null) return [x, y, z];
        const o = row * dbd.film.WORDS + 3;
        const q = new T.Quaternion(sign * start[o + 1], sign * start[o + 2], sign * start[o + 3], start[o]);
        return new T.Vector3(x, y, z).applyQuaternion(q).toArray();
      };
      return turn(owner, -1, turn(along.body, 1, along.vector));
    }

    joint(joint, label) {
      const r = this.size;
      const { cylinder, sphere, box } = this.parts;
      const [place, second] = joint.places;
      const owner = this.machine.owner(place);
      const axis = joint.axes[0] && this.into(place.body, joint.axes[0]);
      const bar = (half, radius, colour, about, on, centre) => cylinder.add(
        on === undefined ? owner : on,
        between(plus(centre || place.point, about, -half), plus(centre || place.point, about, half), radius),
        colour, label);
      if (joint.kind === 'revolute' && axis) {
        bar(1.3 * r, 1.05 * r, '--collar', axis);
        bar(1.65 * r, 0.5 * r, '--pin', axis);
      } else if (joint.kind === 'universal') {
        joint.axes.forEach((along, i) => {
          const on = i === 0 ? place : second;
          bar(1.6 * r, 0.42 * r, '--pin', this.into(on.body, along), this.machine.owner(on), on.point);
        });
        sphere.add(owner, at(place.point, 0.7 * r), '--collar', label);
      } else if ((joint.kind === 'cylindrical' || joint.kind === 'translational') && axis) {
        this.slider(joint, axis, owner, label);
      } else if (joint.kind === 'fixed') {
        box.add(owner, at(place.point, 1.9 * r), '--pin', label);
      } else {
        sphere.add(owner, at(place.point, (joint.kind === 'spherical' ? 1.15 : 0.9) * r), '--pin', label);
      }
      const ground = joint.places.find(({ body }) => body === null);
      const slides = joint.kind === 'cylindrical' || joint.kind === 'translational';
      if (ground && !slides) this.foot(ground);
    }

    // A rail as long as the motion, and a sleeve that runs along it.
    slider(joint, axis, owner, label) {
      const r = this.size;
      const [place, second] = joint.places;
      const [low, high] = this.reach(place, axis, second);
      const ends = [low - 2.4 * r, high + 2.4 * r].map((far) => plus(place.point, axis, far));
      this.parts.cylinder.add(owner, between(ends[0], ends[1], 0.4 * r), '--pin', label);
      const on = this.machine.owner(second);
      const along = this.into(second.body, joint.axes[0]);
      if (joint.kind === 'cylindrical') {
        const sleeve = [-1.5 * r, 1.5 * r].map((far) => plus(second.point, along, far));
        this.parts.cylinder.add(on, between(sleeve[0], sleeve[1], 1.05 * r), '--collar', label);
      } else {
        this.parts.box.add(on, at(second.point, [2 * r, 3 * r, 2 * r], turned(Y, along)), '--collar', label);
      }
      if (place.body === null) ends.forEach((point) => this.foot({ body: null, point }));
      else if (second.body === null) this.foot(second);
    }

    // How far a point goes along an axis that another place has, over the run.
    reach(place, axis, point) {
      const { film, start } = this.machine;
      let [low, high] = [0, 0];
      const poses = Float64Array.from(start);
      const out = [0, 0, 0];
      const world = (of) => (of.body === null ? of.point : [...placed(poses, of.body, of.point, out)]);
      const look = () => {
        const tip = plus(place.point, axis, 1);
        const [from, to, there] = [place, { body: place.body, point: tip }, point].map(world);
        const far = dot(minus(there, from), minus(to, from));
        low = Math.min(low, far);
        high = Math.max(high, far);
      };
      look();
      const rows = [place.body, point.body].filter((row) => row !== null);
      for (const frame of film ? film.spread(120) : []) {
        for (const row of rows) film.pose([frame, 0], row, poses, row * dbd.film.WORDS);
        look();
      }
      // What flew off is not drawn to its end.
      const most = 3 * this.machine.size;
      return [Math.max(low, -most), Math.min(high, most)];
    }

    guide(guide, row) {
      const r = this.size;
      const label = { what: 'guide', row, name: guide.name || 'guide' };
      const owner = this.machine.owner(guide.line);
      const axis = this.into(guide.line.body, guide.direction);
      const [low, high] = this.reach(guide.line, axis, guide.point);
      const ends = [low - 3 * r, high + 3 * r].map((far) => plus(guide.line.point, axis, far));
      this.parts.cylinder.add(owner, between(ends[0], ends[1], 0.3 * r), '--pin', label);
      this.parts.sphere.add(this.machine.owner(guide.point), at(guide.point.point, 0.8 * r), '--collar', label);
    }

    torsion(torsion, row) {
      const label = { what: 'torsion', row, name: torsion.name || 'torsion spring' };
      const axis = this.into(torsion.at.body, torsion.axis);
      this.parts.ring.add(this.machine.owner(torsion.at),
        at(torsion.at.point, 2.3 * this.size, turned([0, 0, 1], axis)), '--rest', label);
    }

    // Its points, a plate for a plane, a ring about an axis.
    interaction(one, row) {
      const label = { what: 'interaction', row, name: one.name || one.law };
      const r = this.size;
      for (const end of one.ends || []) {
        this.parts.sphere.add(this.machine.owner(end), at(end.point, 0.5 * r), '--rest', label);
      }
      if (one.normal) {
        const [place] = one.ends || [one.at];
        const turn = turned(Y, this.into(place.body, one.normal));
        this.parts.box.add(this.machine.owner(place), at(place.point, [3 * r, 0.2 * r, 3 * r], turn), '--rest', label);
      }
      if (one.axis) {
        this.parts.ring.add(this.machine.owner(one.at),
          at(one.at.point, 2.8 * r, turned([0, 0, 1], this.into(one.at.body, one.axis))), '--rest', label);
      }
    }

    // A foot with hatches below a point of the ground, once where many are.
    foot(place) {
      const near = 2 * this.size;
      if (this.feet.some((point) => Math.hypot(...minus(point, place.point)) < near)) return;
      if (this.feet.length > 200) return;
      this.feet.push(place.point);
      const r = this.size;
      const { up, side } = this.machine;
      const owner = this.machine.owner(place);
      const turn = turned(Y, up);
      const label = { what: 'ground', name: 'ground' };
      this.parts.foot.add(owner, at(plus(place.point, up, -1.5 * r), [1.5 * r, 2 * r, 1.5 * r], turn),
        '--ground-solid', label);
      const base = plus(place.point, up, -2.5 * r);
      const wide = plus([0, 0, 0], side, 2.4 * r);
      const rod = (a, b, thick) => this.parts.cylinder.add(owner, between(a, b, thick), '--hatch', label);
      rod(minus(base, wide), plus(base, wide, 1), 0.2 * r);
      for (let i = -2; i <= 2; i += 1) {
        const from = plus(base, side, i * 1.05 * r + 0.5 * r);
        rod(from, plus(plus(from, side, -0.9 * r), up, -1.1 * r), 0.12 * r);
      }
    }
  }

  dbd.joints = { Joints };
}(window.dbd = window.dbd || {}));
