// Playing, stepping, going back: the bar below the stage, its keys, and what the run says of itself.
//
// buttons, slider, keys => worker; frames => time, step, hash, speed reached.
(function (dbd) {
  'use strict';

  const { element, button } = dbd.labels;
  const { time: timeText, plain } = dbd.numbers;
  const KEYS = [
    ['Space', 'play or pause'], ['.', 'one step'], ['R Home', 'reset to t = 0'], ['+ \u2212', 'faster, slower'],
    ['1 2 3 4', 'views: iso, front, top, side'], ['0', 'show everything'], ['Shift + arrows', 'turn the view'],
    ['Page \u2191 \u2193', 'nearer, farther, with the view in focus'], ['N', 'names'], ['?', 'this list'],
  ];
  const ICONS = {
    play: 'M7 4v16l13-8z', pause: 'M6 4h4v16H6zM14 4h4v16h-4z', reset: 'M19 5v14l-10-7zM5 5h2.600v14H5z',
    step: 'M6 5v14l9-7zM16.400 5H19v14h-2.600z',
  };
  const icon = (name) => `<svg viewBox="0 0 24 24" aria-hidden="true"><path d="${ICONS[name]}"/></svg>`;
  // Where keys write.
  const TYPED = 'select, textarea, [contenteditable], .cm-editor, input:not([type=checkbox]):not([type=range]), dialog';
  // [ms] between two texts of a run that plays.
  const READ = 100;
  // What is reached of the asked speed without a remark.
  const ENOUGH = 0.93;

  class Transport {
    constructor(section, engine, session, view) {
      Object.assign(this, { engine, session, view, playing: false, scrubbing: false, read: 0 });
      this.bar(section);
      this.facts(section);
      this.help(section);
      engine.onFrame((data) => this.frame(data));
      session.onOpened((opened, how) => this.opened(opened, how));
      document.addEventListener('keydown', (event) => this.key(event));
    }

    bar(section) {
      const bar = element('div', 'bar');
      section.insertBefore(bar, this.view.options);
      bar.setAttribute('role', 'group');
      bar.setAttribute('aria-label', 'Run');
      const buttons = element('span', 'buttons', bar);
      button(buttons, 'Reset to t = 0 (R)', icon('reset'), () => this.reset());
      this.button = button(buttons, 'Play (space)', icon('play'), () => this.toggle());
      this.button.classList.add('play');
      button(buttons, 'One step (.)', icon('step'), () => this.step());
      this.scrub = element('input', 'scrub', bar);
      Object.assign(this.scrub, { type: 'range', min: 0, max: 1, step: 1, value: 1, disabled: true, title: 'Back to an earlier moment' });
      this.scrub.setAttribute('aria-label', 'Rewind');
      this.scrub.addEventListener('input', () => this.preview());
      for (const name of ['change', 'pointerup', 'blur']) this.scrub.addEventListener(name, () => this.rewind());
      this.clock = element('output', 'time', bar);
      this.clock.setAttribute('aria-live', 'off');
      const label = element('label', 'speed', bar);
      element('span', '', label).textContent = 'Speed';
      this.speed = element('select', '', label);
      this.speed.title = 'Simulated seconds per second';
      this.speed.setAttribute('aria-label', 'Speed, in simulated seconds per second');
      for (const speed of dbd.clock.allSpeeds) {
        this.speed.append(new Option(`${speed < 1 ? `1/${plain(1 / speed)}` : plain(speed)} \u00d7`, speed));
      }
      this.speed.addEventListener('change', () => this.pace(Number(this.speed.value)));
    }

    facts(section) {
      const facts = element('dl', 'facts');
      section.insertBefore(facts, this.view.options);
      const fact = (name, tag, id) => {
        const pair = element('div', '', facts);
        element('dt', '', pair).textContent = name;
        const value = element(tag, '', element('dd', '', pair));
        if (id) value.id = id;
        value.setAttribute('aria-live', 'off');
        return value;
      };
      this.steps = fact('Step', 'output', 'steps');
      this.hash = fact('State hash', 'output', 'hash');
      this.hash.title = 'Equal where every bit of the state is equal: on this page, host-sim and the firmware';
      this.cost = fact('Per step', 'span');
      this.reached = fact('Real-time factor', 'span');
      this.slow = this.reached.parentElement.parentElement;
      this.slow.title = 'Simulated seconds per second: what is reached, of what is asked for';
    }

    opened(opened, how) {
      if (how.fresh) {
        // The range of the run chooses a speed; time has no end here.
        dbd.clock.range(0, opened.duration);
        dbd.clock.end = Infinity;
        dbd.clock.speeds = dbd.clock.allSpeeds;
        this.pace(dbd.clock.speed);
      }
      this.spacing = Math.max(opened.step, dbd.clock.speed / 60);
    }

    pace(speed) {
      dbd.clock.speed = speed;
      this.speed.value = speed;
      if (this.session.opened) this.spacing = Math.max(this.session.opened.step, speed / 60);
      return this.engine.send({ do: 'speed', value: speed });
    }

    play() {
      this.show(true);
      return this.engine.send({ do: 'play' });
    }

    pause() {
      this.show(false);
      return this.engine.send({ do: 'pause' });
    }

    toggle() { return this.playing ? this.pause() : this.play(); }

    advance(steps) {
      this.show(false);
      return this.engine.send({ do: 'advance', steps });
    }

    step() { return this.advance(1); }

    reset() { return this.session.reset(); }

    show(playing) {
      if (this.playing === playing) return;
      this.playing = playing;
      const name = playing ? 'Pause' : 'Play';
      this.button.setAttribute('aria-label', `${name} (space)`);
      this.button.title = `${name} (space)`;
      this.button.innerHTML = icon(name.toLowerCase());
    }

    // Shows the frame of a mark while the slider moves; only letting go takes time back.
    preview() {
      if (!this.scrubbing) this.pause();
      this.scrubbing = true;
      this.engine.held = true;
      this.engine.last('preview', { do: 'preview', mark: Number(this.scrub.value) });
    }

    async rewind() {
      if (!this.scrubbing) return;
      this.scrubbing = false;
      const answer = await this.session.back({ do: 'rewind', mark: Number(this.scrub.value) });
      this.engine.held = false;
      if (answer.error) this.session.refuse(answer.error, 'rewind');
      if (this.engine.latest) this.engine.show(this.engine.latest);
    }

    frame(data) {
      const { frame, playing, marks, preview } = data;
      if (!preview && !this.scrubbing) {
        this.show(playing);
        this.scrub.max = Math.max(marks.count - 1, 1);
        this.scrub.value = this.scrub.max;
        this.scrub.disabled = marks.count < 2;
        this.scrub.setAttribute('aria-valuetext', `${timeText(frame[0], this.spacing)}, kept from ${timeText(marks.first, this.spacing)}`);
      } else {
        this.scrub.setAttribute('aria-valuetext', timeText(frame[0], this.spacing));
      }
      const now = performance.now();
      this.clock.textContent = timeText(frame[0], this.spacing);
      if (playing && !preview && now - this.read < READ) return;
      this.read = now;
      const { steps, hash } = dbd.engine.summary(data);
      this.steps.textContent = steps.toLocaleString('en');
      this.hash.textContent = hash;
      this.cost.textContent = data.cost > 0 ? `${plain(1000 * data.cost, 3)}\u00a0\u00b5s` : '\u2013';
      const asked = dbd.clock.speed;
      const late = playing && data.rate !== null && data.rate < ENOUGH * asked;
      this.slow.classList.toggle('late', late);
      this.reached.textContent = !playing ? '\u2013' : late ? `${plain(data.rate, 2)} of ${plain(asked)}` : plain(asked);
    }

    help(section) {
      this.dialog = element('dialog', 'keys', section);
      this.dialog.setAttribute('aria-label', 'Keys');
      this.dialog.innerHTML = '<h2>Keys</h2><dl>'
        + KEYS.map(([keys, does]) => `<dt><kbd>${keys}</kbd></dt><dd>${does}</dd>`).join('')
        + '</dl><p>Drag a body with the mouse or a finger to pull it with a damped spring. Drag beside it to turn the view; two fingers '
        + 'or the right button move it, the wheel or a pinch comes nearer.</p><form method="dialog"><button>Close</button></form>';
      this.view.help = button(this.view.options, 'Keys', '?', () => this.dialog.showModal());
      this.view.help.classList.add('help');
    }

    faster(by) {
      const speeds = dbd.clock.allSpeeds;
      const at = Math.min(Math.max(speeds.indexOf(dbd.clock.speed) + by, 0), speeds.length - 1);
      this.pace(speeds[at]);
    }

    key(event) {
      const { target } = event;
      const typing = target.closest(TYPED);
      if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
      const { view } = this;
      const inside = view.stage && view.stage.view.contains(target);
      const slider = target.type === 'range';
      const pressed = target.closest('button, summary, input[type=checkbox]');
      const turn = (about, above) => (event.shiftKey && !slider ? () => view.orbit(about, above) : null);
      const actions = {
        ' ': pressed ? null : () => this.toggle(),
        '.': () => this.step(), r: () => this.reset(), Home: slider ? null : () => this.reset(),
        '+': () => this.faster(1), '=': () => this.faster(1), '-': () => this.faster(-1), '\u2212': () => this.faster(-1),
        ArrowLeft: turn(-0.15, 0), ArrowRight: turn(0.15, 0), ArrowUp: turn(0, 0.12), ArrowDown: turn(0, -0.12),
        PageUp: inside ? () => view.stage.camera.zoom(0.85) : null, PageDown: inside ? () => view.stage.camera.zoom(1 / 0.85) : null,
        0: () => view.look(null), 1: () => view.look('iso'), 2: () => view.look('front'),
        3: () => view.look('top'), 4: () => view.look('side'),
        n: view.drawing ? () => view.names.click() : null,
        '?': () => this.dialog.showModal(),
      };
      const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
      if (!action) return;
      event.preventDefault();
      action();
    }
  }

  dbd.transport = { Transport };
}(window.dbd = window.dbd || {}));
