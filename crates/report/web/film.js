// How a mechanism moved: poses and loads at any time.
//
// (packed frames, time) => poses between two frames, values between two samples. Positions go along straight lines,
// orientations along arcs.
(function (dbd) {
  'use strict';

  const { f32s, f64s, i16s } = dbd.numbers;
  const WORDS = 7;

  // The sample at or before a time, and the share of the way to the next.
  function between(times, time) {
    let low = 0;
    let high = times.length - 1;
    if (high <= 0 || time <= times[0]) return [0, 0];
    if (time >= times[high]) return [high, 0];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time) low = middle; else high = middle;
    }
    return [low, (time - times[low]) / (times[high] - times[low])];
  }

  // Words of a row of a table with a row per frame, between two of them.
  function blend(table, width, [row, share], out) {
    const from = row * width;
    for (let i = 0; i < width; i += 1) {
      const a = table[from + i];
      out[i] = share > 0 ? a + share * (table[from + width + i] - a) : a;
    }
    return out;
  }

  class Film {
    constructor(data, mechanism) {
      this.times = f64s(data.times);
      this.frames = this.times.length;
      this.bodies = data.bodies;
      this.low = data.low;
      this.size = data.high.map((high, i) => high - data.low[i]);
      this.raw = i16s(data.poses);
      this.springs = f32s(data.springs);
      this.joints = f32s(data.joints);
      this.jointSprings = f32s(data.jointSprings);
      this.forces = f32s(data.forces);
      this.traces = data.traces || [];
      const count = (list) => (list || []).length;
      this.counts = {
        springs: count(mechanism.springs), joints: 2 * count(mechanism.joints), forces: count(mechanism.forces),
        jointSprings: this.jointSprings.length ? count(mechanism.joint_springs) : 0,
      };
    }

    // Position and orientation of all bodies at a time: x, y, z, w, x, y, z of each.
    poses(time, out) {
      const at = between(this.times, time);
      for (let body = 0; body < this.bodies; body += 1) this.pose(at, body, out, body * WORDS);
      return out;
    }

    // Of one body at a frame, or between two.
    pose([frame, share], body, out, offset) {
      const { raw, low, size } = this;
      const a = (frame * this.bodies + body) * WORDS;
      const b = share > 0 ? a + this.bodies * WORDS : a;
      for (let i = 0; i < 3; i += 1) {
        const value = raw[a + i] + share * (raw[b + i] - raw[a + i]);
        out[offset + i] = low[i] + ((value + 32767) / 65534) * size[i];
      }
      let dot = 0;
      for (let i = 3; i < WORDS; i += 1) dot += raw[a + i] * raw[b + i];
      const sign = dot < 0 ? -1 : 1;
      const cosine = Math.min(Math.abs(dot) / (32767 * 32767), 1);
      const angle = Math.acos(cosine);
      const arc = angle > 1e-3;
      const first = arc ? Math.sin((1 - share) * angle) : 1 - share;
      const second = sign * (arc ? Math.sin(share * angle) : share);
      let norm = 0;
      for (let i = 3; i < WORDS; i += 1) {
        const value = first * raw[a + i] + second * raw[b + i];
        out[offset + i] = value;
        norm += value * value;
      }
      norm = Math.sqrt(norm) || 1;
      for (let i = 3; i < WORDS; i += 1) out[offset + i] /= norm;
      return out;
    }

    // What a table ("springs", "joints", "forces", "jointSprings") holds at a time.
    values(table, time, out) {
      return blend(this[table], this.counts[table], between(this.times, time), out);
    }

    // The largest absolute value of some words of a table.
    largest(table, of) {
      const width = this.counts[table];
      let most = 0;
      this[table].forEach((value, i) => {
        const size = Math.abs(value);
        if (size > most && Number.isFinite(size) && (!of || of(i % width))) most = size;
      });
      return most;
    }

    // At most so many frames, spread over the run, the first and the last among them.
    spread(most) {
      const count = Math.min(this.frames, most);
      return Array.from({ length: count }, (_, i) =>
        Math.round((i * (this.frames - 1)) / Math.max(count - 1, 1)));
    }

    // The frame before or after a time.
    step(time, by) {
      const [frame, share] = between(this.times, time + (by > 0 ? 1e-12 : 0));
      // Backwards from between two frames is to the first of them.
      const next = by < 0 && share > 1e-9 ? frame : frame + by;
      return this.times[Math.min(Math.max(next, 0), this.frames - 1)];
    }
  }

  // The words of a pose applied to a point of a body's axes.
  function placed(poses, row, [x, y, z], out) {
    const o = row * WORDS;
    const [w, a, b, c] = [poses[o + 3], poses[o + 4], poses[o + 5], poses[o + 6]];
    const tx = 2 * (b * z - c * y);
    const ty = 2 * (c * x - a * z);
    const tz = 2 * (a * y - b * x);
    out[0] = poses[o] + x + w * tx + b * tz - c * ty;
    out[1] = poses[o + 1] + y + w * ty + c * tx - a * tz;
    out[2] = poses[o + 2] + z + w * tz + a * ty - b * tx;
    return out;
  }

  // Poses of the mechanism at t = 0, of a page without a film.
  function initial(mechanism) {
    const poses = new Float64Array(mechanism.bodies.length * WORDS);
    mechanism.bodies.forEach((body, i) => {
      poses.set([...body.position, ...body.orientation], i * WORDS);
    });
    return poses;
  }

  dbd.film = { Film, between, placed, initial, WORDS };
}(window.dbd = window.dbd || {}));
