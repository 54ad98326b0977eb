// One live chart: lines over the last frames, with their present values.
//
// {title, quantity, unit, lines} and columns of numbers => uPlot.
(function (dbd) {
  'use strict';

  const { element } = dbd.labels;
  const { scale, plain, onAxis } = dbd.numbers;
  const FONT = '12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif';
  const COLOURS = ['--accent', '--accent-2', '--accent-3', '--accent-4', '--accent-5', '--accent-6', '--accent-7', '--accent-8'];

  // The range of a value that never changed.
  const around = (value) => [value - (0.1 * Math.abs(value) || 1), value + (0.1 * Math.abs(value) || 1)];

  class Plot {
    // chart: {title, quantity, unit, lines: [{name, rare, remove()}]}
    constructor(parent, chart) {
      this.chart = chart;
      this.figure = element('figure', 'chart', parent);
      const caption = element('figcaption', '', this.figure);
      element('strong', '', caption).textContent = chart.title;
      const row = element('div', 'legend-row', this.figure);
      this.items = [];
      this.values = chart.lines.map((line, i) => {
        const item = element('span', 'key', row);
        element('i', '', item).style.setProperty('--line', `var(${COLOURS[i % COLOURS.length]})`);
        if (line.name) element('span', '', item).textContent = line.name;
        this.items.push(item);
        const value = element('b', '', item);
        if (line.remove) dbd.labels.button(item, `Remove ${line.name}`, '\u00d7', line.remove).classList.add('remove');
        return value;
      });
      this.box = element('div', 'plot', this.figure);
      this.box.setAttribute('role', 'img');
      this.box.setAttribute('aria-label', `${chart.title}: ${chart.quantity} over time`);
      this.scale = scale(chart.unit, 1);
      this.uplot = new window.uPlot(this.options(), [[], ...chart.lines.map(() => [])], this.box);
      this.seen = true;
      this.observer = new ResizeObserver(() => this.resize());
      this.observer.observe(this.box);
      this.watcher = new IntersectionObserver((entries) => {
        this.seen = entries[entries.length - 1].isIntersecting;
        if (this.seen && this.missed) this.show(...this.missed);
      });
      this.watcher.observe(this.box);
    }

    options() {
      const quiet = () => dbd.theme.colour('--quiet');
      const rule = () => dbd.theme.colour('--rule');
      const axis = { stroke: quiet, font: FONT, labelFont: FONT, grid: { stroke: rule, width: 1 },
        ticks: { stroke: rule, width: 1, size: 4 }, labelSize: 18, gap: 4 };
      return {
        width: Math.max(this.box.clientWidth, 160), height: this.height(), legend: { show: false }, padding: [8, 14, 0, 0],
        cursor: { y: false, points: { size: 7 }, drag: { x: false, y: false } },
        scales: {
          x: { time: false, range: (u, low, high) => (high > low ? [low, high] : [low || 0, (low || 0) + 1]) },
          y: { range: (u, low, high) => (high > low ? window.uPlot.rangeNum(low, high, 0.1, true) : around(low || 0)) },
        },
        axes: [
          { ...axis, label: 'time [s]', size: 28, space: 60, values: (u, ticks) => ticks.map((tick) => plain(tick, 6)) },
          { ...axis, label: this.label(), size: 54, space: 28,
            values: (u, ticks) => ticks.map((tick) => plain(Number((tick * this.scale.factor).toPrecision(12)), 5)) },
        ],
        series: [{}].concat(this.chart.lines.map((_, i) => ({
          stroke: () => dbd.theme.colour(COLOURS[i % COLOURS.length]), width: 1.6, points: { show: false }, spanGaps: false,
        }))),
        hooks: { setCursor: [() => this.legend()] },
      };
    }

    label() { return this.chart.quantity + (this.scale.unit ? ` [${this.scale.unit}]` : ''); }

    height() { return this.chart.height || 140; }

    resize() {
      const width = Math.max(this.box.clientWidth, 160);
      if (this.box.clientWidth && width !== this.uplot.width) this.uplot.setSize({ width, height: this.height() });
    }

    // Shows columns: times, and values of each line.
    show(times, columns) {
      // What nobody sees is drawn when it comes into sight.
      this.missed = this.seen && this.box.clientWidth ? null : [times, columns];
      if (this.missed) return;
      let most = 0;
      for (const value of columns.flat()) if (Math.abs(value) > most && Number.isFinite(value)) most = Math.abs(value);
      this.most = most;
      this.scale = scale(this.chart.unit, most);
      this.uplot.axes[1].label = this.label();
      // What is zero in most runs is left out until it is not.
      this.chart.lines.forEach(({ rare }, i) => {
        const shown = !rare || columns[i].some(Boolean);
        this.items[i].hidden = !shown;
        this.uplot.series[i + 1].show = shown;
      });
      this.uplot.setData([times, ...columns]);
      this.legend();
    }

    // The values under the pointer, else the latest.
    legend() {
      const { data, cursor } = this.uplot;
      if (!data) return;
      const at = cursor.idx ?? data[0].length - 1;
      this.values.forEach((value, i) => {
        const text = at >= 0 ? onAxis(data[i + 1][at] ?? NaN, this.scale, this.most || 1) : '';
        if (value.textContent !== text) value.textContent = text;
      });
    }

    remove() {
      this.observer.disconnect();
      this.watcher.disconnect();
      this.uplot.destroy();
      this.figure.remove();
    }
  }

  dbd.plot = { Plot };
}(window.dbd = window.dbd || {}));
