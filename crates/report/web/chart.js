// One chart: lines over time in axes that carry quantity and unit, with their values at the shared time.
//
// (times, lines) => uPlot. Pointing at a chart sets the time of the page; dragging shows a part of it in all charts.
(function (dbd) {
  'use strict';

  const { element } = dbd.labels;
  const { scale, plain, withUnit, onAxis, time: timeText } = dbd.numbers;
  const COLOURS = ['--accent', '--accent-2', '--accent-3', '--accent-4', '--accent-5', '--accent-6', '--accent-7', '--accent-8'];
  const colour = (line) => dbd.theme.colour(COLOURS[line.colour % COLOURS.length]);
  const FONT = '12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif';

  // Letters are about so many times narrower than high: what an axis is called fits beside it.
  const LABEL = 1.9;

  // The part of time that all charts show; null for all of it.
  const zoom = { range: null, charts: new Set() };

  function show(range) {
    zoom.range = range;
    for (const chart of zoom.charts) chart.rescale();
  }

  // Values as uPlot takes them: what is not finite is a gap.
  function gaps(values) {
    return values.every(Number.isFinite) ? values : Array.from(values, (value) => (Number.isFinite(value) ? value : null));
  }

  // What the vertical axis shows.
  function axisLabel(chart, drawn) {
    const [{ name: first } = {}] = drawn;
    const name = first && drawn.every((line) => line.name === first) ? first : chart.quantity;
    const moved = drawn.length > 0 && drawn.every((line) => line.deviation);
    return moved ? fromStart(name) : chart.quantity;
  }

  // What a deviation from t = 0 is called: short where the name is long.
  function fromStart(name) {
    return name.includes(' ') ? `change of ${name}` : `${name} \u2212 ${name}(0)`;
  }

  class TimeChart {
    // chart: {title, quantity, unit, lines: [{name, values, times, colour, dashed, deviation, still, initial}]}
    constructor(figure, chart) {
      this.figure = figure;
      this.chart = chart;
      this.drawn = chart.lines.filter((line) => line.values && line.values.length);
      const tables = new Map();
      for (const line of this.drawn) {
        if (!tables.has(line.times)) tables.set(line.times, []);
        tables.get(line.times).push(line);
      }
      this.drawn = [...tables.values()].flat();
      const joined = [...tables].map(([times, lines]) => [times, ...lines.map((line) => gaps(line.values))]);
      this.data = joined.length > 1 ? uPlot.join(joined) : joined[0];
      let largest = 0;
      for (const { low, high } of this.drawn) largest = Math.max(largest, Math.abs(low) || 0, Math.abs(high) || 0);
      this.largest = largest;
      this.scale = scale(chart.unit, largest);
      this.legend();
      this.plot = element('div', 'plot', figure);
      this.plot.setAttribute('role', 'img');
      this.plot.setAttribute('aria-label', `${chart.title}: ${chart.quantity} over time`);
      this.uplot = new uPlot(this.options(), this.data, this.plot);
      this.point();
      this.at(dbd.clock.time);
      zoom.charts.add(this);
      this.rescale();
      new ResizeObserver(() => this.resize()).observe(this.plot);
    }

    options() {
      const quiet = () => dbd.theme.colour('--quiet');
      const rule = () => dbd.theme.colour('--rule');
      const axis = { stroke: quiet, font: FONT, labelFont: FONT, grid: { stroke: rule, width: 1 },
        ticks: { stroke: rule, width: 1, size: 4 }, labelSize: 20, gap: 4 };
      const unit = this.scale.unit ? ` [${this.scale.unit}]` : '';
      const label = axisLabel(this.chart, this.drawn) + unit;
      const small = Math.min(12, (LABEL * (this.height() - 50)) / label.length);
      return {
        width: this.width(), height: this.height(), legend: { show: false }, padding: [8, 10, 0, 0],
        cursor: {
          y: false, points: { size: 7 }, drag: { x: true, y: false, setScale: false },
          bind: { dblclick: () => () => show(null), mouseleave: () => null },
        },
        scales: { x: { time: false, range: (u, low, high) => zoom.range || [low, high] } },
        axes: [
          { ...axis, label: 'time [s]', size: 30, space: 60, values: (u, ticks) => ticks.map((tick) => plain(tick, 5)) },
          { ...axis, label, labelFont: FONT.replace('12px', small.toFixed(1) + 'px'), size: 52, space: 32,
            values: (u, ticks) => ticks.map((tick) => plain(tick * this.scale.factor, 5)) },
        ],
        series: [{}].concat(this.drawn.map((line) => ({
          stroke: () => colour(line), width: line.dashed ? 1.6 : 1.8, dash: line.dashed ? [7, 5] : undefined,
          spanGaps: true, points: { show: false },
        }))),
        hooks: { setSelect: [(u) => this.selected(u)] },
      };
    }

    width() { return Math.max(this.plot.clientWidth, 200); }

    height() { return window.innerWidth < 640 ? 190 : 220; }

    resize() {
      const [width, height] = [this.width(), this.height()];
      if (width !== this.uplot.width || height !== this.uplot.height) this.uplot.setSize({ width, height });
      this.at(dbd.clock.time);
    }

    selected(u) {
      const { left, width } = u.select;
      if (width < 4) return;
      const range = [left, left + width].map((at) => u.posToVal(at, 'x'));
      u.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
      show(range);
    }

    rescale() {
      const times = this.data[0];
      const [min, max] = zoom.range || [times[0], times[times.length - 1]];
      this.uplot.setScale('x', { min, max });
      this.at(dbd.clock.time);
    }

    // Pointing: mouse, pen and one finger alike. What plays stands still meanwhile.
    point() {
      const { over } = this.uplot;
      let resumes = false;
      const look = (event) => {
        // A page that scrolls below a mouse at rest is no pointing.
        if (event.type === 'pointermove' && event.pointerType === 'mouse' && !event.movementX && !event.movementY) return;
        if (dbd.clock.playing) {
          dbd.clock.pause();
          resumes = true;
        }
        dbd.clock.set(this.uplot.posToVal(event.clientX - over.getBoundingClientRect().left, 'x'));
      };
      over.addEventListener('pointermove', look);
      over.addEventListener('pointerdown', look);
      over.addEventListener('pointerleave', () => {
        if (resumes) dbd.clock.play();
        resumes = false;
      });
    }

    legend() {
      const row = element('div', 'legend-row', this.figure);
      this.when = element('span', 'when', row);
      this.values = this.drawn.map((line) => {
        const item = element('span', 'key', row);
        const mark = element('i', line.dashed ? 'dashed' : '', item);
        mark.style.setProperty('--line', `var(${COLOURS[line.colour % COLOURS.length]})`);
        const name = line.name || (this.drawn.length > 1 ? this.chart.quantity : '');
        if (name) element('span', '', item).textContent = line.deviation ? fromStart(name) : name;
        return element('b', '', item);
      });
    }

    // Shows a time: the cursor, and the values there.
    at(time) {
      const u = this.uplot;
      const left = u.valToPos(time, 'x');
      const within = left >= -0.5 && left <= u.over.clientWidth + 0.5;
      u.setCursor({ left: within ? left : -10, top: within ? 1 : -10 }, false);
      const times = this.data[0];
      const spacing = times.length > 1 ? (times[times.length - 1] - times[0]) / (times.length - 1) : 0;
      this.when.textContent = timeText(time, spacing);
      this.drawn.forEach((line, i) => {
        this.values[i].textContent = onAxis(valueAt(line, time), this.scale, this.largest);
      });
    }

    recolour() { this.uplot.redraw(false); }
  }

  // A line's value at the sample nearest to a time, where its bead is.
  function valueAt({ times, values }, time) {
    const [row, share] = dbd.film.between(times, time);
    return values[share > 0.5 ? row + 1 : row];
  }

  // What a chart says in words: what never moved, and where its deviations start. Two runs that say the same say it once.
  function words(chart) {
    const runs = new Set(chart.lines.map((line) => line.run));
    const sizes = chart.lines.flatMap(({ initial, low, high }) => [initial, low, high].map((value) => Math.abs(value) || 0));
    // What is nothing beside the rest is called nothing.
    const value = ({ initial }) => withUnit(Math.abs(initial) < 1e-9 * Math.max(...sizes) ? 0 : initial, chart.unit, 5);
    const listed = (lines, verb) => {
      const of = new Map();
      for (const line of lines) {
        const text = `${line.name || chart.quantity} ${verb} ${value(line)}`;
        of.set(text, [...(of.get(text) || []), line.run]);
      }
      return [...of].map(([text, by]) => (by.length === runs.size ? text : `${text} (${by.join(', ')})`)).join(', ');
    };
    const still = listed(chart.lines.filter((line) => line.still), 'stays at');
    const moved = listed(chart.lines.filter((line) => line.deviation && !line.still), '=');
    return [still && `${still}.`, moved && `At t = 0: ${moved}.`].filter(Boolean).join(' ');
  }

  dbd.chart = { TimeChart, words, charts: zoom.charts, zoom: show };
}(window.dbd = window.dbd || {}));
