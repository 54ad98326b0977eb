// The page: reads its data and sets up what there is to see of them.
//
// data => stage, controls, charts, modes. `dbd.ready` says that all of it stands.
(function (dbd) {
  'use strict';

  const { element } = dbd.labels;

  // The stage keeps in sight on narrow screens: small at the top once the reader has scrolled past it.
  function follow(section, stage) {
    const place = element('div', 'stage-place');
    section.before(place);
    place.append(section);
    const read = element('div', 'read');
    while (place.nextSibling) read.append(place.nextSibling);
    place.after(read);
    place.parentElement.classList.add('columns');
    // Beside the charts it is as high as the window lets it be below the title.
    const measure = () => {
      const { bottom } = place.previousElementSibling.getBoundingClientRect();
      document.documentElement.style.setProperty('--head', Math.min(bottom + window.scrollY, 260) + 'px');
    };
    measure();
    window.addEventListener('resize', measure);
    const close = dbd.controls.button(stage.view, 'Close the small picture', '\u00d7', () => { hide(true); });
    close.className = 'close';
    let closed = false;
    const hide = (now) => {
      closed = now;
      document.documentElement.classList.remove('mini');
      place.style.minHeight = '';
    };
    new IntersectionObserver(([entry]) => {
      const passed = !entry.isIntersecting && entry.boundingClientRect.bottom < 80;
      if (entry.isIntersecting) closed = false;
      if (passed && !closed && !document.documentElement.classList.contains('mini')) {
        place.style.minHeight = place.offsetHeight + 'px';
        document.documentElement.classList.add('mini');
      } else if (!passed) {
        hide(closed);
      }
    }, { threshold: [0, 0.01, 0.1], rootMargin: '-60px 0px 0px 0px' }).observe(place);
  }

  function stage(data) {
    const section = document.getElementById('stage');
    const runs = data.runs.filter((run) => run.mechanism);
    if (!runs.length) {
      section.hidden = true;
      return null;
    }
    const made = new dbd.stage.Stage(section, runs);
    if (!made.works) {
      const said = element('p', 'quiet');
      said.textContent = 'This browser shows no WebGL, so the mechanism stands still at t = 0; the charts below move.';
      section.append(said);
      return null;
    }
    section.querySelectorAll('.still').forEach((still) => { still.hidden = true; });
    new dbd.controls.Controls(section, made);
    follow(section, made);
    return made;
  }

  function range(runs) {
    const times = runs.flatMap((run) => [run.film && run.film.times, run.times])
      .filter(Boolean).map(dbd.numbers.f64s).filter((list) => list.length);
    if (!times.length) return;
    dbd.clock.range(Math.min(...times.map((list) => list[0])), Math.max(...times.map((list) => list[list.length - 1])));
  }

  function start() {
    const data = JSON.parse(document.getElementById('report').textContent);
    if (!data || data.format !== 1) throw new Error('This page holds data of a format that it cannot read.');
    document.documentElement.classList.add('alive');
    const header = document.querySelector('header');
    const title = element('div', 'title');
    title.append(...header.childNodes);
    header.append(dbd.theme.button(), title);
    range(data.runs);
    dbd.page = { stage: stage(data), sections: new dbd.sections.Sections(data) };
    if (dbd.page.stage && data.modes && data.modes.length) dbd.page.modes = new dbd.modes.Modes(dbd.page.stage, data.modes);
    window.addEventListener('beforeprint', () => dbd.page.sections.all());
    const calm = window.matchMedia('(prefers-reduced-motion: reduce)').matches;
    if (dbd.page.stage && !calm) dbd.clock.play();
    dbd.ready = true;
  }

  start();
}(window.dbd = window.dbd || {}));
