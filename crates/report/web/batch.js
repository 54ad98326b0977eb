// Many like shapes drawn at once, each fixed in the axes of a body or of the ground.
//
// (owner, place in its axes, colour, label)* => one instanced mesh. A mechanism of ten thousand bodies so takes a
// handful of draw calls.
(function (dbd) {
  'use strict';

  const T = window.THREE;
  const UP = () => new T.Vector3(0, 1, 0);
  const made = {};

  // The unit shapes: cylinders stand along y, radius and height 1; boxes have sides of 1.
  function shape(kind, many) {
    const key = kind + (many ? '-coarse' : '');
    if (!made[key]) {
      made[key] = {
        box: () => new T.BoxGeometry(1, 1, 1),
        cylinder: () => new T.CylinderGeometry(1, 1, 1, many ? 8 : 48),
        sphere: () => new T.SphereGeometry(1, many ? 8 : 24, many ? 6 : 16),
        cone: () => new T.CylinderGeometry(0, 1, 1, 20),
        foot: () => new T.CylinderGeometry(0.35, 1, 1, 4),
        ring: () => new T.TorusGeometry(1, 0.16, 8, 28, 1.65 * Math.PI),
        arc: () => new T.TorusGeometry(1, 0.075, 8, 36, 1.5 * Math.PI),
        coil: () => dbd.springs.coil(many),
      }[kind]();
    }
    return made[key];
  }

  // The matrix that lays a unit cylinder between two points.
  function between(from, to, radius, out) {
    const [a, b] = [from, to].map((point) => new T.Vector3().fromArray(point));
    const axis = b.clone().sub(a);
    const length = axis.length();
    const turn = new T.Quaternion();
    if (length > 0) turn.setFromUnitVectors(UP(), axis.divideScalar(length));
    return (out || new T.Matrix4())
      .compose(a.add(b).multiplyScalar(0.5), turn, new T.Vector3(radius, length || 1e-12, radius));
  }

  // The matrix of a sphere, box or ring at a point: sizes along its axes, turned by a quaternion (w first).
  function at(point, size, turn) {
    const scale = Array.isArray(size) ? size : [size, size, size];
    const [w, x, y, z] = turn || [1, 0, 0, 0];
    return new T.Matrix4().compose(
      new T.Vector3().fromArray(point), new T.Quaternion(x, y, z, w), new T.Vector3().fromArray(scale));
  }

  // The quaternion (w first) that turns one of the shapes' axes into a direction.
  function turned(from, to) {
    const q = new T.Quaternion()
      .setFromUnitVectors(new T.Vector3().fromArray(from), new T.Vector3().fromArray(to).normalize());
    return [q.w, q.x, q.y, q.z];
  }

  function material(look) {
    const ghost = look.ghost;
    return new T.MeshPhongMaterial({
      color: 0xffffff, specular: 0x222222, shininess: 24,
      transparent: Boolean(ghost || look.above || look.glass), opacity: ghost || look.glass ? 0.28 : 1,
      depthWrite: !ghost && !look.glass,
      flatShading: Boolean(look.flat), depthTest: !look.above,
    });
  }

  class Batch {
    // look: {ghost, glass: pale, above: seen through what stands before it}; `many` takes coarser shapes.
    constructor(kind, look, many) {
      this.kind = kind;
      this.look = look;
      this.many = many;
      this.items = [];
    }

    // A shape in the axes of its owner; `owner` null where `set` places it in the world.
    add(owner, matrix, colour, label) {
      this.items.push({ owner, matrix, colour, label });
      return this.items.length - 1;
    }

    build() {
      const count = this.items.length;
      this.mesh = new T.InstancedMesh(shape(this.kind, this.many), material(this.look), Math.max(count, 1));
      this.mesh.count = count;
      this.mesh.frustumCulled = false;
      this.mesh.userData.batch = this;
      this.mesh.renderOrder = this.look.above ? 3 : Number(Boolean(this.look.ghost));
      this.items.forEach((item, i) => this.mesh.setMatrixAt(i, item.matrix || new T.Matrix4()));
      this.recolour();
      return this.mesh;
    }

    recolour() {
      this.items.forEach((item, i) => {
        if (item.colour) this.paint(i, this.look.ghost ? dbd.palette('--ghost') : dbd.palette(item.colour));
      });
    }

    paint(index, colour) {
      this.mesh.setColorAt(index, colour);
      this.mesh.instanceColor.needsUpdate = true;
    }

    set(index, matrix) {
      this.mesh.setMatrixAt(index, matrix);
      this.mesh.instanceMatrix.needsUpdate = true;
    }

    // Moves every shape with its owner.
    update(owners) {
      const world = new T.Matrix4();
      this.items.forEach((item, i) => {
        if (item.owner !== null) this.mesh.setMatrixAt(i, world.multiplyMatrices(owners[item.owner], item.matrix));
      });
      this.mesh.instanceMatrix.needsUpdate = true;
    }
  }

  // A colour by the name of a style sheet's variable, or any that CSS knows.
  const colours = new Map();
  dbd.palette = (name) => {
    if (!colours.has(name)) {
      const text = name.startsWith('--') ? dbd.theme.colour(name) : name;
      colours.set(name, new T.Color(text || '#888'));
    }
    return colours.get(name);
  };
  dbd.theme.onChange(() => colours.clear());

  dbd.batch = { Batch, between, at, turned, material };
}(window.dbd = window.dbd || {}));
