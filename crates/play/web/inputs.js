// Inputs: what is driven while the plant runs, a slider each.
//
// inputs of the scene => fields; a value is held until the next.
(function (dbd) {
  'use strict';

  const { element } = dbd.labels;
  const { Field, linear } = dbd.fields;
  // Sliders at once; the others are found by the filter.
  const MOST = 60;
  // A slider's end where the first value is small.
  const LEAST = { N: 10, m: 0.1, rad: 1, 'N\u00b7m': 1 };

  class Inputs {
    constructor(panel, engine, session) {
      [this.panel, this.engine, this.session] = [panel, engine, session];
      this.list = element('div', 'fields', panel);
      this.note = element('p', 'quiet', panel);
      this.fields = [];
      session.onOpened((opened, how) => this.show(opened, how));
    }

    show(opened, how) {
      const key = opened.inputs.map(({ name, unit }) => `${name} ${unit}`).join('\n');
      if (how.fresh || key !== this.key) this.build(opened.inputs);
      this.key = key;
      opened.inputs.forEach(({ value }, row) => {
        const field = this.fields[row];
        if (field) field.show(how.reset ? field.base : value ?? 0, how.fresh || (how.restarted && !how.reset) ? value ?? 0 : undefined);
      });
    }

    build(inputs) {
      this.list.replaceChildren();
      this.panel.hidden = false;
      this.fields = inputs.slice(0, MOST).map(({ name, unit, kind, value, row }) => {
        const most = Math.max(3 * Math.abs(value || 0), LEAST[unit] || 1);
        return new Field(this.list, {
          name, title: `${name} (${kind.replace(/_/g, ' ')})`, unit, value: value ?? 0, base: value ?? 0, scale: linear(most),
          action: (wanted) => this.drive(row, wanted),
        });
      });
      this.note.hidden = inputs.length > 0 && inputs.length <= MOST;
      this.note.textContent = inputs.length
        ? `The first ${MOST} of ${inputs.length} inputs.`
        : 'This scene has no inputs. An [[input]] in its text makes one; the mouse pulls at any body.';
    }

    drive(row, wanted) {
      const field = this.fields[row];
      const value = wanted === undefined ? field.base : wanted;
      if (wanted === undefined) field.show(value);
      if (this.session.opened.inputs[row]) this.session.opened.inputs[row].value = value;
      this.engine.last(`input ${row}`, { do: 'input', row, value }, (answer) => {
        if (answer.error) this.session.refuse(answer.error, 'input');
      });
    }
  }

  dbd.inputs = { Inputs };
}(window.dbd = window.dbd || {}));
