// A mechanism in three dimensions: its bodies, joints, springs, arrows and traces at any time.
//
// (mechanism, film, time) => a group of meshes in the world's axes [m].
(function (dbd) {
  'use strict';

  const T = window.THREE;
  const { Film, initial, placed, WORDS } = dbd.film;
  // Corners looked at for the size of the whole, over all frames.
  const MOST_CORNERS = 60000;
  // What flies further than so many sizes is followed by nobody.
  const FAR = 30;

  function median(values) {
    const sorted = values.filter((value) => value > 0).sort((a, b) => a - b);
    return sorted.length ? sorted[Math.floor(sorted.length / 2)] : 0;
  }

  function upward(gravity, flat) {
    if (gravity && Math.hypot(...gravity) > 0) {
      const axis = gravity.map(Math.abs).indexOf(Math.max(...gravity.map(Math.abs)));
      return [0, 1, 2].map((i) => (i === axis ? -Math.sign(gravity[axis]) : 0));
    }
    return flat && flat[2] === 1 ? [0, 1, 0] : [0, 0, 1];
  }

  class Machine {
    constructor(run, look) {
      this.mechanism = run.mechanism;
      // A live view has no film that is over: what it shows instead answers the same questions.
      this.film = run.live || (run.film ? new Film(run.film, run.mechanism) : null);
      this.look = look || {};
      this.start = initial(this.mechanism);
      this.poses = Float64Array.from(this.start);
      this.group = new T.Group();
      this.batches = [];
      const bodies = this.mechanism.bodies.length;
      this.ground = bodies;
      // Points of the ground that inputs move.
      this.shifts = this.mechanism.forces
        .map((force, row) => ({ force, row }))
        .filter(({ force }) => force.kind === 'shift');
      this.owners = Array.from({ length: bodies + 1 + this.shifts.length }, () => new T.Matrix4());
      this.measure();
      this.bodies = new dbd.bodies.Bodies(this);
      this.joints = new dbd.joints.Joints(this);
      this.springs = new dbd.springs.Springs(this);
      this.arrows = new dbd.arrows.Arrows(this);
      this.traces = new dbd.traces.Traces(this);
      for (const batch of this.batches) this.group.add(batch.build());
      this.bodies.recolour();
      this.springs.show(false);
      this.arrows.show(this.arrows.shown);
    }

    batch(kind, many, look) {
      const made = new dbd.batch.Batch(kind, { ...this.look, ...look }, many);
      this.batches.push(made);
      return made;
    }

    // Size, thickness of bars, the plane of the motion, what is up.
    measure() {
      const { mechanism } = this;
      const first = this.corners(1);
      this.size = Math.max(...span(first)) || 1;
      const lengths = mechanism.bodies
        .map((body) => dbd.bodies.outline(body))
        .filter(([kind]) => kind === 'bar')
        .map(([, { ends: [a, b] }]) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
      const usual = median(lengths);
      const thick = Math.min(0.016 * this.size, usual ? 0.11 * usual : Infinity);
      this.radius = Math.max(thick, 0.0012 * this.size);
      const middle = centre(first);
      const near = ([x, y, z]) => Math.hypot(x - middle[0], y - middle[1], z - middle[2]) < FAR * this.size;
      this.reached = this.corners(200).filter(near);
      const sides = span(this.reached);
      // Flat where it neither has nor uses a third dimension to speak of.
      const thin = sides.indexOf(Math.min(...sides));
      this.flat = sides[thin] < 0.12 * Math.max(...sides) ? [0, 1, 2].map((i) => (i === thin ? 1 : 0)) : null;
      this.up = upward(mechanism.gravity, this.flat);
      const across = this.flat && !this.flat.some((value, i) => value && this.up[i]) ? this.flat : null;
      const out = across || (Math.abs(this.up[1]) === 1 ? [0, 0, 1] : [0, -1, 0]);
      this.side = cross(this.up, out);
      this.out = out;
      // What is flat is looked at nearly across its plane, unless it lies level.
      this.firstView = across ? 'start' : 'iso';
    }

    // Corners of all bodies and ends of springs, in the world, at some frames.
    corners(frames) {
      const { mechanism, film } = this;
      const local = mechanism.bodies.map((body) => dbd.bodies.corners(body));
      const count = local.reduce((sum, corners) => sum + corners.length, 0) || 1;
      const poses = Float64Array.from(this.start);
      const found = [];
      const take = () => local.forEach((corners, row) =>
        corners.forEach((corner) => found.push(placed(poses, row, corner, [0, 0, 0]))));
      take();
      const places = [...mechanism.joints.flatMap((joint) => joint.places),
        ...mechanism.springs.flatMap((spring) => spring.ends), ...mechanism.forces.map((force) => force.at)];
      places.filter((place) => place.body === null).forEach((place) => found.push(place.point));
      (mechanism.ground || []).forEach((solid) =>
        dbd.bodies.corners({ shapes: [solid] }).forEach((corner) => found.push(corner)));
      if (film && frames > 1) {
        for (const frame of film.spread(Math.max(2, Math.min(frames, Math.floor(MOST_CORNERS / count))))) {
          for (let row = 0; row < film.bodies; row += 1) film.pose([frame, 0], row, poses, row * WORDS);
          take();
        }
      }
      return found.filter((point) => point.every(Number.isFinite));
    }

    // The row of a place's owner among the matrices.
    owner(place) {
      if (place.body !== null) return place.body;
      const near = 1e-6 * this.size;
      const at = this.shifts.findIndex(({ force }) =>
        Math.hypot(...force.at.point.map((value, i) => value - place.point[i])) <= near);
      return at < 0 ? this.ground : this.ground + 1 + at;
    }

    // [m] between two places at t = 0.
    distance(a, b) {
      const [from, to] = [a, b].map(({ body, point }) =>
        (body === null ? point : placed(this.start, body, point, [0, 0, 0])));
      return Math.hypot(from[0] - to[0], from[1] - to[1], from[2] - to[2]);
    }

    update(time) {
      if (this.film) this.film.poses(time, this.poses);
      this.pose(this.poses, time);
    }

    // Shows given poses, with the loads of a time.
    pose(poses, time) {
      const [position, turn, one] = [new T.Vector3(), new T.Quaternion(), new T.Vector3(1, 1, 1)];
      for (let row = 0; row < this.mechanism.bodies.length; row += 1) {
        const o = row * WORDS;
        position.set(poses[o], poses[o + 1], poses[o + 2]);
        turn.set(poses[o + 4], poses[o + 5], poses[o + 6], poses[o + 3]);
        this.owners[row].compose(position, turn, one);
      }
      this.arrows.update(time);
      this.shifts.forEach(({ force, row }, i) => {
        const value = this.arrows.values[row] || 0;
        const [x, y, z] = force.direction.vector.map((share) => share * value);
        this.owners[this.ground + 1 + i].makeTranslation(x, y, z);
      });
      for (const batch of this.batches) {
        if (batch.items.length && batch.items[0].owner !== null) batch.update(this.owners);
      }
      this.bodies.update(this.owners);
      this.springs.update(time);
      this.traces.update();
    }

    // Frees what the graphics card holds of it. Unit shapes are shared and stay.
    dispose() {
      this.group.traverse((object) => {
        if (!object.isMesh) return;
        object.material.dispose();
        if (object.isInstancedMesh) object.dispose();
        else object.geometry.dispose();
      });
    }

    recolour() {
      for (const batch of this.batches) batch.recolour();
      this.bodies.recolour();
      this.traces.recolour();
    }
  }

  function span(points) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const point of points) {
      for (let i = 0; i < 3; i += 1) {
        low[i] = Math.min(low[i], point[i]);
        high[i] = Math.max(high[i], point[i]);
      }
    }
    return points.length ? high.map((value, i) => value - low[i]) : [0, 0, 0];
  }

  function centre(points) {
    const sum = [0, 0, 0];
    for (const point of points) for (let i = 0; i < 3; i += 1) sum[i] += point[i] / points.length;
    return sum;
  }

  function cross(a, b) {
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  }

  dbd.machine = { Machine };
}(window.dbd = window.dbd || {}));
