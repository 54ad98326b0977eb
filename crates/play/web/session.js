// What is open: the scene, its settings and changed numbers, and everyone who shows them.
//
// open, edit, set, choose => module's description; listeners. A refused change leaves everything as it was.
(function (dbd) {
  'use strict';

  const MOST_TEXT = 10e6;

  class Session {
    constructor(engine) {
      this.engine = engine;
      this.opened = null;
      // What the module runs, and what the page asks for.
      this.asked = { file: '', text: '', settings: {}, set: {} };
      this.wanted = { settings: {}, set: {} };
      // Values of the scene's numbers by path, without changes.
      this.base = new Map();
      this.error = null;
      this.opening = [];
      this.refusing = [];
    }

    // listener(opened, {fresh: another scene, restarted, why, ahead})
    onOpened(listener) { this.opening.push(listener); }

    // listener(error, 'text' | 'set' | 'settings'); null where the last one is settled.
    onRefused(listener) { this.refusing.push(listener); }

    // Opens a scene at t = 0. {file, text}, settings, set => error or null
    async open({ file, text }, settings, set) {
      const asked = { file, text, settings: settings || this.asked.settings, set: set || {} };
      const refused = tooLong(text);
      if (refused) return this.refuse(refused, 'text');
      this.pending = null;
      // The values of the scene itself are those before any change.
      if (Object.keys(asked.set).length) {
        const plain = await this.engine.send({ do: 'open', ...asked, set: {} });
        if (!plain.error) this.note(plain, true);
      }
      const answer = await this.engine.send({ do: 'open', ...asked });
      if (answer.error) return this.refuse(answer.error, 'text');
      this.asked = asked;
      this.take(answer, { fresh: true, restarted: true, ahead: answer.ahead });
      return null;
    }

    edit(text) {
      const refused = tooLong(text);
      if (refused) this.refuse(refused, 'text');
      else this.change({ text });
    }

    set(path, value) {
      const set = { ...this.wanted.set };
      if (value === undefined) delete set[path];
      else set[path] = value;
      this.change({ set });
    }

    choose(settings) {
      const all = { ...this.wanted.settings, ...settings };
      for (const [name, value] of Object.entries(all)) if (value === undefined || value === null) delete all[name];
      this.change({ settings: all });
    }

    change(part) {
      Object.assign(this.wanted, part);
      this.pending = { ...this.pending, ...part };
      let sent = null;
      const request = () => {
        sent = this.pending || {};
        this.pending = null;
        return { do: 'change', ...sent };
      };
      this.engine.last('change', request, (answer) => this.changed(sent, answer));
    }

    changed(sent, answer) {
      const what = 'text' in sent ? 'text' : Object.keys(sent)[0];
      if (answer.error) {
        // Later wishes are still on their way; what was refused is taken back.
        if (!this.pending) Object.assign(this.wanted, { settings: this.asked.settings, set: this.asked.set });
        this.refuse(answer.error, what);
        return;
      }
      Object.assign(this.asked, sent);
      this.take(answer, { fresh: false, restarted: answer.restarted, why: answer.why });
    }

    // Shows what the module says it runs.
    take(opened, how) {
      if (how.fresh && !Object.keys(opened.set).length) this.base.clear();
      this.note(opened, false);
      this.opened = opened;
      this.asked.set = opened.set;
      if (!this.pending) Object.assign(this.wanted, { settings: this.asked.settings, set: this.asked.set });
      this.error = null;
      this.tell(opened, how);
      for (const listener of this.refusing) listener(null, null);
    }

    tell(opened, how) { for (const listener of this.opening) listener(opened, how); }

    note(opened, anew) {
      if (anew) this.base.clear();
      for (const { path, value } of [...opened.parameters, ...opened.numbers]) {
        if (!(path in opened.set)) this.base.set(path, value);
      }
    }

    // Takes time back to a mark or a snapshot; the answer's description holds for what was kept.
    async back(request) {
      const answer = await this.engine.send(request);
      if (answer.error) return answer;
      const { text } = await this.engine.send({ do: 'scene' });
      if (text !== undefined) this.asked.text = text;
      this.asked.settings = settingsOf(this.asked.settings, answer.opened);
      const opened = { ...answer.opened, set: answer.set };
      opened.inputs.forEach((input, row) => { if (row in answer.inputs) input.value = answer.inputs[row]; });
      this.take(opened, { fresh: false, restarted: false, back: true });
      return answer;
    }

    async reset() {
      const answer = await this.engine.send({ do: 'reset' });
      if (!answer.error) this.tell(this.opened, { fresh: false, restarted: true, reset: true });
      return answer;
    }

    refuse(error, what) {
      const said = what === 'text' ? error : placeless(error);
      this.error = said;
      for (const listener of this.refusing) listener(said, what);
      return said;
    }
  }

  // Settings that were chosen on the page follow what was kept.
  function settingsOf(settings, opened) {
    const known = { scheme: opened.scheme, damping: opened.damping, precision: opened.precision, step: opened.step };
    return Object.fromEntries(Object.entries(settings).map(([name, value]) => [name, known[name] ?? value]));
  }

  function tooLong(text) {
    if (text.length <= MOST_TEXT) return null;
    return {
      message: `a text of ${dbd.numbers.plain(text.length / 1e6, 3)} MB is more than the page takes`,
      help: 'at most 10 MB; host-sim run takes more', line: null, column: null,
    };
  }

  // A number's or a setting's error has no place in the text.
  const placeless = (error) => ({ ...error, line: null, column: null });

  // An error in one sentence: "file:line:column: message; help".
  function sentence(error, file) {
    const place = [file, error.line, error.column].filter((part) => part !== null && part !== undefined && part !== '');
    const where = error.line ? `${place.join(':')}: ` : '';
    return where + error.message + (error.help ? `; ${error.help}` : '');
  }

  dbd.session = { Session, sentence };
}(window.dbd = window.dbd || {}));
