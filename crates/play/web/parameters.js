// Parameters and all numbers of the scene by path: a filter, and a slider for each that matches.
//
// numbers of the scene => fields in groups by the first parts of their paths.
(function (dbd) {
  'use strict';

  const { element, button, toggle } = dbd.labels;
  const { Field, around } = dbd.fields;
  const { plain } = dbd.numbers;
  // Sliders at first, and after the press of a button.
  const FEW = 12;
  const MOST = 60;
  const WORDS = ['stiffness', 'damping', 'mass', 'gravity', 'inertia', 'position'];

  // "joint.pivot.stiffness" => "joint.pivot", "stiffness"
  function split(path) {
    const at = path.lastIndexOf('.');
    return at < 0 ? ['', path] : [path.slice(0, at), path.slice(at + 1)];
  }

  class Parameters {
    constructor(panel, session) {
      [this.panel, this.session] = [panel, session];
      const bar = element('div', 'filter', panel);
      const label = element('label', '', bar);
      element('span', '', label).textContent = 'Filter';
      this.filter = element('input', '', label);
      Object.assign(this.filter, { type: 'search', placeholder: 'stiffness', autocomplete: 'off', spellcheck: false });
      this.changed = toggle(bar, 'Changed only', false, () => this.render());
      this.all = button(bar, 'All numbers back to the scene\u2019s values', 'Reset all', () => session.change({ set: {} }));
      this.words = element('div', 'words', panel);
      this.words.setAttribute('role', 'group');
      this.words.setAttribute('aria-label', 'Filters');
      this.list = element('div', 'fields', panel);
      this.more = button(panel, 'Show more numbers', '', () => {
        this.most = MOST;
        this.render();
      });
      this.more.classList.add('more');
      this.note = element('p', 'quiet', panel);
      this.most = FEW;
      this.fields = new Map();
      this.filter.addEventListener('input', () => {
        this.most = FEW;
        this.render();
      });
      session.onOpened((opened, how) => this.show(opened, how));
      session.onRefused((error, what) => { if (error && what === 'set') this.update(); });
    }

    show(opened, how) {
      this.named = new Set(opened.parameters.map(({ path }) => path));
      this.numbers = [...opened.parameters, ...opened.numbers.filter(({ path }) => !this.named.has(path))];
      const key = this.numbers.map(({ path }) => path).join('\n');
      this.left = opened.numbers_left_out || 0;
      if (how.fresh) this.most = FEW;
      if (key !== this.key) this.offer();
      if (how.fresh || key !== this.key) this.render();
      else this.update();
      this.key = key;
    }

    // Words that are often looked for, where they find anything.
    offer() {
      const found = WORDS.filter((word) => this.numbers.some(({ path }) => path.includes(word)));
      this.words.replaceChildren(...found.map((word) => {
        const made = button(null, `Numbers with ${word} in their path`, word, () => {
          this.filter.value = this.filter.value.trim() === word ? '' : word;
          this.filter.dispatchEvent(new Event('input'));
        });
        made.dataset.word = word;
        return made;
      }));
    }

    base(path, value) {
      const { base } = this.session;
      return base.has(path) ? base.get(path) : value;
    }

    render() {
      for (const made of this.words.children) made.setAttribute('aria-pressed', this.filter.value.trim() === made.dataset.word);
      const words = this.filter.value.toLowerCase().split(/\s+/).filter(Boolean);
      const { set } = this.session.wanted;
      const matches = this.numbers.filter(({ path }) =>
        words.every((word) => path.toLowerCase().includes(word)) && (!this.changed.checked || path in set));
      this.fields.clear();
      const parts = document.createDocumentFragment();
      let [group, box] = [null, null];
      for (const { path, value, unit } of matches.slice(0, this.most)) {
        const [first, last] = this.named.has(path) ? ['Parameters', path.replace(/^parameters\./, '')] : split(path);
        if (first !== group) {
          group = first;
          box = element('div', 'group', parts);
          element('h3', '', box).textContent = first || 'Scene';
        }
        const base = this.base(path, value);
        this.fields.set(path, new Field(box, {
          name: last, title: path, unit, value, base, scale: around(base), scaleOf: around,
          action: (wanted) => this.session.set(path, wanted === base ? undefined : wanted),
        }));
      }
      this.list.replaceChildren(parts);
      const [shown, all] = [Math.min(matches.length, this.most), matches.length];
      const more = Math.min(all, MOST) - shown;
      this.more.hidden = more <= 0;
      this.more.textContent = `Show ${more} more`;
      const said = [];
      if (!all) said.push(this.changed.checked ? 'No number is changed.' : 'No path has these words in it.');
      if (all > MOST) said.push(`${shown} of ${all.toLocaleString('en')} numbers. The filter finds the others.`);
      if (this.left) said.push(`${plain(this.left, 9)} more numbers are in the scene\u2019s text only.`);
      this.note.textContent = said.join(' ');
      this.note.hidden = !said.length;
      this.update();
    }

    update() {
      const { set } = this.session.wanted;
      this.all.disabled = !Object.keys(set).length;
      for (const { path, value } of this.numbers) {
        const field = this.fields.get(path);
        if (field) field.show(path in set ? set[path] : value, this.base(path, value));
      }
    }
  }

  dbd.parameters = { Parameters };
}(window.dbd = window.dbd || {}));
