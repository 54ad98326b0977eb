// Springs: coils between their ends, coloured by how they pull or push; those of joints as thin rods.
//
// (ends, tension) => matrix, colour of each. Orange pulls, violet pushes, grey is at rest: told apart by people who
// see few colours (ColorBrewer's PuOr).
(function (dbd) {
  'use strict';

  const T = window.THREE;
  const { between } = dbd.batch;
  const TURNS = 8;
  // Coils are longer than wide by about so much: their wire is flat along them, so that it looks round when stretched.
  const FLAT = 0.1;

  // A coil of radius and length 1 about y, straight for the first and the last tenth.
  function coil(many) {
    const rounds = many ? 8 : 14;
    const sides = many ? 4 : 7;
    const steps = TURNS * rounds;
    const wire = 0.16;
    const points = [[0, -0.5, 0], [0, -0.43, 0]];
    for (let i = 0; i <= steps; i += 1) {
      const angle = (2 * Math.PI * TURNS * i) / steps;
      points.push([Math.cos(angle), -0.4 + (0.8 * i) / steps, Math.sin(angle)]);
    }
    points.push([0, 0.43, 0], [0, 0.5, 0]);
    const [positions, index] = [[], []];
    points.forEach((point, i) => {
      const ahead = new T.Vector3().fromArray(points[Math.min(i + 1, points.length - 1)])
        .sub(new T.Vector3().fromArray(points[Math.max(i - 1, 0)])).normalize();
      const out = new T.Vector3(point[0], 0, point[2]);
      if (out.lengthSq() === 0) out.set(1, 0, 0);
      const across = new T.Vector3().crossVectors(ahead, out).normalize();
      out.crossVectors(across, ahead).normalize();
      for (let side = 0; side < sides; side += 1) {
        const angle = (2 * Math.PI * side) / sides;
        const [c, s] = [wire * Math.cos(angle), wire * Math.sin(angle)];
        positions.push(point[0] + c * out.x + s * across.x, point[1] + FLAT * (c * out.y + s * across.y),
          point[2] + c * out.z + s * across.z);
        if (i > 0) {
          const [a, b] = [(i - 1) * sides + side, (i - 1) * sides + ((side + 1) % sides)];
          index.push(a, b, a + sides, b, b + sides, a + sides);
        }
      }
    });
    const geometry = new T.BufferGeometry();
    geometry.setAttribute('position', new T.Float32BufferAttribute(positions, 3));
    geometry.setIndex(index);
    geometry.computeVertexNormals();
    return geometry;
  }

  // The colour of a tension on a scale to the largest.
  function tint(tension, largest, out) {
    const share = largest > 0 ? Math.min(Math.abs(tension) / largest, 1) : 0;
    return out.copy(dbd.palette('--rest'))
      .lerp(dbd.palette(tension < 0 ? '--push' : '--pull'), Number.isFinite(share) ? Math.sqrt(share) : 0);
  }

  class Springs {
    constructor(machine) {
      this.machine = machine;
      const { mechanism, film } = machine;
      const springs = mechanism.springs;
      const many = springs.length > 200;
      this.largest = film ? film.largest('springs') : 0;
      this.tensions = new Float32Array(springs.length);
      this.coils = machine.batch('coil', many);
      this.rods = machine.batch('cylinder', many);
      this.balls = machine.batch('sphere', many);
      this.rows = springs.map((spring, row) => this.spring(spring, row));
      this.ofJoints = film && film.counts.jointSprings ? this.inside(mechanism, film) : null;
      this.colour = new T.Color();
    }

    spring(spring, row) {
      const { radius } = this.machine;
      const label = { what: 'spring', row, name: spring.name || 'spring', driven: spring.driven };
      const ends = spring.ends.map((end) => ({ owner: this.machine.owner(end), point: end.point }));
      const length = this.machine.distance(spring.ends[0], spring.ends[1]);
      if (!(length > 1e-6 * this.machine.size)) {
        return { ends, parts: [[this.balls, this.balls.add(null, null, '--rest', label), 'ball', 1.3 * radius]] };
      }
      if (spring.driven) {
        return { ends, parts: [
          [this.rods, this.rods.add(null, null, '--rest', label), 'cylinder', 1.2 * radius],
          [this.rods, this.rods.add(null, null, '--pin', null), 'piston', 0.6 * radius]] };
      }
      const wide = Math.min(1.9 * radius, 0.14 * length);
      return { ends, parts: [[this.coils, this.coils.add(null, null, '--rest', label), 'coil', wide]] };
    }

    // The springs that joints are made of.
    inside(mechanism, film) {
      const rods = this.machine.batch('cylinder', true);
      const balls = this.machine.batch('sphere', true);
      const marks = mechanism.joint_springs.map((spring) => {
        const label = { what: 'joint spring', row: spring.joint, name: mechanism.joints[spring.joint]?.name };
        return {
          ends: spring.ends.map((end) => ({ owner: this.machine.owner(end), point: end.point })),
          parts: [[rods, rods.add(null, null, '--rest', label), 'rod', 0.22 * this.machine.radius],
            [balls, balls.add(null, null, '--rest', null), 'end', 0.4 * this.machine.radius]],
        };
      });
      return { rods, balls, marks, values: new Float32Array(marks.length), shown: false,
        largest: film.largest('jointSprings') };
    }

    show(shown) {
      if (!this.ofJoints) return;
      this.ofJoints.shown = shown;
      this.ofJoints.rods.mesh.visible = shown;
      this.ofJoints.balls.mesh.visible = shown;
    }

    update(time) {
      const { film } = this.machine;
      if (film) film.values('springs', time, this.tensions);
      this.place(this.rows, this.tensions, this.largest);
      if (this.ofJoints && this.ofJoints.shown) {
        film.values('jointSprings', time, this.ofJoints.values);
        this.place(this.ofJoints.marks, this.ofJoints.values, this.ofJoints.largest);
      }
    }

    place(rows, tensions, largest) {
      const { owners } = this.machine;
      const matrix = new T.Matrix4();
      const ghost = this.machine.look.ghost;
      const world = ({ owner, point }) => new T.Vector3().fromArray(point).applyMatrix4(owners[owner]).toArray();
      rows.forEach(({ ends, parts }, row) => {
        const [a, b] = ends.map(world);
        tint(tensions[row], largest, this.colour);
        for (const [batch, index, kind, radius] of parts) {
          if (kind === 'ball' || kind === 'end') matrix.copy(dbd.batch.at(b, radius));
          else if (kind === 'cylinder') between(a, a.map((value, i) => value + 0.55 * (b[i] - value)), radius, matrix);
          else between(a, b, radius, matrix);
          batch.set(index, matrix);
          if (kind !== 'piston' && !ghost) batch.paint(index, this.colour);
        }
      });
    }
  }

  dbd.springs = { Springs, coil };
}(window.dbd = window.dbd || {}));
