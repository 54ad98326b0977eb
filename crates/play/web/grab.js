// Pulling at a body with the mouse or a finger.
//
// pointer on a body => the module's damped spring between the point that was hit and the pointer, and a line between both.
(function (dbd) {
  'use strict';

  const T = window.THREE;
  const { Batch, between, at } = dbd.batch;
  // [pixels] from a body that still hit it.
  const NEAR = { mouse: 5, pen: 8, touch: 16 };
  // Below this cosine a plane is seen too much from its edge to be dragged in.
  const EDGE = 0.35;

  class Grab {
    constructor(view, engine, session) {
      [this.view, this.engine, this.session] = [view, engine, session];
      this.held = null;
      this.attached = null;
      view.onShown(() => {
        this.attach();
        if (this.held) this.line();
      });
      session.onOpened((opened, how) => { if (how.restarted) this.release(); });
    }

    // Listens to the stage, which exists from the first scene that is drawn on.
    attach() {
      const { stage } = this.view;
      if (this.attached === stage) return;
      this.attached = stage;
      const { view } = stage;
      view.addEventListener('pointerdown', (event) => this.down(event), { capture: true });
      // A finger on a body does not scroll the page.
      view.addEventListener('touchstart', (event) => {
        if (event.touches.length === 1 && this.found(event.touches[0], 'touch')) event.preventDefault();
      }, { capture: true, passive: false });
      view.addEventListener('pointermove', (event) => this.move(event), { capture: true });
      for (const name of ['pointerup', 'pointercancel', 'lostpointercapture']) {
        view.addEventListener(name, (event) => this.up(event), { capture: true });
      }
    }

    up(event) {
      if (this.held && event.pointerId === this.held.pointer) this.release();
    }

    place(event) {
      const box = this.view.stage.view.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    }

    // The body at a place of the screen or near it, and its point there in the world.
    found(event, pointer) {
      const { stage } = this.view;
      if (!this.view.drawing || event.target.closest('button, .views')) return null;
      const [x, y] = this.place(event);
      const near = NEAR[pointer] || NEAR.mouse;
      const wanted = ({ what }) => what === 'body' || what === 'joint';
      const spots = [[0, 0]];
      for (let i = 0; i < 8; i += 1) spots.push([near * Math.cos((i * Math.PI) / 4), near * Math.sin((i * Math.PI) / 4)]);
      for (const [dx, dy] of spots) {
        const hit = stage.hit(x + dx, y + dy, wanted);
        if (!hit) continue;
        const row = hit.label.what === 'body' ? hit.label.row : this.ofJoint(hit.label.row);
        if (row !== null) return { row, point: hit.point };
      }
      return null;
    }

    // A joint is held by the body that moves.
    ofJoint(row) {
      const [first, second] = this.view.stage.machine.mechanism.joints[row].places;
      return second.body ?? first.body;
    }

    down(event) {
      if (event.button !== 0 || event.shiftKey || event.ctrlKey || event.metaKey || this.held) return;
      const found = this.found(event, event.pointerType);
      if (!found) return;
      event.stopPropagation();
      event.preventDefault();
      const { stage } = this.view;
      stage.view.setPointerCapture(event.pointerId);
      stage.camera.controls.enabled = false;
      stage.labels.point(null);
      const { row, point } = found;
      const local = point.clone().applyMatrix4(stage.machine.owners[row].clone().invert());
      this.view.still = true;
      this.held = { pointer: event.pointerId, row, local, target: point.clone(), origin: point.clone(), normal: this.normal() };
      this.draw();
      this.send();
    }

    // The plane to drag in: that of a planar mechanism, unless it is seen from its edge, else the one that faces the camera.
    normal() {
      const { machine, camera } = this.view.stage;
      const toward = camera.camera.getWorldDirection(new T.Vector3());
      const flat = this.session.opened.planar && machine.flat && new T.Vector3().fromArray(machine.flat);
      return flat && Math.abs(flat.dot(toward)) > EDGE ? flat : toward;
    }

    move(event) {
      if (!this.held || event.pointerId !== this.held.pointer) return;
      event.stopPropagation();
      const { stage } = this.view;
      const [x, y] = this.place(event);
      const ray = new T.Raycaster();
      ray.setFromCamera(new T.Vector2((x / stage.view.clientWidth) * 2 - 1, 1 - (y / stage.view.clientHeight) * 2), stage.camera.camera);
      const { origin, normal, target } = this.held;
      const { origin: eye, direction } = ray.ray;
      const along = origin.clone().sub(eye).dot(normal) / direction.dot(normal);
      if (!(along > 0) || !Number.isFinite(along)) return;
      target.copy(eye).addScaledVector(direction, along);
      this.send();
      this.line();
      stage.request();
    }

    send() {
      const { row, local, target } = this.held;
      const request = { do: 'grab', body: row, point: local.toArray(), target: target.toArray(), speed: dbd.clock.speed };
      this.engine.last('grab', request, (answer) => {
        if (!answer.error) return;
        this.release();
        this.session.refuse(answer.error, 'grab');
      });
    }

    release() {
      if (!this.held) return;
      this.held = null;
      this.view.still = false;
      this.view.stage.camera.controls.enabled = true;
      this.engine.last('grab', { do: 'release' });
      this.group.visible = false;
      this.view.stage.request();
    }

    // The line, drawn over everything.
    draw() {
      const { stage } = this.view;
      if (!this.group) {
        this.group = new T.Group();
        this.rod = new Batch('cylinder', { above: true });
        this.balls = new Batch('sphere', { above: true });
        this.rod.add(null, new T.Matrix4(), '--force', null);
        for (let i = 0; i < 2; i += 1) this.balls.add(null, new T.Matrix4(), '--force', null);
        this.group.add(this.rod.build(), this.balls.build());
        dbd.theme.onChange(() => [this.rod, this.balls].forEach((batch) => batch.recolour()));
        stage.scene.add(this.group);
      }
      this.group.visible = true;
      this.line();
      stage.request();
    }

    line() {
      const { machine } = this.view.stage;
      const { row, local, target } = this.held;
      const from = dbd.film.placed(machine.poses, row, local.toArray(), [0, 0, 0]);
      const to = target.toArray();
      this.rod.set(0, between(from, to, 0.22 * machine.radius));
      this.balls.set(0, at(from, 0.6 * machine.radius));
      this.balls.set(1, at(to, 0.6 * machine.radius));
    }
  }

  dbd.grab = { Grab };
}(window.dbd = window.dbd || {}));
