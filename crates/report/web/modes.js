// Modes: a list of frequencies; the chosen one swings on the stage about the pose at t = 0.
//
// (frequency, shape, amplitude) => poses in a slow swing that shows the shape, not the speed.
(function (dbd) {
  'use strict';

  const { element } = dbd.labels;
  const { f32s, plain, withUnit } = dbd.numbers;
  const { WORDS, placed } = dbd.film;
  // [Hz] of what is watched.
  const SHOWN = 0.6;

  // Poses moved along a shape: shifts in the world, turns about the bodies' axes.
  function swung(start, shape, amount, out) {
    for (let row = 0; row * WORDS < start.length; row += 1) {
      const [o, s] = [row * WORDS, row * 6];
      for (let i = 0; i < 3; i += 1) out[o + i] = start[o + i] + amount * shape[s + i];
      const turn = [3, 4, 5].map((i) => amount * shape[s + i]);
      const angle = Math.hypot(...turn);
      const share = angle > 1e-9 ? Math.sin(angle / 2) / angle : 0.5;
      const [w, x, y, z] = [Math.cos(angle / 2), ...turn.map((value) => value * share)];
      const [a, b, c, d] = [3, 4, 5, 6].map((i) => start[o + i]);
      out[o + 3] = a * w - b * x - c * y - d * z;
      out[o + 4] = a * x + b * w + c * z - d * y;
      out[o + 5] = a * y - b * z + c * w + d * x;
      out[o + 6] = a * z + b * y - c * x + d * w;
    }
    return out;
  }

  class Modes {
    constructor(stage, modes) {
      this.stage = stage;
      this.modes = modes;
      this.chosen = null;
      this.amplitude = 0.06;
      const section = document.getElementById('modes');
      section.hidden = false;
      this.buttons = element('div', 'mode-list', section);
      this.buttons.setAttribute('role', 'group');
      this.buttons.setAttribute('aria-label', 'Modes');
      modes.forEach((mode, i) => {
        const text = mode.frequency < 0 ? `grows, ${withUnit(-mode.frequency, 'Hz', 4)}` : withUnit(mode.frequency, 'Hz', 4);
        const made = dbd.controls.button(this.buttons, `Show mode ${i + 1}, ${text}`, '', () => this.choose(i));
        made.innerHTML = `<small>${i + 1}</small> `;
        made.append(text);
        made.setAttribute('aria-pressed', 'false');
      });
      const label = element('label', 'amplitude', section);
      label.append('Amplitude');
      const slider = element('input', '', label);
      Object.assign(slider, { type: 'range', min: 0.005, max: 0.25, step: 0.005, value: this.amplitude });
      slider.addEventListener('input', () => { this.amplitude = Number(slider.value); });
      element('p', 'quiet', section).textContent = 'A shape swings about the pose at t = 0 on the stage, far larger '
        + 'and slower than it would. Choose it again to go back to the run.';
      this.banner = dbd.controls.button(stage.view, 'Back to the run', '', () => this.choose(null));
      this.banner.className = 'banner';
      this.banner.hidden = true;
      dbd.clock.onTime(() => { if (this.chosen !== null) this.choose(null); });
    }

    choose(index) {
      this.chosen = index === this.chosen ? null : index;
      [...this.buttons.children].forEach((made, i) => made.setAttribute('aria-pressed', String(i === this.chosen)));
      const mode = this.modes[this.chosen];
      this.banner.hidden = !mode;
      this.stage.mode = null;
      if (mode) {
        dbd.clock.pause();
        this.banner.textContent = `Mode ${this.chosen + 1}, ${plain(Math.abs(mode.frequency), 4)} Hz \u00d7`;
        this.swing(mode, index);
      }
      this.stage.refresh();
    }

    swing(mode, index) {
      const { machine } = this.stage;
      const shape = f32s(mode.shape);
      const out = Float64Array.from(machine.start);
      const scale = this.stage.machine.size / (this.largest(shape) || 1);
      const began = performance.now();
      this.stage.mode = (shown) => {
        const phase = Math.sin(2 * Math.PI * SHOWN * (performance.now() - began) / 1000);
        shown.pose(swung(machine.start, shape, this.amplitude * scale * phase, out), dbd.clock.start);
      };
      const next = () => {
        if (this.chosen !== index) return;
        this.stage.refresh();
        requestAnimationFrame(next);
      };
      next();
    }

    // [m] the farthest that a corner goes along the shape as it is given, for small turns.
    largest(shape) {
      const { machine } = this.stage;
      const small = 1e-4;
      const moved = swung(machine.start, shape, small, Float64Array.from(machine.start));
      let most = 0;
      machine.mechanism.bodies.forEach((body, row) => {
        for (const corner of dbd.bodies.corners(body)) {
          const [a, b] = [machine.start, moved].map((poses) => placed(poses, row, corner, [0, 0, 0]));
          most = Math.max(most, Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) / small);
        }
      });
      return most;
    }
  }

  dbd.modes = { Modes, swung };
}(window.dbd = window.dbd || {}));
