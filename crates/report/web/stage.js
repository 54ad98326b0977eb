// The stage: canvas, lights, mechanism, camera; drawn again when the time, the view or the colours change.
//
// (data, clock) => picture. Without WebGL the still picture stays, with a sentence.
(function (dbd) {
  'use strict';

  const T = window.THREE;
  const { element } = dbd.labels;

  function renderer(canvas) {
    // What is drawn is kept, for printing.
    const wishes = { antialias: true, alpha: true, preserveDrawingBuffer: true };
    try {
      const context = canvas.getContext('webgl2', wishes);
      return context && new T.WebGLRenderer({ canvas, context, ...wishes });
    } catch (_) {
      return null;
    }
  }

  class Stage {
    constructor(section, runs) {
      this.section = section;
      this.view = element('div', 'view');
      this.view.tabIndex = 0;
      this.view.setAttribute('role', 'application');
      this.view.setAttribute('aria-label', 'The mechanism in three dimensions. Space plays and pauses, arrows turn '
        + 'the view with Shift, question mark lists all keys.');
      this.canvas = element('canvas', '', this.view);
      this.renderer = renderer(this.canvas);
      if (!this.renderer) return;
      this.scene = new T.Scene();
      this.machines = [];
      // Pixels drawn per pixel of the screen along a side: less where drawing is slow.
      this.fineness = 1;
      this.lights();
      section.append(this.view);
      this.draw = this.draw.bind(this);
      this.show(runs);
      this.time = dbd.clock.time;
      this.mode = null;
      dbd.clock.onTime((time) => { this.time = time; this.stale = true; this.request(); });
      dbd.theme.onChange(() => { this.machines.forEach((machine) => machine.recolour()); this.stale = true; this.request(); });
      new ResizeObserver(() => this.resize()).observe(this.view);
      this.hover();
      this.wheel();
      this.stale = true;
      this.resize();
      this.draw();
    }

    // Shows other runs in place of those shown; the camera may stay where it is.
    show(runs, keepView) {
      for (const machine of this.machines) {
        this.scene.remove(machine.group);
        machine.dispose();
      }
      this.machines = runs.map((run, i) => new dbd.machine.Machine(run, { ghost: i > 0 }));
      for (const machine of this.machines) this.scene.add(machine.group);
      this.machine = this.machines[0];
      const { camera, labels } = this;
      if (camera) camera.controls.dispose();
      this.camera = new dbd.camera.Camera(this.machine, this.canvas, () => this.request());
      if (camera && keepView) this.camera.follow(camera);
      else if (camera) this.camera.resize(camera.camera.aspect);
      if (labels) labels.remove();
      this.labels = new dbd.labels.Labels(this.view, this.machine);
      if (labels) Object.assign(this.labels, { names: labels.names, values: labels.values });
      this.refresh();
    }

    get works() { return Boolean(this.renderer); }

    // One light of the sky, one that stands beside the camera, so that no view lies in the dark.
    lights() {
      this.scene.add(new T.HemisphereLight(0xffffff, 0xb8c0cc, 1.9));
      this.lamp = new T.DirectionalLight(0xffffff, 1.7);
      this.scene.add(this.lamp, this.lamp.target);
    }

    resize() {
      const [width, height] = [this.view.clientWidth, this.view.clientHeight];
      if (!width || !height) return;
      this.renderer.setPixelRatio(this.fineness * Math.min(window.devicePixelRatio || 1, 2));
      this.renderer.setSize(width, height, false);
      this.camera.resize(width / height);
      // A canvas of another size is empty until it is drawn on.
      this.draw();
    }

    request() {
      if (this.waiting) return;
      this.waiting = true;
      requestAnimationFrame(this.draw);
    }

    draw() {
      this.waiting = false;
      if (this.stale) {
        if (this.mode) this.mode(this.machine);
        else for (const machine of this.machines) if (machine.group.visible) machine.update(this.time);
        this.stale = false;
      }
      const { camera } = this.camera;
      this.lamp.position.copy(camera.position).addScaledVector(camera.up, 0.3 * camera.position.distanceTo(this.camera.controls.target));
      this.lamp.target.position.copy(this.camera.controls.target);
      this.renderer.render(this.scene, camera);
      this.labels.update(camera, this.view.clientWidth, this.view.clientHeight);
    }

    refresh() {
      this.stale = true;
      this.request();
    }

    // What lies under a point of the view.
    under(x, y) {
      const hit = this.hit(x, y);
      return hit && hit.label;
    }

    // The same with its point in the world; of what is wanted only.
    hit(x, y, wanted) {
      const ray = new T.Raycaster();
      ray.setFromCamera(new T.Vector2((x / this.view.clientWidth) * 2 - 1, 1 - (y / this.view.clientHeight) * 2),
        this.camera.camera);
      const meshes = [];
      this.machine.group.traverse((object) => {
        if (!object.isMesh || !object.visible || (object.parent && !object.parent.visible)) return;
        if (object.isInstancedMesh) object.computeBoundingSphere();
        meshes.push(object);
      });
      for (const hit of ray.intersectObjects(meshes, false)) {
        const { batch, label } = hit.object.userData;
        const found = batch ? batch.items[hit.instanceId].label : label;
        if (found && (!wanted || wanted(found))) return { label: found, point: hit.point };
      }
      return null;
    }

    // Where the stage lies across the page, the wheel scrolls it until the reader has clicked the picture.
    wheel() {
      const beside = window.matchMedia('(min-width: 1100px)');
      this.view.addEventListener('pointerdown', () => this.view.focus({ preventScroll: true }));
      this.view.addEventListener('wheel', (event) => {
        const meant = beside.matches || event.ctrlKey || this.view.contains(document.activeElement);
        if (!meant) event.stopPropagation();
      }, { capture: true });
    }

    hover() {
      let waiting = null;
      const look = () => {
        const [x, y] = waiting;
        waiting = null;
        this.labels.point(this.under(x, y), x, y, this.time, this.view.clientWidth);
      };
      this.view.addEventListener('pointermove', (event) => {
        if (event.buttons) { this.labels.point(null); return; }
        const box = this.view.getBoundingClientRect();
        const idle = waiting === null;
        waiting = [event.clientX - box.left, event.clientY - box.top];
        if (idle) requestAnimationFrame(look);
      });
      this.view.addEventListener('pointerleave', () => this.labels.point(null));
    }
  }

  dbd.stage = { Stage };
}(window.dbd = window.dbd || {}));
