// The sections of charts: each chart is made when it comes near the screen, and follows the time while it is there.
//
// charts of the runs => figures. Of a comparison the second run's lines lie dashed over the first's.
(function (dbd) {
  'use strict';

  const { element } = dbd.labels;
  const { f32s, f64s, plain } = dbd.numbers;
  const NEAR = '400px 0px';

  // A chart's lines with their values unpacked, when they are needed. Dashed lines have colours of their own, so that
  // both are seen where they lie on each other.
  function unpacked(chart, times, run, dashed) {
    return chart.lines.map((line, i) => ({
      ...line, values: line.still || !line.values ? null : f32s(line.values), times, run, dashed,
      colour: dashed ? i + chart.lines.length : i,
    }));
  }

  const key = (chart) => [chart.section, chart.title, chart.quantity].join('\n');

  // Charts of one run, or of two laid over each other.
  function gathered(runs) {
    const [first, second] = runs;
    const times = runs.map((run) => f64s(run.times));
    const others = new Map(second ? second.charts.map((chart) => [key(chart), chart]) : []);
    const labels = runs.map((run, i) => (second ? run.label || `run ${i + 1}` : ''));
    const both = first.charts.map((chart) => {
      const other = others.get(key(chart));
      others.delete(key(chart));
      return { ...chart, make: () => unpacked(chart, times[0], labels[0], false)
        .concat(other ? unpacked(other, times[1], labels[1], true) : []) };
    });
    for (const chart of others.values()) {
      both.push({ ...chart, make: () => unpacked(chart, times[1], labels[1], true) });
    }
    return both;
  }

  class Sections {
    constructor(data) {
      this.made = new Map();
      this.seen = new Set();
      this.watcher = new IntersectionObserver((entries) => this.watch(entries), { rootMargin: NEAR });
      const [first] = data.runs;
      const charts = gathered(data.runs);
      for (const chart of charts) this.figure(this.section(chart.section), chart);
      if (data.kind === 'compare') this.differences(data);
      for (const run of data.runs) this.notes(run, data.runs.length > 1);
      if (!first || !charts.length) return;
      dbd.clock.onTime((time) => { for (const chart of this.seen) chart.at(time); });
      dbd.theme.onChange(() => { for (const chart of this.made.values()) chart.recolour(); });
    }

    section(id) {
      const section = document.getElementById(id);
      section.hidden = false;
      let grid = section.querySelector('.charts');
      if (!grid) grid = element('div', 'charts', section);
      return grid;
    }

    figure(grid, chart) {
      const figure = element('figure', 'chart', grid);
      const caption = element('figcaption', '', figure);
      element('strong', '', caption).textContent = chart.title || chart.quantity;
      const alone = chart.lines.every((line) => line.still);
      if (alone) {
        figure.classList.add('said');
        element('p', 'words', figure).textContent = dbd.chart.words({ ...chart, lines: chart.make() });
        return;
      }
      figure.dataset.waiting = '';
      figure.make = () => {
        const full = { ...chart, lines: chart.make() };
        delete figure.dataset.waiting;
        // Every line may have stayed still in this run and moved in the other.
        if (full.lines.some((line) => line.values && line.values.length)) {
          this.made.set(figure, new dbd.chart.TimeChart(figure, full));
        }
        const words = dbd.chart.words(full);
        if (words) element('p', 'words', figure).textContent = words;
      };
      this.watcher.observe(figure);
    }

    watch(entries) {
      for (const { target, isIntersecting } of entries) {
        if (isIntersecting && 'waiting' in target.dataset) target.make();
        const chart = this.made.get(target);
        if (!chart) continue;
        if (isIntersecting) {
          this.seen.add(chart);
          chart.at(dbd.clock.time);
        } else {
          this.seen.delete(chart);
        }
      }
    }

    // All charts at once, for paper.
    all() {
      for (const figure of document.querySelectorAll('figure.chart[data-waiting]')) figure.make();
    }

    differences(data) {
      const section = document.getElementById('differences') || this.before('readouts', 'differences', 'Differences');
      section.hidden = false;
      const first = data.firstDifference;
      const [a, b] = data.runs.map((run, i) => run.label || `run ${i + 1}`);
      if (!section.querySelector('p')) {
        const said = element('p', '', section);
        said.textContent = first
          ? `They first differ at t = ${plain(first.time, 9)} s, step ${plain(first.step, 15)}: ${first.text}.`
          : 'The two runs never differ.';
        element('p', 'quiet', section).textContent = `Solid: ${a}. Dashed, and pale on the stage: ${b}.`;
      }
      const times = f64s(data.differenceTimes);
      for (const chart of data.differences || []) {
        this.figure(this.section(section.id), { ...chart, make: () => unpacked(chart, times, '', false) });
      }
    }

    before(id, name, heading) {
      const section = element('section');
      section.id = name;
      element('h2', '', section).textContent = heading;
      document.getElementById(id).before(section);
      return section;
    }

    // What the charts leave out.
    notes(run, several) {
      const said = [];
      const whose = several && run.label ? `${run.label}: ` : '';
      if (run.thinned) {
        said.push(`${whose}charts show ${plain(run.thinned.points, 9)} points of ${plain(run.thinned.samples, 12)} `
          + 'samples, of each interval the lowest and the highest value.');
      }
      if (run.bodiesLeftOut) {
        said.push(`${whose}the ${plain(run.bodiesLeftOut, 9)} bodies that move least have no chart.`);
      }
      if (run.jointsLeftOut) {
        said.push(`${whose}the ${plain(run.jointsLeftOut, 9)} joints that open least have no chart.`);
      }
      if (!said.length || !run.charts.length) return;
      const last = document.getElementById('motion').hidden ? run.charts[run.charts.length - 1].section : 'motion';
      element('p', 'quiet', document.getElementById(last)).textContent = said.join(' ').replace(/^./, (c) => c.toUpperCase());
    }
  }

  dbd.sections = { Sections };
}(window.dbd = window.dbd || {}));
