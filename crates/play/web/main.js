// The page: opens a scene, says what happens, and offers tests what they call.
//
// data => engine, session, view, panels. `dbd.ready` says that the first frame is drawn.
(function (dbd) {
  'use strict';

  const { element, button } = dbd.labels;
  const { sentence } = dbd.session;
  const NARROW = window.matchMedia('(max-width: 1099.9px)');
  const CALM = window.matchMedia('(prefers-reduced-motion: reduce)');
  // [ms] between two looks at the file of a served page.
  const POLL = 1000;
  const WARNINGS = 2;
  const MOST_WARNINGS = 100;
  const find = (id) => document.getElementById(id);

  class Page {
    constructor(data) {
      this.data = data;
      this.drafts = new Map();
      this.chosen = null;
      this.failed = false;
      this.engine = new dbd.engine.Engine();
      this.session = new dbd.session.Session(this.engine);
      this.tools();
      this.view = new dbd.view.View(find('stage'), this.engine, this.session);
      this.transport = new dbd.transport.Transport(find('stage'), this.engine, this.session, this.view);
      this.grab = new dbd.grab.Grab(this.view, this.engine, this.session);
      new dbd.inputs.Inputs(find('inputs'), this.engine, this.session);
      new dbd.parameters.Parameters(find('parameters'), this.session);
      new dbd.method.Method(find('method'), this.session);
      this.curves = new dbd.curves.Curves(find('curves'), this.engine, this.session);
      this.editor = new dbd.editor.Editor(find('text'), this.session);
      this.editor.onFile = (name, text) => this.opens({ name, file: name, description: '', text });
      new dbd.save.Save(find('save'), this.engine, this.session, (text, bad) => this.say(text, bad));
      this.session.onOpened((opened, how) => this.opened(opened, how));
      this.session.onRefused((error, what) => this.refused(error, what));
      this.engine.onFrame((frame) => this.frame(frame));
      this.engine.onBroken = (message) => this.broken(message);
      if (NARROW.matches) for (const id of ['parameters', 'method', 'text', 'save']) find(id).open = false;
    }

    tools() {
      const tools = find('tools');
      const { scenes } = this.data;
      if (scenes.length > 1) {
        const label = element('label', 'scene', tools);
        element('span', '', label).textContent = 'Scene';
        this.menu = element('select', '', label);
        for (const { name, description } of scenes) {
          const option = new Option(name, name);
          option.title = description;
          this.menu.append(option);
        }
        this.menu.addEventListener('change', () => { location.hash = encodeURIComponent(this.menu.value); });
        window.addEventListener('hashchange', () => this.follow());
      }
      tools.append(dbd.theme.button());
    }

    named() {
      const name = decodeURIComponent(location.hash.slice(1));
      return this.data.scenes.find((scene) => scene.name === name) || this.data.scenes[0];
    }

    follow() {
      const scene = this.named();
      if (scene !== this.chosen) this.opens(scene);
    }

    // Opens a scene of the menu, with what was typed into it before.
    async opens(scene, settings, set) {
      if (this.chosen && this.editor.text !== this.chosen.text) this.drafts.set(this.chosen, this.editor.text);
      this.chosen = scene;
      if (this.menu && this.data.scenes.includes(scene)) this.menu.value = scene.name;
      const text = this.drafts.get(scene) || scene.text;
      this.editor.scene(scene.file, text, scene.text);
      // A step that was chosen for one scene says nothing of another.
      const kept = settings || { ...this.session.asked.settings, step: this.data.settings.step };
      const refused = await this.session.open({ file: scene.file, text }, kept, set);
      if (!refused && !CALM.matches) await this.transport.play();
      return refused;
    }

    async start() {
      const { settings, set, speed, reload } = this.data;
      await this.engine.start();
      await this.opens(this.named(), settings, set);
      if (speed) await this.transport.pace(speed);
      if (reload) this.poll(reload, null);
    }

    opened(opened, how) {
      document.title = `${opened.name} \u2013 live view`;
      find('name').textContent = opened.name;
      find('description').textContent = opened.description;
      this.warn(opened.warnings);
      if (how.reset || how.fresh) this.say('', false);
      else if (how.restarted) this.say(`Restarted at t = 0: ${how.why}.`, false);
      else this.say('', false);
      // A change after a failure starts the run again; whoever was watching goes on watching.
      if (this.failed && how.restarted && !how.reset && !how.fresh) this.transport.play();
      if (this.failed) this.recovered();
    }

    // The first warnings, and the others where somebody asks for them.
    warn(warnings) {
      const box = find('warnings');
      const key = warnings.join('\n');
      if (box.dataset.key === key) return;
      box.dataset.key = key;
      box.hidden = !warnings.length;
      const line = (warning) => {
        const made = element('p', 'warning');
        made.append(Object.assign(element('strong'), { textContent: 'Warning: ' }), warning);
        return made;
      };
      const rest = warnings.slice(WARNINGS);
      box.replaceChildren(...warnings.slice(0, WARNINGS).map(line));
      if (!rest.length) return;
      const details = element('details', '', box);
      element('summary', '', details).textContent = `${rest.length.toLocaleString('en')} more warnings`;
      details.append(...rest.slice(0, MOST_WARNINGS).map(line));
      if (rest.length > MOST_WARNINGS) element('p', 'quiet', details).textContent = 'host-sim check lists the others.';
    }

    refused(error, what) {
      if (!error) return;
      // What is wrong in the text is said beside the text; where that is closed, here too.
      if (what === 'text' && find('text').open && this.session.opened) this.say('The text has an error; the run goes on without it.', true);
      else this.say(sentence(error, this.editor.name), true);
    }

    say(text, bad) {
      const said = find('said');
      if (said.textContent !== text) said.textContent = text;
      said.classList.toggle('bad', Boolean(bad));
    }

    frame({ frame }) {
      const failed = frame[2] !== 0;
      if (failed && !this.failed) this.failure(frame);
      if (!failed && this.failed) this.recovered();
      if (dbd.ready) return;
      if (this.view.drawing) this.view.stage.draw();
      dbd.ready = true;
    }

    async failure(frame) {
      this.failed = true;
      const time = dbd.numbers.plain(frame[0], 6);
      const box = this.box('Failed:', `the run stopped at t = ${time} s. Looking for the cause and a remedy\u2026`);
      const row = element('p', 'actions', box);
      button(row, 'Reset to t = 0', 'Reset', () => this.transport.reset());
      element('span', 'quiet', row).textContent = 'The slider above goes back to an earlier moment.';
      const { text, help, error } = await this.engine.send({ do: 'diagnose' });
      if (!this.failed || error || !text) return;
      box.querySelector('.why').textContent = ` ${text.replace(/^the run failed: /, '')}.`;
      if (help) {
        const remedy = element('p', '');
        remedy.append(Object.assign(element('strong', 'remedy'), { textContent: 'Help: ' }), help);
        row.before(remedy);
      }
    }

    recovered() {
      this.failed = false;
      find('failure').hidden = true;
    }

    box(title, text) {
      const box = find('failure');
      const line = element('p');
      element('strong', '', line).textContent = title;
      element('span', 'why', line).textContent = ` ${text}`;
      box.replaceChildren(line);
      box.hidden = false;
      return box;
    }

    // The module trapped: it can only begin again.
    broken(message) {
      const { playing } = this.transport;
      this.transport.show(false);
      const box = this.box('The simulation stopped:', `${message}. This is an error of the program, not of the scene.`);
      const row = element('p', 'actions', box);
      button(row, 'Start the simulation again', 'Start again', async () => {
        const { text, file, settings, set } = this.session.asked;
        await this.engine.restart();
        box.hidden = true;
        const refused = await this.session.open({ file, text }, settings, set);
        if (!refused && playing) await this.transport.play();
      });
    }

    // A served page follows its file.
    async poll(address, version) {
      let latest = version;
      try {
        const answer = await (await fetch(address, { cache: 'no-store' })).json();
        // A file that an editor has taken away for a moment comes back.
        if (answer.error) {
          this.say(answer.error, true);
          this.lost = true;
          setTimeout(() => this.poll(address, version), POLL);
          return;
        }
        latest = answer.version;
        if (version !== null && latest !== version) {
          this.editor.original = answer.text;
          this.chosen.text = answer.text;
          this.editor.put(answer.text, true);
        }
        if (this.lost) this.say('', false);
        this.lost = false;
      } catch (_) {
        if (!this.lost) this.say('host-sim no longer serves the file; changes to it are not seen here.', true);
        this.lost = true;
      }
      setTimeout(() => this.poll(address, latest), this.lost ? 10 * POLL : POLL);
    }

    // What a test calls.
    calls() {
      const page = this;
      return {
        ask: async (request) => {
          const answer = await page.engine.send(request);
          const opened = answer.opened || answer;
          if (!answer.error && opened.run) {
            const { asked } = page.session;
            for (const key of ['file', 'text', 'settings']) if (key in request) asked[key] = request[key];
            const { why, ahead } = answer;
            page.session.take(opened, { fresh: request.do === 'open', restarted: Boolean(answer.restarted), why, ahead });
          }
          if (request.do === 'reset' && !answer.error) page.session.tell(page.session.opened, { restarted: true, reset: true });
          return answer;
        },
        advance: (steps) => page.transport.advance(steps).then(() => page.engine.fresh()),
        open: async (text) => page.session.open({ file: page.editor.name, text }),
        frame: async () => {
          const latest = await page.engine.fresh();
          return { ...dbd.engine.summary(latest), values: Array.from(latest.frame.subarray(page.engine.layout.watched)) };
        },
        get state() {
          const { opened, error } = page.session;
          return { playing: page.transport.playing, speed: dbd.clock.speed, opened, error, failed: page.failed };
        },
        page,
      };
    }
  }

  async function start() {
    const data = JSON.parse(find('play').textContent);
    if (!data || data.format !== 1) throw new Error('This page holds data of a format that it cannot read.');
    document.documentElement.classList.add('alive');
    const page = new Page(data);
    dbd.play = page.calls();
    try {
      await page.start();
    } catch (error) {
      page.box('The simulation did not start:', `${error.message}.`);
    }
  }

  start();
}(window.dbd = window.dbd || {}));
