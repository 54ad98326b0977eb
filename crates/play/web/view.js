// The mechanism as it is now: the report's stage, fed by frames, with its views and switches.
//
// module's description, frames => picture. Too many bodies or no WebGL: a sentence in its place.
(function (dbd) {
  'use strict';

  const { element, button, toggle } = dbd.labels;
  const { Live, rescale } = dbd.live;
  const { Trails } = dbd.trails;
  const { withUnit } = dbd.numbers;
  const MOST_BODIES = 2000;
  const VIEWS = [['iso', 'Iso'], ['front', 'Front'], ['top', 'Top'], ['side', 'Side']];
  // [ms] between two looks whether all of it is still in sight.
  const LOOK = 300;
  // Sizes of the mechanism from its middle up to which the view is widened.
  const FOLLOWED = 4;
  // [ms] between frames that look jerky, and how many of them in surplus.
  const SLOW = 70;
  const SLOW_FRAMES = 8;

  class View {
    constructor(section, engine, session) {
      [this.section, this.engine, this.session] = [section, engine, session];
      this.said = element('p', 'instead', section);
      this.said.hidden = true;
      this.stage = null;
      this.drawing = false;
      Object.assign(this, { looked: 0, drawn: 0, slow: 0 });
      this.legendText = '';
      this.listeners = [];
      this.options = element('div', 'options', section);
      this.options.setAttribute('role', 'group');
      this.options.setAttribute('aria-label', 'What is shown');
      session.onOpened((opened, how) => this.opened(opened, how));
      engine.onFrame((data) => this.frame(data));
      dbd.theme.onChange(() => { if (this.trails) this.trails.recolour(); });
    }

    // listener() after each frame, before it is drawn
    onShown(listener) { this.listeners.push(listener); }

    opened(opened, how) {
      const { mechanism } = opened.run;
      if (how.restarted) {
        this.jump = true;
        if (this.drawing && !how.fresh) this.narrow();
      }
      if (how.reset) return;
      const key = JSON.stringify(mechanism);
      if (!how.fresh && key === this.key) {
        if (this.drawing) this.stage.machine.film.layout = opened.layout;
        return;
      }
      this.key = key;
      this.show(opened, how);
    }

    show(opened, how) {
      const { mechanism } = opened.run;
      const bodies = mechanism.bodies.length;
      if (bodies > MOST_BODIES) {
        const [many, most] = [bodies, MOST_BODIES].map((count) => count.toLocaleString('en'));
        this.instead(`The scene has ${many} bodies, more than are drawn live (${most}). It runs, and its curves are shown.`);
        return;
      }
      const run = { mechanism, live: new Live(opened, how.ahead) };
      if (!this.stage) {
        const stage = new dbd.stage.Stage(this.section, [run]);
        if (!stage.works) {
          this.instead('This browser does not offer WebGL, so the mechanism is not drawn. The simulation runs; curves and controls work.');
          return;
        }
        this.stage = stage;
        stage.view.setAttribute('aria-label', 'The mechanism in three dimensions. Drag a body to pull it, drag beside it to turn the view. '
          + 'Space plays and pauses, Shift and arrows turn the view, question mark lists all keys.');
        this.section.prepend(stage.view);
        this.views(stage.view);
        this.legend = element('div', 'legend', stage.view);
      } else {
        // A scene that was changed is seen from where the last one was.
        this.stage.show([run], !how.fresh);
      }
      this.drawing = true;
      this.said.hidden = true;
      this.stage.view.hidden = false;
      const { machine } = this.stage;
      this.first = machine.reached.slice();
      this.trails = new Trails(machine, opened.traces);
      this.switches(opened);
      this.legendText = '';
      if (this.engine.latest) this.frame(this.engine.latest);
    }

    instead(sentence) {
      this.drawing = false;
      this.said.textContent = sentence;
      this.said.hidden = false;
      this.options.replaceChildren();
      if (this.stage) this.stage.view.hidden = true;
    }

    frame({ frame, playing }) {
      dbd.clock.time = frame[0];
      if (!this.drawing) return;
      const { machine } = this.stage;
      machine.film.show(frame);
      rescale(machine);
      machine.film.poses(frame[0], machine.poses);
      const back = this.jump || frame[0] < this.last;
      this.last = frame[0];
      this.jump = false;
      if (this.trails.group.visible) this.trails.update(back);
      for (const listener of this.listeners) listener();
      this.describe();
      this.reach();
      this.refine(playing);
      dbd.clock.set(frame[0]);
    }

    // Until the reader turns the view it goes back far enough to show everything.
    reach() {
      const { stage } = this;
      const { machine } = stage;
      const now = performance.now();
      if (!stage.camera.chosen || this.still || now - this.looked < LOOK) return;
      this.looked = now;
      const seen = span(machine.reached);
      const far = [];
      const margin = 0.05 * machine.size;
      machine.mechanism.bodies.forEach((body, row) => {
        for (const corner of dbd.bodies.corners(body)) {
          const point = dbd.film.placed(machine.poses, row, corner, [0, 0, 0]);
          const beyond = point.some((value, i) => value < seen.low[i] - margin || value > seen.high[i] + margin);
          // What leaves for good is not followed.
          const near = point.every((value, i) => Math.abs(value - seen.middle[i]) < FOLLOWED * machine.size);
          if (beyond && near) far.push(point);
        }
      });
      if (!far.length) return;
      machine.reached.push(...far.slice(0, 200));
      stage.camera.preset(stage.camera.chosen);
    }

    // Back to the reach of the start.
    narrow() {
      const { machine, camera } = this.stage;
      machine.reached = this.first.slice();
      if (camera.chosen) camera.preset(camera.chosen);
    }

    // Draws fewer pixels while a run plays on a machine that is slow to draw: one without a graphics card.
    refine(playing) {
      const now = performance.now();
      const passed = now - this.drawn;
      this.drawn = now;
      const { stage } = this;
      if (!playing) {
        this.slow = 0;
        if (stage.fineness !== 1) this.fine(1);
        return;
      }
      // Every slow frame counts up, every other one down; a tab that slept does not count.
      this.slow = Math.max(0, this.slow + (passed > SLOW && passed < 2000 ? 1 : -1));
      if (this.slow < SLOW_FRAMES || stage.fineness <= 0.5) return;
      this.slow = 0;
      this.fine(stage.fineness / Math.SQRT2);
    }

    fine(fineness) {
      this.stage.fineness = fineness;
      this.stage.resize();
    }

    switches(opened) {
      const { stage } = this;
      const { machine } = stage;
      const row = this.options;
      row.replaceChildren();
      this.names = toggle(row, 'Names', stage.labels.names, (on) => { stage.labels.names = on; stage.request(); });
      if (machine.mechanism.forces.length) toggle(row, 'Forces', true, (on) => { machine.arrows.show(on); stage.refresh(); });
      if (machine.springs.ofJoints) {
        toggle(row, 'Springs of joints', false, (on) => { machine.springs.show(on); stage.refresh(); });
      }
      if (opened.traces.length) {
        toggle(row, 'Paths', true, (on) => {
          this.trails.group.visible = on;
          this.trails.update(on);
          stage.refresh();
        });
      }
      if (this.help) row.append(this.help);
    }

    views(view) {
      const row = element('div', 'views', view);
      row.setAttribute('role', 'group');
      row.setAttribute('aria-label', 'Views');
      VIEWS.forEach(([name, text], i) => button(row, `${text} view (${i + 1})`, text, () => this.look(name)));
      button(row, 'Show everything (0)', 'Fit', () => this.look(null));
    }

    look(name) {
      if (!this.drawing) return;
      const { machine, camera } = this.stage;
      this.narrow();
      camera.preset(name || machine.firstView);
      this.looked = 0;
      this.reach();
      this.stage.request();
    }

    orbit(about, above) {
      if (this.drawing) this.stage.camera.orbit(about, above);
    }

    // The scale of the springs' colours.
    describe() {
      const { springs, mechanism } = this.stage.machine;
      const shown = mechanism.springs.length > 0 && springs.largest > 0;
      const most = shown ? withUnit(springs.largest, 'N', 2) : '';
      this.legend.hidden = !shown;
      if (most === this.legendText) return;
      this.legendText = most;
      this.legend.innerHTML = `<span>\u2212${most}</span><i></i><span>${most}</span>`
        + '<small><span>springs push</span><span>pull</span></small>';
    }
  }

  function span(points) {
    const low = [0, 1, 2].map((i) => points.reduce((least, point) => Math.min(least, point[i]), Infinity));
    const high = [0, 1, 2].map((i) => points.reduce((most, point) => Math.max(most, point[i]), -Infinity));
    return { low, high, middle: low.map((value, i) => (value + high[i]) / 2) };
  }

  dbd.view = { View };
}(window.dbd = window.dbd || {}));
