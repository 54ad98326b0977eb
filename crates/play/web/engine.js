// The page's end of the worker: requests with answers, and the latest frame.
//
// request => promise of the answer; refresh of the screen => at most one frame. Nothing of the plant is computed here.
(function (dbd) {
  'use strict';

  const { bytes } = dbd.numbers;

  class Engine {
    constructor() {
      this.waiting = new Map();
      this.next = 0;
      this.latest = null;
      this.generation = 0;
      this.layout = null;
      this.listeners = [];
      this.broken = null;
      this.held = false;
      this.onBroken = () => {};
      // Requests of which only the last one counts, by name: what is on its way, what comes after.
      this.lanes = new Map();
    }

    async start() {
      const source = document.getElementById('worker').textContent;
      const address = URL.createObjectURL(new Blob([source], { type: 'text/javascript' }));
      this.worker = new Worker(address);
      this.worker.onmessage = ({ data }) => this.take(data);
      this.worker.onerror = (event) => this.fail(event.message || 'the worker did not start');
      const module = bytes(document.getElementById('module').textContent.trim());
      const answer = await this.send({ do: 'start', module }, [module]);
      if (answer.error) throw new Error(answer.error.message);
      document.addEventListener('visibilitychange', () => this.send({ do: 'hidden', value: document.hidden }));
      this.refresh = this.refresh.bind(this);
      requestAnimationFrame(this.refresh);
    }

    // Asks for the next frame once per refresh of the screen, when the last one has come.
    refresh() {
      if (!this.asked && !this.broken) {
        this.asked = true;
        this.worker.postMessage({ do: 'frame' });
      }
      requestAnimationFrame(this.refresh);
    }

    send(request, transfer) {
      const id = this.next;
      this.next += 1;
      return new Promise((answer) => {
        this.waiting.set(id, answer);
        this.worker.postMessage({ id, ...request }, transfer || []);
      });
    }

    // Sends a request on a lane where only the last one counts: at most one is on its way, one waits.
    last(lane, request, then) {
      const known = this.lanes.get(lane);
      if (known) {
        known.next = { request, then };
        return;
      }
      const state = { next: { request, then } };
      this.lanes.set(lane, state);
      const go = async () => {
        while (state.next) {
          const { request: now, then: told } = state.next;
          state.next = null;
          const answer = await this.send(typeof now === 'function' ? now() : now);
          if (told) told(answer);
          if (state.next) await new Promise((done) => { requestAnimationFrame(done); });
        }
        this.lanes.delete(lane);
      };
      go();
    }

    take(data) {
      if (data.frame) {
        if (!data.preview) this.asked = false;
        this.show(data);
        return;
      }
      if ('broken' in data) {
        this.fail(data.broken);
        return;
      }
      const { id, answer, generation, ahead } = data;
      if (generation !== undefined) {
        const layout = (answer.opened || answer).layout;
        if (layout) [this.layout, this.generation, this.latest] = [layout, generation, null];
      }
      if (ahead) answer.ahead = ahead;
      const told = this.waiting.get(id);
      this.waiting.delete(id);
      if (told) told(answer);
    }

    show(data) {
      const fits = this.layout && data.generation === this.generation && data.frame.length === this.layout.length;
      if (!fits) return;
      if (!data.preview) this.latest = data;
      // While the rewind slider moves, only what it points at is shown.
      if (this.held && !data.preview) return;
      for (const listener of this.listeners) listener(data);
    }

    fail(message) {
      this.broken = message;
      this.onBroken(message);
    }

    // Starts the module anew after it stopped.
    async restart() {
      const answer = await this.send({ do: 'restart' });
      this.broken = null;
      this.asked = false;
      return answer;
    }

    // The frame after all that was asked for until now.
    async fresh() {
      const data = await this.send({ do: 'now' });
      if (data.frame) this.show(data);
      return this.latest;
    }

    onFrame(listener) { this.listeners.push(listener); }
  }

  // What a frame says of the whole plant.
  function summary({ frame }) {
    const word = (value) => value.toString(16).padStart(8, '0');
    const [time, steps, failed, kinetic, potential, total] = frame;
    const hash = word(frame[6]) + word(frame[7]);
    return { time, steps, failed: failed !== 0, kinetic, potential, total, hash, start: frame[8], work: frame[9] };
  }

  dbd.engine = { Engine, summary };
}(window.dbd = window.dbd || {}));
