// The plant's side of the page: a worker that runs the WebAssembly module in real time and answers requests.
//
// {id, do, ...} => {id, answer}; "frame" => {frame, ...} as soon as there is a new one. Requests that are not listed in
// `own` go to the module as they are.
(function () {
  'use strict';

  // [ms] of stepping between two looks at the messages.
  const SLICE = 8;
  // [ms] of lag that is dropped rather than caught up with.
  const LAG = 100;
  // [ms] between two marks, and the fraction of the time that marks may take.
  const MARK = 1000 / 30;
  const MARK_SHARE = 0.05;
  // [ms] over which the speed is measured.
  const WINDOW = 500;
  // [ms] and frames of the look ahead that sets up view and colours.
  const AHEAD = 60;
  const AHEAD_FRAMES = 60;
  // [numbers] all copies of marked frames together.
  const MOST_KEPT = 8e6;
  const MOST_ROWS = 100000;
  const MOST_CELLS = 4e6;
  // What changes the layout of frames.
  const LAYOUT = new Set(['open', 'change', 'rewind', 'restore', 'watch']);

  const [encoder, decoder] = [new TextEncoder(), new TextDecoder()];
  let compiled = null;
  let kernel = null;
  let broken = null;
  // What the page last asked for, and whether anything is new since the last frame.
  const page = { wants: false, news: false, generation: 0 };
  const run = { playing: false, hidden: false, speed: 1, step: 0, time: 0, failed: false, opened: false };
  const pace = { wall: 0, time: 0, cost: 0, rate: null, since: 0, from: 0, measured: 0, exact: null };
  const marks = { count: 0, first: 0, last: 0, frames: [], next: 0 };
  const recording = { on: false, names: [], rows: [], full: false };
  const ticker = new MessageChannel();
  let waiting = null;

  async function start(gzip) {
    const stream = new Blob([gzip]).stream().pipeThrough(new DecompressionStream('gzip'));
    compiled = await WebAssembly.compile(await new Response(stream).arrayBuffer());
    await restart();
  }

  async function restart() {
    kernel = (await WebAssembly.instantiate(compiled, {})).exports;
    broken = null;
    Object.assign(run, { opened: false, failed: false, playing: false });
    forget();
  }

  // Runs a call of the module. After a trap its memory is not to be trusted.
  function guarded(call) {
    try {
      return call();
    } catch (error) {
      broken = String((error && error.message) || error);
      run.playing = false;
      postMessage({ broken });
      return null;
    }
  }

  function ask(request) {
    if (broken) return { error: { message: `the simulation stopped: ${broken}`, help: 'start it again', line: null, column: null } };
    const answer = guarded(() => {
      const bytes = encoder.encode(JSON.stringify(request));
      const at = kernel.dbd_reserve(bytes.length);
      new Uint8Array(kernel.memory.buffer, at, bytes.length).set(bytes);
      const length = kernel.dbd_ask(bytes.length);
      return JSON.parse(decoder.decode(new Uint8Array(kernel.memory.buffer, kernel.dbd_answer(), length)));
    });
    return answer || ask(request);
  }

  function frame() {
    if (broken || !run.opened) return null;
    return guarded(() => {
      // Memory may grow meanwhile, so its buffer is taken after the call.
      const at = kernel.dbd_frame();
      return new Float64Array(kernel.memory.buffer, at, run.length).slice();
    });
  }

  // Takes time and status from the module, and measures from here.
  function settle() {
    const now = frame();
    if (!now) return;
    [run.time, , run.failed] = [now[0], now[1], now[2] !== 0];
    if (run.failed) run.playing = false;
    page.news = true;
    if (recording.rows.length) recording.rows = recording.rows.filter((row) => parseFloat(row) < run.time);
    begin();
  }

  function begin() {
    const wall = performance.now();
    Object.assign(pace, { wall, time: run.time, since: wall, from: run.time, rate: null });
  }

  // Steps for at most a slice; how many of those asked for were done.
  function advance(wanted, until) {
    let done = 0;
    while (done < wanted && !run.failed && !broken) {
      const begun = performance.now();
      // About a quarter of a slice at once, as far as is known what a step costs.
      const chunk = Math.min(wanted - done, pace.cost > 0 ? Math.max(1, Math.floor(SLICE / 4 / pace.cost)) : 1, 1e6);
      const count = guarded(() => kernel.dbd_advance(chunk));
      if (count === null) break;
      done += count;
      const cost = (performance.now() - begun) / Math.max(count, 1);
      pace.cost = pace.cost > 0 ? pace.cost + 0.2 * (cost - pace.cost) : Math.max(cost, 1e-4);
      if (count < chunk) run.failed = true;
      if (performance.now() >= until) break;
    }
    run.time += done * run.step;
    if (done > 0 || run.failed) page.news = true;
    if (run.failed) run.playing = false;
    return done;
  }

  const active = () => run.opened && !broken && (pace.exact || (run.playing && !run.hidden));

  function loop() {
    waiting = null;
    if (!active()) return;
    const now = performance.now();
    let more = 0;
    if (pace.exact) {
      const { exact } = pace;
      exact.left -= advance(exact.left, now + SLICE);
      more = exact.left;
      if (exact.left <= 0 || run.failed || broken) {
        Object.assign(pace, { exact: null, missed: exact.left });
        exact.done();
      }
    } else {
      const owed = Math.floor((pace.time + (run.speed * (now - pace.wall)) / 1000 - run.time) / run.step + 1e-9);
      more = owed - advance(owed, now + SLICE);
      if (more * run.step > (run.speed * LAG) / 1000) Object.assign(pace, { wall: performance.now(), time: run.time });
      measure();
    }
    if (now >= marks.next) mark();
    deliver();
    again(more > 0 ? 0 : Math.min(Math.max((1000 * run.step) / run.speed / 2, 2), 30));
  }

  function again(after) {
    if (waiting !== null) return;
    waiting = after > 0 ? setTimeout(loop, after) : 0;
    if (after <= 0) ticker.port2.postMessage(null);
  }

  // Begins at once, however long the loop meant to wait.
  function wake() {
    if (waiting) {
      clearTimeout(waiting);
      waiting = null;
    }
    if (active()) again(0);
  }

  // Simulated seconds per second.
  function measure() {
    const now = performance.now();
    if (now - pace.since < WINDOW) return;
    pace.rate = (1000 * (run.time - pace.from)) / (now - pace.since);
    [pace.since, pace.from] = [now, run.time];
  }

  // Keeps the state for the rewind slider, and a copy of its frame to be shown while the slider moves.
  function mark() {
    const begun = performance.now();
    const { count, last } = marks;
    const answer = ask({ do: 'mark' });
    if (answer.error) return;
    Object.assign(marks, { count: answer.marks, first: answer.first, last: answer.last });
    if (answer.marks > count || answer.last !== last) marks.frames.push(frame());
    while (marks.frames.length > answer.marks) marks.frames.shift();
    // Frames of large scenes are kept of the latest marks only.
    const most = Math.max(2, Math.floor(MOST_KEPT / (run.length || 1)));
    if (marks.frames.length > most) marks.frames[marks.frames.length - most - 1] = null;
    const took = performance.now() - begun;
    marks.next = performance.now() + Math.max(MARK, took / MARK_SHARE);
  }

  function forget() {
    Object.assign(marks, { count: 0, first: run.time, last: run.time, frames: [], next: 0 });
  }

  function deliver() {
    if (!page.wants || !page.news) return;
    const now = frame();
    if (!now) return;
    Object.assign(page, { wants: false, news: false });
    if (recording.on) record(now[0]);
    send(now, false);
  }

  // A frame with what the worker says of the run.
  function shown(now, preview) {
    return {
      frame: now, preview, generation: page.generation, playing: run.playing, rate: run.playing ? pace.rate : null,
      cost: pace.cost, marks: { count: marks.count, first: marks.first, last: marks.last },
      recorded: recording.rows.length, recording: recording.on, full: recording.full,
    };
  }

  function send(now, preview) { postMessage(shown(now, preview), [now.buffer]); }

  function record(time) {
    const most = Math.min(MOST_ROWS, Math.floor(MOST_CELLS / (recording.names.length + 1)));
    if (recording.rows.length >= most) {
      Object.assign(recording, { on: false, full: true });
      return;
    }
    const { values } = ask({ do: 'row' });
    if (values) recording.rows.push([time, ...values.map((value) => (value === null ? 'NaN' : value))].join(','));
  }

  // A recording goes on as long as the outputs stay the same, and holds no row of a time that is taken back.
  function columns(names) {
    if (names.join('\n') === recording.names.join('\n')) return;
    Object.assign(recording, { on: false, names, rows: [], full: false });
  }

  function csv() {
    const quoted = (name) => (/[",\n]/.test(name) ? `"${name.replace(/"/g, '""')}"` : name);
    const header = ['time', ...recording.names].map(quoted).join(',');
    return new Blob([[header, ...recording.rows, ''].join('\n')], { type: 'text/csv' });
  }

  // Runs the scene ahead for a moment, for the reach of its motion and its forces, and goes back to the start.
  function lookAhead(answer) {
    const steps = Math.max(answer.steps, 1);
    const until = performance.now() + AHEAD;
    const { playing } = run;
    const found = [];
    let done = 0;
    for (let i = 1; i <= AHEAD_FRAMES && performance.now() < until && !run.failed && !broken; i += 1) {
      done += advance(Math.round((i * steps) / AHEAD_FRAMES) - done, until);
      const now = frame();
      if (now && !run.failed && now.every((value, at) => at < run.poses || at >= run.springs || Number.isFinite(value))) found.push(now);
    }
    Object.assign(run, { failed: false, playing });
    ask({ do: 'reset' });
    return found;
  }

  // What the module was asked for, and what follows for the loop.
  function relay(request) {
    const answer = ask(request);
    if (answer.error) return { answer };
    const opened = answer.opened || answer;
    if (LAYOUT.has(request.do)) {
      page.generation += 1;
      Object.assign(run, { length: opened.layout.length, poses: opened.layout.poses, springs: opened.layout.springs, opened: true });
      if (opened.step) run.step = opened.step;
      if (opened.outputs) columns(opened.outputs.map(({ name }) => name));
      if (request.do !== 'watch') pace.cost = 0;
    }
    const extra = { answer, generation: page.generation };
    if (request.do === 'open') {
      run.failed = false;
      extra.ahead = lookAhead(opened);
    }
    if (request.do === 'rewind') {
      marks.count = request.mark + 1;
      marks.frames.length = Math.min(marks.frames.length, marks.count);
    }
    if (request.do === 'open' || request.do === 'reset' || answer.restarted) forget();
    if (!['row', 'table', 'scene', 'save', 'mark', 'diagnose'].includes(request.do)) settle();
    // The first mark is the start.
    if (run.opened && !run.failed && !marks.count) mark();
    return extra;
  }

  const own = {
    start: async ({ module }) => { await start(module); return {}; },
    restart: async () => { await restart(); return {}; },
    play: () => { if (!run.failed && !broken) run.playing = true; begin(); return {}; },
    pause: () => { run.playing = false; page.news = true; return {}; },
    speed: ({ value }) => { run.speed = value; begin(); return {}; },
    hidden: ({ value }) => { run.hidden = value; begin(); return {}; },
    // Exactly so many steps; the answer comes after the last one, or the one that failed.
    advance: ({ steps }) => {
      run.playing = false;
      if (!run.opened || broken || run.failed) return { done: 0 };
      return new Promise((answer) => {
        pace.exact = { left: steps, done: () => { mark(); answer({ done: steps - pace.missed }); } };
      });
    },
    preview: ({ mark: at }) => {
      const offset = marks.count - marks.frames.length;
      const kept = marks.frames[at - offset];
      if (kept && kept.length === run.length) send(kept.slice(), true);
      return {};
    },
    record: ({ on }) => {
      if (on) Object.assign(recording, { rows: [], full: false });
      recording.on = on;
      page.news = true;
      return {};
    },
    now: () => shown(frame(), false),
    recorded: () => ({ blob: csv(), rows: recording.rows.length }),
  };

  onmessage = async ({ data }) => {
    if (data.do === 'frame') {
      page.wants = true;
      deliver();
      return;
    }
    const { id, ...request } = data;
    try {
      const job = own[request.do];
      if (job) {
        const answer = job(request);
        wake();
        postMessage({ id, answer: await answer });
      } else {
        const { ahead, ...extra } = relay(request);
        postMessage({ id, ...extra, ahead }, (ahead || []).map((one) => one.buffer));
      }
    } catch (error) {
      postMessage({ id, answer: { error: { message: String((error && error.message) || error), help: null, line: null, column: null } } });
    }
    deliver();
    wake();
  };
  ticker.port1.onmessage = loop;
}());
