// Step, scheme, damping and precision, with the command that makes the same run.
//
// choices of the module => selects and a field; each change goes to the module at once.
(function (dbd) {
  'use strict';

  const { element, button } = dbd.labels;
  const { Field, around } = dbd.fields;
  const { withUnit } = dbd.numbers;

  // [s] below which time would stand still.
  const SHORTEST = 1e-12;

  class Method {
    constructor(panel, session) {
      this.session = session;
      const row = element('div', 'selects', panel);
      this.selects = {};
      for (const name of ['scheme', 'damping', 'precision']) {
        const label = element('label', '', row);
        element('span', '', label).textContent = name[0].toUpperCase() + name.slice(1);
        const select = element('select', '', label);
        select.addEventListener('change', () => this.choose(name, select.value));
        this.selects[name] = select;
      }
      this.fields = element('div', 'fields', panel);
      this.limit = element('p', 'quiet', panel);
      const box = element('div', 'command', panel);
      this.command = element('pre', '', box);
      this.copy = button(box, 'Copy the command', 'Copy', () => this.copied());
      session.onOpened((opened, how) => this.show(opened, how));
      session.onRefused((error, what) => { if (error && what === 'settings') this.show(session.opened, {}); });
    }

    choose(name, value) {
      const settings = { [name]: value };
      if (name === 'scheme') {
        // Another scheme has its own dampings and options; a damping that it shares stays.
        const scheme = this.session.opened.choices.schemes.find((one) => one.name === value);
        if (!scheme.dampings.includes(this.session.wanted.settings.damping)) settings.damping = undefined;
        Object.assign(settings, { newton: undefined, rho: undefined });
      }
      this.session.choose(settings);
    }

    show(opened, how) {
      const { schemes, precisions } = opened.choices;
      const scheme = schemes.find(({ name }) => name === opened.scheme);
      fill(this.selects.scheme, schemes.map(({ name }) => name), opened.scheme);
      fill(this.selects.damping, scheme ? scheme.dampings : [opened.damping], opened.damping);
      fill(this.selects.precision, precisions, opened.precision);
      if (how.fresh || !this.step) this.first(opened);
      this.step.show(opened.step);
      const share = opened.step / opened.limit;
      this.limit.textContent = opened.limit
        ? `The longest step that is stable at t = 0 is ${withUnit(opened.limit, 's', 3)}; `
          + `this one is ${dbd.numbers.plain(100 * share, 3)} % of it.`
        : 'This scheme is stable with any step.';
      this.limit.classList.toggle('over', Boolean(opened.limit) && share > 1);
      this.command.textContent = opened.command;
    }

    first(opened) {
      this.fields.replaceChildren();
      this.step = new Field(this.fields, {
        name: 'Step', title: 'Step', unit: 's', value: opened.step, base: opened.step, scale: around(opened.step),
        action: (wanted) => {
          if (wanted !== undefined && !(wanted >= SHORTEST)) {
            const help = wanted > 0 ? 'at least 1e-12 s' : 'a number above 0';
            this.session.refuse({ message: `a step of ${wanted} s is not possible`, help }, 'settings');
            return;
          }
          this.session.choose({ step: wanted === undefined ? this.step.base : wanted });
        },
      });
    }

    async copied() {
      try {
        await navigator.clipboard.writeText(this.command.textContent);
        this.copy.textContent = 'Copied';
      } catch (_) {
        getSelection().selectAllChildren(this.command);
        this.copy.textContent = 'Selected';
      }
      setTimeout(() => { this.copy.textContent = 'Copy'; }, 1500);
    }
  }

  function fill(select, names, chosen) {
    const key = names.join('\n');
    if (select.dataset.names !== key) {
      select.replaceChildren(...names.map((name) => new Option(name, name)));
      select.dataset.names = key;
    }
    select.value = chosen;
  }

  dbd.method = { Method };
}(window.dbd = window.dbd || {}));
