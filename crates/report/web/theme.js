// Light and dark: what the reader's screen asks for, or what the reader chose on this page.
//
// choice => data-theme of the root; listeners draw again in the new colours.
(function (dbd) {
  'use strict';

  const KEY = 'dbd-report-theme';
  const listeners = [];
  const screen = window.matchMedia('(prefers-color-scheme: dark)');

  // A page opened from a file may have no storage; the choice then lasts as long as the page.
  function stored() {
    try { return localStorage.getItem(KEY); } catch (_) { return null; }
  }

  function store(choice) {
    try { localStorage.setItem(KEY, choice); } catch (_) { /* not kept */ }
  }

  function dark() {
    const chosen = document.documentElement.dataset.theme;
    return chosen ? chosen === 'dark' : screen.matches;
  }

  function tell() { for (const listener of listeners) listener(); }

  function choose(choice) {
    document.documentElement.dataset.theme = choice;
    store(choice);
    tell();
  }

  // A colour of the style sheets, as the page shows it now.
  function colour(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  }

  function button() {
    const made = document.createElement('button');
    made.type = 'button';
    made.className = 'theme-toggle';
    const show = () => {
      made.textContent = dark() ? 'Light' : 'Dark';
      made.title = dark() ? 'Light colours' : 'Dark colours';
      made.setAttribute('aria-label', made.title);
    };
    made.addEventListener('click', () => choose(dark() ? 'light' : 'dark'));
    listeners.unshift(show);
    show();
    return made;
  }

  const kept = stored();
  if (kept === 'light' || kept === 'dark') document.documentElement.dataset.theme = kept;
  screen.addEventListener('change', tell);

  dbd.theme = { dark, colour, choose, button, onChange: (listener) => listeners.push(listener) };
}(window.dbd = window.dbd || {}));
