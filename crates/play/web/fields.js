// A number with its slider: what inputs, parameters and the step are changed with.
//
// (name, unit, value, range) => slider, field, a button back to the first value; change => action.
(function (dbd) {
  'use strict';

  const { element, button } = dbd.labels;
  const { plain, withUnit } = dbd.numbers;
  const BACK = '<svg viewBox="0 0 24 24" aria-hidden="true">'
    + '<path d="M12 5V1L6 6l6 5V7a5.500 5.500 0 1 1-5.500 5.500H4A8 8 0 1 0 12 5z"/></svg>';
  let made = 0;

  // A number as one types it: the shortest that is the same at seven digits.
  function typed(value) {
    if (value === null || value === undefined || !Number.isFinite(value)) return '';
    const size = Math.abs(value);
    const short = Number(value.toPrecision(7));
    return size !== 0 && (size >= 1e6 || size < 1e-3) ? short.toExponential().replace('e+', 'e') : String(short);
  }

  function parsed(text) {
    const trimmed = text.trim().replace(/\u2212/g, '-').replace(',', '.');
    return trimmed === '' ? NaN : Number(trimmed);
  }

  // Positions of a slider, from -1 to 1, and the values there.
  const linear = (most) => ({ to: (at) => at * most, from: (value) => value / most });
  const decades = (base) => ({
    to: (at) => Number((base * 10 ** at).toPrecision(6)),
    from: (value) => (value / base > 0 ? Math.log10(value / base) : -1),
  });
  const around = (base) => (base ? decades(base) : linear(1));

  class Field {
    // {name, title, unit, value, base, scale, action(value | undefined)}; undefined: back to the first value.
    constructor(parent, given) {
      Object.assign(this, given);
      made += 1;
      this.row = element('div', 'field', parent);
      const label = element('label', '', this.row);
      label.htmlFor = `number-${made}`;
      label.textContent = this.name;
      label.title = this.title || this.name;
      const full = (this.title || this.name) + (this.unit && this.unit !== '1' ? ` in ${this.unit}` : '');
      this.slider = element('input', '', this.row);
      Object.assign(this.slider, { type: 'range', min: -1, max: 1, step: 0.002 });
      this.slider.setAttribute('aria-label', full);
      this.text = element('input', 'number', this.row);
      Object.assign(this.text, { type: 'text', id: label.htmlFor, inputMode: 'decimal', autocomplete: 'off', spellcheck: false });
      element('span', 'unit', this.row).textContent = this.unit === '1' ? '' : this.unit;
      this.back = button(this.row, `Back to the first value of ${this.title || this.name}`, BACK, () => this.action(undefined));
      this.back.classList.add('undo');
      this.slider.addEventListener('input', () => {
        const value = this.snapped(Number(this.slider.value));
        this.write(value, true);
        this.action(value);
      });
      this.text.addEventListener('change', () => this.entered());
      this.text.addEventListener('keydown', (event) => { if (event.key === 'Escape') this.show(this.value); });
      this.show(this.value);
    }

    // The middle of the slider is the first value.
    snapped(at) {
      if (Math.abs(at) < 0.004) return this.scale.to(0);
      return this.scale.to(at);
    }

    entered() {
      const value = parsed(this.text.value);
      const bad = !Number.isFinite(value);
      this.text.setAttribute('aria-invalid', bad);
      this.text.title = bad ? 'Not a number' : '';
      if (bad) return;
      this.write(value, false);
      this.action(value);
    }

    write(value, sliding) {
      this.value = value;
      if (!sliding || document.activeElement !== this.text) this.text.value = typed(value);
      if (!sliding) this.slider.value = Math.min(Math.max(this.scale.from(value), -1), 1);
      this.slider.setAttribute('aria-valuetext', withUnit(value, this.unit));
      const changed = this.base !== undefined && value !== this.base;
      this.back.disabled = !changed;
      this.row.classList.toggle('changed', changed);
    }

    // Shows what the module holds, unless somebody is typing or sliding here.
    show(value, base) {
      if (base !== undefined && base !== this.base) {
        this.base = base;
        if (this.scaleOf) this.scale = this.scaleOf(base);
      }
      if (document.activeElement === this.text && this.text.value !== typed(this.value)) return;
      this.text.setAttribute('aria-invalid', false);
      this.text.title = '';
      this.write(value, this.slider.matches(':active'));
    }
  }

  dbd.fields = { Field, linear, around, typed, parsed, plain };
}(window.dbd = window.dbd || {}));
