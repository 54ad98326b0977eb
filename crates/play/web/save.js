// What can be taken away: the scene's text, the inputs as tables, a trace, a snapshot.
//
// buttons => files; a snapshot file => state.
(function (dbd) {
  'use strict';

  const { element, button } = dbd.labels;

  // Gives the reader a file.
  function download(name, blob) {
    const link = element('a');
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }

  const text = (content) => new Blob([content], { type: 'text/plain' });

  function unpacked(base64) { return new Blob([dbd.numbers.bytes(base64)], { type: 'application/octet-stream' }); }

  async function packed(file) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    let raw = '';
    for (let i = 0; i < bytes.length; i += 8192) raw += String.fromCharCode(...bytes.subarray(i, i + 8192));
    return btoa(raw);
  }

  class Save {
    constructor(panel, engine, session, say) {
      Object.assign(this, { engine, session, say, recording: false });
      const row = (title, note) => {
        const box = element('div', 'save', panel);
        const words = element('div', '', box);
        element('strong', '', words).textContent = title;
        element('p', 'quiet', words).textContent = note;
        return [element('span', 'buttons', box), words.lastChild];
      };
      const [trace, traceNote] = row('Trace', 'All outputs at each frame that is shown, as CSV, from the press of Record on.');
      this.record = button(trace, 'Record a trace', 'Record', () => this.toggle());
      this.record.setAttribute('aria-pressed', false);
      this.trace = button(trace, 'Download the trace as CSV', 'CSV', () => this.csv());
      this.trace.disabled = true;
      [this.traceNote, this.traceText] = [traceNote, traceNote.textContent];
      const [inputs] = row('Inputs', 'The scene with tables of what the inputs were set to: host-sim runs it again.');
      button(inputs, 'Download the scene with tables of the inputs', 'TOML', () => this.table());
      const [state, stateNote] = row('Snapshot', 'The state, bit for bit. Firmware, Python and this page go on from it.');
      this.stateNote = stateNote;
      button(state, 'Download a snapshot', 'Save', () => this.snapshot());
      button(state, 'Go on from a snapshot', 'Restore\u2026', () => this.choose.click());
      this.choose = element('input', '', state);
      Object.assign(this.choose, { type: 'file', hidden: true });
      this.choose.setAttribute('aria-label', 'Snapshot file');
      this.choose.addEventListener('change', () => this.restore());
      const [scene, sceneNote] = row('Scene', 'The text as it runs now.');
      this.sceneNote = sceneNote;
      button(scene, 'Download the scene', 'TOML', () => this.scene());
      engine.onFrame((data) => this.frame(data));
      session.onOpened((opened) => {
        const count = Object.keys(opened.set).length;
        this.sceneNote.textContent = 'The text as it runs now.'
          + (count ? ` Changed numbers are not in it; the command under Method sets ${count === 1 ? 'it' : `all ${count}`}.` : '');
      });
    }

    name(ending) { return (this.session.opened.name || 'scene').replace(/[^\w.-]+/g, '-') + ending; }

    async toggle() { await this.engine.send({ do: 'record', on: !this.recording }); }

    frame({ recorded, recording, full }) {
      if (recorded === this.shown && recording === this.recording) return;
      [this.shown, this.recording] = [recorded, recording];
      this.record.textContent = recording ? 'Stop' : 'Record';
      this.record.setAttribute('aria-pressed', recording);
      this.trace.disabled = !recorded;
      const rows = `${recorded.toLocaleString('en')} rows${full ? ', no more are taken' : ''}`;
      this.traceNote.textContent = recorded || recording ? `${rows}.` : this.traceText;
    }

    async csv() {
      const { blob } = await this.engine.send({ do: 'recorded' });
      download(this.name('.csv'), blob);
    }

    async ask(request) {
      const answer = await this.engine.send(request);
      if (!answer.error) return answer;
      this.say(dbd.session.sentence(answer.error), true);
      return null;
    }

    async table() {
      const answer = await this.ask({ do: 'table' });
      if (answer) download(this.name('-inputs.toml'), text(answer.toml));
    }

    async scene() {
      const answer = await this.ask({ do: 'scene' });
      if (answer) download(this.name('.toml'), text(answer.text));
    }

    async snapshot() {
      const answer = await this.ask({ do: 'save' });
      if (answer) download(answer.file, unpacked(answer.base64));
    }

    async restore() {
      const [file] = this.choose.files;
      this.choose.value = '';
      if (!file) return;
      const answer = await this.session.back({ do: 'restore', base64: await packed(file) });
      this.say(answer.error ? dbd.session.sentence(answer.error) : `Went on from ${file.name}.`, Boolean(answer.error));
    }
  }

  dbd.save = { Save };
}(window.dbd = window.dbd || {}));
