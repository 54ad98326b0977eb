// Bodies: bars, plates, blocks, and the shapes that a scene gives them.
//
// outlines, solids => batches and hulls in the axes of the bodies.
(function (dbd) {
  'use strict';

  const T = window.THREE;
  const { between, at } = dbd.batch;
  const COLOURS = 5;
  // Plates beyond so many are drawn as stars of rods.
  const MOST_HULLS = 400;
  // Bodies beyond so many have coarse shapes without rounded ends.
  const MANY = 800;

  // The name and contents of an outline: {"Bar": {...}} or "Spider".
  function outline(body) {
    if (typeof body.outline === 'string') return [body.outline.toLowerCase(), {}];
    const [name, content] = Object.entries(body.outline)[0];
    return [name.toLowerCase(), content];
  }

  // The corners of a body in its own axes.
  function corners(body) {
    if (body.shapes && body.shapes.length) return body.shapes.flatMap(cornersOfSolid);
    const [kind, content] = outline(body);
    if (kind === 'bar') return content.ends;
    if (kind === 'plate') return content.points;
    if (kind === 'block') return box([0, 0, 0], content.half);
    return [[0, 0, 0]];
  }

  function box(centre, half) {
    return Array.from({ length: 8 }, (_, i) =>
      centre.map((value, axis) => value + ((i >> axis) & 1 ? half[axis] : -half[axis])));
  }

  function cornersOfSolid(solid) {
    if (solid.kind === 'box') {
      const q = new T.Quaternion(solid.turn[1], solid.turn[2], solid.turn[3], solid.turn[0]);
      return box([0, 0, 0], solid.half).map((corner) =>
        new T.Vector3().fromArray(corner).applyQuaternion(q).add(new T.Vector3().fromArray(solid.at)).toArray());
    }
    const r = solid.radius;
    return (solid.ends || [solid.at]).flatMap((end) => box(end, [r, r, r]));
  }

  // A colour for each body that differs from those it is joined to.
  function colours(mechanism) {
    const joined = mechanism.bodies.map(() => []);
    for (const { places: [a, b] } of mechanism.joints) {
      if (a.body !== null && b.body !== null) {
        joined[a.body].push(b.body);
        joined[b.body].push(a.body);
      }
    }
    const chosen = [];
    mechanism.bodies.forEach((_, row) => {
      const taken = new Set(joined[row].map((other) => chosen[other]));
      let colour = row % COLOURS;
      for (let i = 0; i < COLOURS && taken.has(colour); i += 1) colour = (colour + 1) % COLOURS;
      chosen.push(colour);
    });
    return chosen.map((colour) => '--body-' + colour);
  }

  // Points a little off every corner, so that flat plates have a thickness.
  function inflated(points, radius) {
    const h = radius * 0.6;
    return points.flatMap((point) => box(point, [h, h, h]).concat([
      [radius, 0, 0], [-radius, 0, 0], [0, radius, 0], [0, -radius, 0], [0, 0, radius], [0, 0, -radius],
    ].map((offset) => offset.map((value, i) => value + point[i]))));
  }

  function hull(points, radius) {
    const vectors = inflated(points, radius).map((point) => new T.Vector3().fromArray(point));
    const found = new T.ConvexHull().setFromPoints(vectors);
    const positions = [];
    for (const face of found.faces) {
      let edge = face.edge;
      do {
        positions.push(...edge.head().point.toArray());
        edge = edge.next;
      } while (edge !== face.edge);
    }
    const geometry = new T.BufferGeometry();
    geometry.setAttribute('position', new T.Float32BufferAttribute(positions, 3));
    geometry.computeVertexNormals();
    return geometry;
  }

  class Bodies {
    constructor(machine) {
      this.machine = machine;
      const { mechanism, look } = machine;
      const many = mechanism.bodies.length > MANY;
      const batch = (kind) => machine.batch(kind, many);
      this.parts = { box: batch('box'), cylinder: batch('cylinder'), sphere: batch('sphere') };
      this.many = many;
      this.hulls = [];
      this.colours = colours(mechanism);
      mechanism.bodies.forEach((body, row) => {
        const label = { what: 'body', row, name: body.name };
        const paint = this.colours[row];
        if (body.shapes && body.shapes.length) {
          body.shapes.forEach((solid) => this.solid(row, solid, solid.colour || paint, label));
        } else {
          this.outline(row, body, paint, label, look);
        }
      });
      (mechanism.ground || []).forEach((solid) =>
        this.solid(machine.ground, solid, solid.colour || '--ground-solid', { what: 'ground', name: 'ground' }));
    }

    outline(row, body, paint, label, look) {
      const r = this.machine.radius;
      const [kind, content] = outline(body);
      if (kind === 'bar') this.link(row, content.ends, r, paint, label);
      if (kind === 'block') this.parts.box.add(row, at([0, 0, 0], content.half.map((h) => 2 * h)), paint, label);
      if (kind !== 'plate') return;
      if (this.hulls.length >= MOST_HULLS) {
        content.points.forEach((point) => this.link(row, [[0, 0, 0], point], 0.7 * r, paint, label));
        return;
      }
      const mesh = new T.Mesh(hull(content.points, 0.8 * r), dbd.batch.material({ ...look, flat: true, glass: this.bulky(content.points) }));
      mesh.matrixAutoUpdate = false;
      mesh.frustumCulled = false;
      mesh.userData.label = label;
      this.hulls.push({ mesh, row, paint });
      this.machine.group.add(mesh);
    }

    // Whether a hull is so large and thick that it would hide most of the rest: a car's shell.
    bulky(points) {
      const sides = [0, 1, 2].map((i) => {
        const along = points.map((point) => point[i]);
        return Math.max(...along) - Math.min(...along);
      });
      return Math.max(...sides) > 0.75 * this.machine.size && Math.min(...sides) > 0.15 * Math.max(...sides)
        && this.machine.mechanism.bodies.length > 2;
    }

    solid(owner, solid, paint, label) {
      const { box: boxes, cylinder, sphere } = this.parts;
      if (solid.kind === 'box') {
        boxes.add(owner, at(solid.at, solid.half.map((h) => 2 * h), solid.turn), paint, label);
      } else if (solid.kind === 'sphere') {
        sphere.add(owner, at(solid.at, solid.radius), paint, label);
      } else if (solid.kind === 'link') {
        this.link(owner, solid.ends, solid.radius, paint, label);
      } else {
        cylinder.add(owner, between(solid.ends[0], solid.ends[1], solid.radius), paint, label);
      }
    }

    link(owner, ends, radius, paint, label) {
      this.parts.cylinder.add(owner, between(ends[0], ends[1], radius), paint, label);
      if (this.many) return;
      for (const end of ends) this.parts.sphere.add(owner, at(end, radius), paint, label);
    }

    update(owners) {
      for (const { mesh, row } of this.hulls) mesh.matrix.copy(owners[row]);
    }

    recolour() {
      for (const { mesh, paint } of this.hulls) {
        mesh.material.color.copy(dbd.palette(this.machine.look.ghost ? '--ghost' : paint));
      }
    }
  }

  dbd.bodies = { Bodies, corners, outline };
}(window.dbd = window.dbd || {}));
