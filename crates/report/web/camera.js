// The camera: where it looks from at first, by presets, and by mouse, touch and keys.
//
// (points of the motion, preset) => position at which all of them are seen.
(function (dbd) {
  'use strict';

  const T = window.THREE;
  const FIELD = 28;

  class Camera {
    constructor(machine, canvas, changed) {
      this.machine = machine;
      this.camera = new T.PerspectiveCamera(FIELD, 1, 0.01, 100);
      this.axes = [machine.side, machine.out, machine.up].map((axis) => new T.Vector3().fromArray(axis));
      this.camera.up.copy(this.axes[2]);
      this.controls = new T.OrbitControls(this.camera, canvas);
      this.controls.addEventListener('change', changed);
      this.controls.addEventListener('start', () => { this.chosen = null; });
      // A finger that goes up or down scrolls the page, across it turns the view.
      canvas.style.touchAction = 'pan-y';
      this.preset(machine.firstView);
    }

    // Directions towards the reader: share of side, out and up.
    direction(name) {
      const [side, out, up] = this.axes;
      const shares = {
        start: [0.22, 1, 0.16], iso: [0.5, 1, 0.55], front: [0, 1, 0], side: [1, 0, 0], top: [0, 1e-3, 1],
      }[name];
      return new T.Vector3().addScaledVector(side, shares[0]).addScaledVector(out, shares[1])
        .addScaledVector(up, shares[2]).normalize();
    }

    preset(name) {
      this.chosen = name;
      this.look(this.direction(name));
    }

    // Places the camera so that the whole motion is seen from a direction.
    look(toward) {
      const up = this.camera.up;
      const right = new T.Vector3().crossVectors(up, toward).normalize();
      const above = new T.Vector3().crossVectors(toward, right);
      const axes = [right, above, toward];
      const points = this.machine.reached.map((point) => {
        const vector = new T.Vector3().fromArray(point);
        return axes.map((axis) => vector.dot(axis));
      });
      const low = [0, 1, 2].map((i) => points.reduce((least, point) => Math.min(least, point[i]), Infinity));
      const high = [0, 1, 2].map((i) => points.reduce((most, point) => Math.max(most, point[i]), -Infinity));
      const middle = low.map((value, i) => (value + high[i]) / 2);
      // Room for joints, feet and arrows about the corners.
      const margin = 4.5 * this.machine.radius;
      const slope = Math.tan((FIELD * Math.PI) / 360);
      const wide = slope * Math.max(this.camera.aspect, 0.2);
      let far = 0;
      for (const [x, y, z] of points) {
        far = Math.max(far, z - middle[2] + (Math.abs(x - middle[0]) + margin) / wide,
          z - middle[2] + (Math.abs(y - middle[1]) + margin) / slope);
      }
      far = 1.06 * far || 1;
      const target = this.controls.target.set(0, 0, 0);
      axes.forEach((axis, i) => target.addScaledVector(axis, middle[i]));
      this.camera.position.copy(target).addScaledVector(toward, far);
      this.camera.near = far / 200;
      this.camera.far = far * 40;
      this.camera.updateProjectionMatrix();
      this.controls.minDistance = far / 100;
      this.controls.maxDistance = far * 10;
      this.controls.update();
    }

    // Goes on looking from where another camera did.
    follow(other) {
      this.chosen = other.chosen;
      this.camera.position.copy(other.camera.position);
      this.controls.target.copy(other.controls.target);
      for (const key of ['near', 'far', 'aspect']) this.camera[key] = other.camera[key];
      this.camera.updateProjectionMatrix();
      this.controls.minDistance = other.controls.minDistance;
      this.controls.maxDistance = other.controls.maxDistance;
      this.controls.update();
    }

    resize(aspect) {
      this.camera.aspect = aspect;
      this.camera.updateProjectionMatrix();
      // A view that the reader has not touched keeps showing everything.
      if (this.chosen) this.preset(this.chosen);
    }

    // Turns about the target by angles [rad], or comes nearer by a factor.
    orbit(about, above) {
      const { target } = this.controls;
      const offset = this.camera.position.clone().sub(target);
      const turn = new T.Quaternion().setFromAxisAngle(this.camera.up, about);
      offset.applyQuaternion(turn);
      const level = new T.Vector3().crossVectors(this.camera.up, offset).normalize();
      const raised = offset.clone().applyQuaternion(new T.Quaternion().setFromAxisAngle(level, -above));
      // Never over the pole.
      if (Math.abs(raised.clone().normalize().dot(this.camera.up)) < 0.995) offset.copy(raised);
      this.camera.position.copy(target).add(offset);
      this.chosen = null;
      this.controls.update();
    }

    zoom(factor) {
      const { target } = this.controls;
      this.camera.position.sub(target).multiplyScalar(factor).add(target);
      this.chosen = null;
      this.controls.update();
    }
  }

  dbd.camera = { Camera };
}(window.dbd = window.dbd || {}));
