// The scene's text in an editor, applied while one types.
//
// text => change of the run, or an underline with what is wrong and what helps.
(function (dbd) {
  'use strict';

  const C = window.CodeMirror;
  const { element, button } = dbd.labels;
  const { sentence } = dbd.session;
  // [ms] after the last key.
  const PAUSE = 300;
  // Longer texts would make typing slow.
  const MOST_SHOWN = 1e6;

  const { tags } = C;
  const colours = C.HighlightStyle.define([
    { tag: [tags.propertyName, tags.definition(tags.propertyName), tags.keyword], color: 'var(--accent)' },
    { tag: [tags.string], color: 'var(--code-string)' },
    { tag: [tags.number, tags.atom, tags.bool], color: 'var(--code-number)' },
    { tag: [tags.comment], color: 'var(--quiet)', fontStyle: 'italic' },
    { tag: [tags.bracket], color: 'var(--ink)' },
  ]);

  class Editor {
    constructor(panel, session) {
      this.session = session;
      this.bar = element('div', 'filter', panel);
      this.file = element('code', '', this.bar);
      this.revert = button(this.bar, 'The scene\u2019s own text again', 'Revert', () => this.put(this.original, true));
      const open = button(this.bar, 'Open a scene file', 'Open file\u2026', () => this.choose.click());
      this.choose = element('input', '', this.bar);
      Object.assign(this.choose, { type: 'file', accept: '.toml', hidden: true });
      this.choose.setAttribute('aria-label', open.title);
      this.choose.addEventListener('change', () => this.load());
      this.status = element('p', 'text-status', panel);
      this.status.setAttribute('role', 'status');
      this.box = element('div', 'editor', panel);
      this.note = element('p', 'quiet', panel);
      this.note.hidden = true;
      this.original = '';
      this.text = '';
      session.onOpened((opened, how) => this.opened(how));
      session.onRefused((error, what) => this.refused(error, what));
    }

    make() {
      const listen = C.EditorView.updateListener.of((update) => {
        if (update.docChanged && !this.putting) this.typed();
      });
      const label = C.EditorView.contentAttributes.of({ 'aria-label': 'Text of the scene', spellcheck: 'false', autocapitalize: 'off' });
      this.extensions = [
        C.lintGutter(), C.lineNumbers(), C.highlightSpecialChars(), C.history(), C.drawSelection(), C.bracketMatching(),
        C.highlightActiveLine(), C.highlightActiveLineGutter(), C.search({ top: true }), C.highlightSelectionMatches(),
        C.StreamLanguage.define(C.toml), C.syntaxHighlighting(colours), listen, label,
        C.keymap.of([...C.searchKeymap, ...C.historyKeymap, ...C.defaultKeymap]),
      ];
      this.view = new C.EditorView({ parent: this.box });
    }

    // Another scene: its text without what was typed before.
    scene(file, text, original) {
      this.original = original;
      this.file.textContent = file;
      this.name = file;
      this.put(text, false);
    }

    put(text, apply) {
      clearTimeout(this.timer);
      this.timer = null;
      this.text = text;
      const long = text.length > MOST_SHOWN;
      this.box.hidden = long;
      this.note.hidden = !long;
      if (long) {
        this.note.textContent = `The text of ${dbd.numbers.plain(text.length / 1e6, 3)} MB is too long to be edited here.`;
      } else {
        if (!this.view) this.make();
        this.putting = true;
        this.view.setState(C.EditorState.create({ doc: text, extensions: this.extensions }));
        this.putting = false;
      }
      this.buttons();
      if (!apply) return;
      this.timer = -1;
      this.apply();
    }

    typed() {
      this.text = this.view.state.doc.toString();
      this.buttons();
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.apply(), PAUSE);
    }

    buttons() { this.revert.disabled = this.text === this.original; }

    apply() {
      // The text of a scene that was refused when it was chosen: it has never run.
      if (this.name !== this.session.asked.file) this.session.open({ file: this.name, text: this.text });
      else this.session.edit(this.text);
    }

    async load() {
      const [file] = this.choose.files;
      this.choose.value = '';
      if (file && this.onFile) this.onFile(file.name, await file.text());
    }

    // What runs now: text that was taken back by a rewind is shown, text that waits for a mended number is tried again.
    opened(how) {
      const { text } = this.session.asked;
      if (how.reset || this.name === undefined) return;
      if (text !== this.text) {
        if (this.bad && this.retry && !how.back) this.apply();
        else if (!this.timer && !this.bad) this.put(text, false);
        return;
      }
      const typed = this.timer || this.bad;
      this.timer = null;
      this.bad = false;
      this.mark([]);
      this.say(typed && !how.fresh ? 'Applied.' : '', false);
    }

    refused(error, what) {
      if (!error || what !== 'text') return;
      this.timer = null;
      this.bad = true;
      // What is wrong has no line: a number that was changed may be in the way.
      this.retry = !error.line;
      this.say(sentence(error, this.name), true);
      if (this.view && !this.box.hidden) this.mark([this.diagnostic(error)]);
    }

    say(text, bad) {
      this.status.textContent = text;
      this.status.classList.toggle('bad', bad);
    }

    mark(diagnostics) {
      if (this.view) this.view.dispatch(C.setDiagnostics(this.view.state, diagnostics));
    }

    // From the column to the end of the word or line.
    diagnostic({ message, help, line, column }) {
      const { doc } = this.view.state;
      const row = doc.line(Math.min(Math.max(line || 1, 1), doc.lines));
      // Columns count characters; the editor counts UTF-16 units.
      const before = [...row.text].slice(0, Math.max((column || 1) - 1, 0)).join('').length;
      const from = Math.min(row.from + (column ? before : 0), row.to);
      const word = column ? /^[^\s,\]=}]+/.exec(row.text.slice(from - row.from)) : null;
      const to = word ? from + word[0].length : row.to;
      const said = help ? `${message}\n${help}` : message;
      return { from: to > from ? from : row.from, to: Math.max(to, from), severity: 'error', message: said };
    }
  }

  dbd.editor = { Editor };
}(window.dbd = window.dbd || {}));
