// What one operates the animation with: buttons, sliders, toggles, keys.
//
// clicks and keys => clock, stage. All of them have names for screen readers and can be reached by Tab.
(function (dbd) {
  'use strict';

  const { element, button, toggle } = dbd.labels;
  const { time: timeText, plain, withUnit } = dbd.numbers;
  const VIEWS = [['iso', 'Iso'], ['front', 'Front'], ['top', 'Top'], ['side', 'Side']];
  const KEYS = [
    ['Space', 'play or pause'], ['\u2190 \u2192', 'one frame back or on'], ['Home End', 'start, end'],
    ['+ \u2212', 'faster, slower'], ['1 2 3 4', 'views: iso, front, top, side'], ['0', 'show everything again'],
    ['Shift + arrows', 'turn the view'], ['Page \u2191 \u2193', 'nearer, farther, with the view in focus'],
    ['L', 'repeat'], ['N', 'names'], ['?', 'this list'],
  ];
  const ICONS = {
    play: 'M7 4v16l13-8z', pause: 'M6 4h4v16H6zM14 4h4v16h-4z', back: 'M17 5v14l-9-7zM5 5h2.4v14H5z',
    on: 'M7 5v14l9-7zM16.600 5H19v14h-2.400z', loop: 'M7 7h9v3l5-4-5-4v3H5v7h2zM17 17H8v-3l-5 4 5 4v-3h11v-7h-2z',
  };

  function icon(name) {
    return `<svg viewBox="0 0 24 24" aria-hidden="true"><path d="${ICONS[name]}"/></svg>`;
  }

  class Controls {
    constructor(section, stage) {
      this.stage = stage;
      this.clock = dbd.clock;
      const { film, mechanism } = stage.machine;
      this.spacing = film && film.frames > 1 ? (this.clock.end - this.clock.start) / (film.frames - 1) : 0.001;
      this.moves = Boolean(film && film.frames > 1 && this.clock.end > this.clock.start);
      if (this.moves) this.bar(section);
      this.options(section, mechanism);
      this.views(stage.view);
      this.legend(stage.view);
      this.help(section);
      document.addEventListener('keydown', (event) => this.key(event));
    }

    bar(section) {
      const { clock } = this;
      const bar = element('div', 'bar', section);
      bar.setAttribute('role', 'group');
      bar.setAttribute('aria-label', 'Animation');
      const buttons = element('span', 'buttons', bar);
      button(buttons, 'One frame back', icon('back'), () => this.step(-1));
      this.play = button(buttons, 'Play', icon('play'), () => clock.toggle());
      this.play.classList.add('play');
      button(buttons, 'One frame on', icon('on'), () => this.step(1));
      this.loop = button(buttons, 'Repeat', icon('loop'), () => { clock.loop = !clock.loop; clock.changed(); });
      this.scrub = element('input', 'scrub', bar);
      Object.assign(this.scrub, { type: 'range', min: clock.start, max: clock.end, step: 'any', value: clock.time });
      this.scrub.setAttribute('aria-label', 'Time');
      this.scrub.addEventListener('input', () => { clock.pause(); clock.set(Number(this.scrub.value)); });
      this.clockText = element('output', 'time', bar);
      this.clockText.setAttribute('aria-live', 'off');
      const label = element('label', 'speed', bar);
      element('span', '', label).textContent = 'Speed';
      this.speed = element('select', '', label);
      this.speed.title = 'Seconds of the run in a second of watching';
      for (const speed of clock.speeds) {
        const option = element('option', '', this.speed);
        option.value = speed;
        option.textContent = (speed < 1 ? '1/' + plain(1 / speed) : plain(speed)) + ' \u00d7';
      }
      this.speed.addEventListener('change', () => { clock.speed = Number(this.speed.value); clock.changed(); });
      clock.onTime((time) => this.show(time));
      clock.onState(() => this.state());
      this.state();
      this.show(clock.time);
    }

    show(time) {
      this.scrub.value = time;
      const share = (time - this.clock.start) / (this.clock.end - this.clock.start);
      this.scrub.style.setProperty('--share', (100 * share).toFixed(2) + '%');
      const text = timeText(time, this.spacing);
      this.scrub.setAttribute('aria-valuetext', text);
      this.clockText.textContent = text;
    }

    state() {
      const { clock } = this;
      const name = clock.playing ? 'Pause' : 'Play';
      this.play.setAttribute('aria-label', name);
      this.play.title = name + ' (space)';
      this.play.innerHTML = icon(name.toLowerCase());
      this.loop.setAttribute('aria-pressed', clock.loop);
      this.speed.value = clock.speed;
    }

    step(by) {
      const { film } = this.stage.machine;
      if (!this.moves) return;
      this.clock.pause();
      this.clock.set(film.step(this.clock.time, by));
    }

    options(section, mechanism) {
      const { stage } = this;
      const { machine } = stage;
      const row = element('div', 'options', section);
      row.setAttribute('role', 'group');
      row.setAttribute('aria-label', 'What is shown');
      this.names = toggle(row, 'Names', false, (on) => { stage.labels.names = on; stage.request(); });
      if (mechanism.forces.length) {
        toggle(row, 'Forces', true, (on) => { machine.arrows.show(on); stage.refresh(); });
      }
      if (machine.springs.ofJoints) {
        toggle(row, 'Springs of joints', false, (on) => { machine.springs.show(on); stage.refresh(); });
      }
      const [, other] = stage.machines;
      if (other) {
        toggle(row, 'Second run', true, (on) => { other.group.visible = on; stage.refresh(); });
      }
      this.traces(row);
      this.helpButton = button(row, 'Keys', '?', () => this.dialog.showModal());
      this.helpButton.classList.add('help');
    }

    traces(row) {
      const { traces } = this.stage.machine;
      if (!traces.choices.length) return;
      const first = new Set(traces.first());
      const details = element('details', 'traces', row);
      element('summary', '', details).textContent = 'Paths';
      const list = element('div', 'list', details);
      traces.choices.forEach(({ name }, i) => {
        toggle(list, name, first.has(i), (on) => { traces.show(i, on); this.stage.refresh(); });
        if (first.has(i)) traces.show(i, true);
      });
      document.addEventListener('pointerdown', (event) => {
        if (!details.contains(event.target)) details.open = false;
      });
    }

    views(view) {
      const row = element('div', 'views', view);
      row.setAttribute('role', 'group');
      row.setAttribute('aria-label', 'Views');
      VIEWS.forEach(([name, text], i) =>
        button(row, `${text} view (${i + 1})`, text, () => this.look(name)));
      button(row, 'Show everything again (0)', 'Reset', () => this.reset());
    }

    look(name) { this.stage.camera.preset(name); this.stage.request(); }

    reset() { this.look(this.stage.machine.firstView); }

    legend(view) {
      const { springs, mechanism } = this.stage.machine;
      if (!mechanism.springs.length || !(springs.largest > 0)) return;
      const legend = element('div', 'legend', view);
      const most = withUnit(springs.largest, 'N', 3);
      legend.innerHTML = `<span>\u2212${most}</span><i></i><span>${most}</span>`
        + '<small><span>springs push</span><span>pull</span></small>';
    }

    help(section) {
      this.dialog = element('dialog', 'keys', section);
      this.dialog.setAttribute('aria-label', 'Keys');
      this.dialog.innerHTML = '<h2>Keys</h2><dl>'
        + KEYS.map(([keys, does]) => `<dt><kbd>${keys}</kbd></dt><dd>${does}</dd>`).join('')
        + '</dl><p>Drag turns the view, two fingers or the right button move it, the wheel or a pinch comes nearer. '
        + 'In charts: point to set the time, drag to see a part, double click to see all.</p>'
        + '<form method="dialog"><button>Close</button></form>';
    }

    key(event) {
      const typing = event.target.closest('select, textarea, input:not([type=checkbox]):not([type=range]), dialog');
      const other = event.target.type === 'range' && event.target !== this.scrub;
      if (typing || other || event.ctrlKey || event.metaKey || event.altKey) return;
      const inside = this.stage.view.contains(event.target);
      const pressed = event.target.closest('button, summary, input[type=checkbox]');
      const turn = (about, above) => () => this.stage.camera.orbit(about, above);
      const shift = event.shiftKey;
      const slider = event.target === this.scrub;
      const actions = {
        ' ': pressed ? null : () => this.clock.toggle(),
        ArrowLeft: shift ? turn(-0.15, 0) : () => this.step(-1),
        ArrowRight: shift ? turn(0.15, 0) : () => this.step(1),
        ArrowUp: shift ? turn(0, 0.12) : null,
        ArrowDown: shift ? turn(0, -0.12) : null,
        PageUp: inside ? () => this.stage.camera.zoom(0.85) : null,
        PageDown: inside ? () => this.stage.camera.zoom(1 / 0.85) : null,
        // Home and End of a page that is longer than its stage belong to the stage only where it has the focus.
        Home: inside || slider ? () => { this.clock.pause(); this.clock.set(this.clock.start); } : null,
        End: inside || slider ? () => { this.clock.pause(); this.clock.set(this.clock.end); } : null,
        '+': () => this.clock.faster(1), '=': () => this.clock.faster(1),
        '-': () => this.clock.faster(-1), '\u2212': () => this.clock.faster(-1),
        0: () => this.reset(), 1: () => this.look('iso'), 2: () => this.look('front'),
        3: () => this.look('top'), 4: () => this.look('side'),
        l: () => { this.clock.loop = !this.clock.loop; this.clock.changed(); },
        n: () => this.names.click(),
        '?': () => this.dialog.showModal(),
      };
      const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
      if (!action) return;
      event.preventDefault();
      action();
    }
  }

  dbd.controls = { Controls, button, toggle };
}(window.dbd = window.dbd || {}));
