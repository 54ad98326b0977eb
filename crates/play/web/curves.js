// Live curves: energies, their drift, and outputs that the reader chooses.
//
// frames => the last 1,500 of them as columns => charts; one chart for outputs of a unit.
(function (dbd) {
  'use strict';

  const { element } = dbd.labels;
  const { Plot } = dbd.plot;
  const FRAMES = 1500;
  // [ms] between two drawings.
  const EVERY = 50;
  const FIRST = 4;
  const MOST_LINES = 8;
  // Outputs that the list offers.
  const MOST_OFFERED = 3000;
  // Before the columns of outputs: time, kinetic, potential, total energy, drift, work of the pull, drift without it.
  const OWN = 7;

  class Curves {
    constructor(panel, engine, session) {
      [this.panel, this.engine, this.session] = [panel, engine, session];
      const bar = element('div', 'filter', panel);
      const label = element('label', '', bar);
      element('span', '', label).textContent = 'Output';
      this.select = element('select', '', label);
      this.select.addEventListener('change', () => this.add(this.select.value));
      this.note = element('span', 'quiet', bar);
      this.grid = element('div', 'charts', panel);
      this.columns = Array.from({ length: OWN }, () => []);
      this.names = [];
      this.plots = [];
      this.drawn = 0;
      session.onOpened((opened, how) => this.opened(opened, how));
      engine.onFrame((data) => this.frame(data));
      dbd.theme.onChange(() => { for (const { plot } of this.plots) plot.uplot.redraw(false); });
    }

    opened(opened, how) {
      if (how.reset || how.restarted) this.clear();
      if (how.reset) return;
      const key = opened.outputs.map(({ name, unit }) => `${name} ${unit}`).join('\n');
      if (key !== this.key || how.fresh) {
        this.key = key;
        const known = new Map(opened.outputs.map((output, row) => [output.name, row]));
        const readouts = opened.outputs.slice(opened.readouts).map(({ name }) => name);
        // What was chosen stays as long as the scene is the same.
        const kept = how.fresh ? [] : this.names.filter((name) => known.has(name));
        this.names = kept.length ? kept : readouts.slice(0, FIRST);
        this.rows = known;
        this.offer(opened);
        this.clear();
      }
      this.watch(how.restarted);
    }

    offer({ outputs, readouts }) {
      const groups = [['Read-outs', outputs.slice(readouts)], ['Other outputs', outputs.slice(0, readouts)]];
      const first = new Option('Add a curve \u2026', '');
      this.select.replaceChildren(first, ...groups.filter(([, list]) => list.length).map(([title, list]) => {
        const group = document.createElement('optgroup');
        group.label = title;
        for (const { name, unit, description } of list.slice(0, MOST_OFFERED)) {
          const option = new Option(unit && unit !== '1' ? `${name} [${unit}]` : name, name);
          option.title = description;
          group.append(option);
        }
        return group;
      }));
      const left = outputs.length - MOST_OFFERED;
      this.note.textContent = left > 0 ? `${left} outputs are not listed.` : '';
    }

    add(name) {
      this.select.value = '';
      if (!name || this.names.includes(name)) return;
      this.names.push(name);
      this.watch();
    }

    drop(name) {
      this.names = this.names.filter((one) => one !== name);
      this.watch();
    }

    // Has the module send what is chosen, in this order, and makes the charts of it.
    watch(anew) {
      const { outputs } = this.session.opened;
      const { layout } = this.engine;
      const rows = this.names.map((name) => this.rows.get(name));
      const sent = rows.join(' ');
      if (anew || sent !== this.sent || layout.length - layout.watched !== rows.length) {
        this.sent = sent;
        this.engine.last('watch', { do: 'watch', rows }, (answer) => {
          if (answer.error) this.session.refuse(answer.error, 'watch');
        });
      }
      const key = this.names.join('\n');
      if (key === this.watched && this.plots.length) return;
      const old = new Map((this.watched || '').split('\n').map((name, i) => [name, this.columns[OWN + i]]));
      const times = this.columns[0];
      this.columns.length = OWN;
      for (const name of this.names) this.columns.push(old.get(name) || times.map(() => null));
      this.watched = key;
      this.charts(outputs, rows);
    }

    charts(outputs, rows) {
      for (const { plot } of this.plots) plot.remove();
      const make = (chart, columns) => ({ plot: new Plot(this.grid, chart), columns });
      const energy = (name) => ({ name });
      this.plots = [
        make({ title: 'Energy', quantity: 'energy', unit: 'J', lines: ['kinetic', 'potential', 'total'].map(energy) }, [1, 2, 3]),
        make({
          title: 'Energy drift', quantity: 'drift', unit: 'J',
          lines: [{ name: 'drift' }, { name: 'work of the pull', rare: true }, { name: 'drift without it', rare: true }],
        }, [4, 5, 6]),
      ];
      const units = new Map();
      rows.forEach((row, i) => {
        const { unit } = outputs[row];
        const lists = units.get(unit) || [[]];
        if (lists[lists.length - 1].length >= MOST_LINES) lists.push([]);
        lists[lists.length - 1].push(i);
        units.set(unit, lists);
      });
      for (const [unit, lists] of units) {
        for (const list of lists) {
          const lines = list.map((i) => ({ name: this.names[i], remove: () => this.drop(this.names[i]) }));
          this.plots.push(make({ title: title(unit), quantity: quantity(unit), unit, lines }, list.map((i) => OWN + i)));
        }
      }
      this.draw(true);
    }

    frame({ frame, preview, playing }) {
      if (preview) return;
      const { columns } = this;
      const { watched } = this.engine.layout;
      const [time, , , kinetic, potential, total] = frame;
      const times = columns[0];
      // Time was taken back: what came later never was.
      while (times.length && times[times.length - 1] >= time) for (const column of columns) column.pop();
      const finite = (value) => (Number.isFinite(value) ? value : null);
      const [start, work] = [frame[8], frame[9]];
      const drift = total - start;
      const own = [time, kinetic, potential, total, drift, work, work ? drift - work : 0];
      const outputs = columns.length - OWN === frame.length - watched ? Array.from(frame.subarray(watched)) : [];
      columns.forEach((column, i) => {
        column.push(finite(i < OWN ? own[i] : outputs[i - OWN]));
        if (column.length > FRAMES) column.shift();
      });
      this.draw(!playing);
    }

    draw(now) {
      if (!now && performance.now() - this.drawn < EVERY) return;
      this.drawn = performance.now();
      for (const { plot, columns } of this.plots) plot.show(this.columns[0], columns.map((i) => this.columns[i]));
    }

    clear() { for (const column of this.columns) column.length = 0; }
  }

  const QUANTITIES = {
    m: 'length', 'm/s': 'velocity', 'm/s\u00b2': 'acceleration', rad: 'angle', 'rad/s': 'angular velocity', N: 'force',
    'N\u00b7m': 'torque', J: 'energy', W: 'power', s: 'time', 'kg\u00b7m/s': 'momentum', 1: 'number',
  };

  function quantity(unit) { return QUANTITIES[unit] || 'value'; }

  function title(unit) { return quantity(unit).replace(/^./, (first) => first.toUpperCase()); }

  dbd.curves = { Curves };
}(window.dbd = window.dbd || {}));
