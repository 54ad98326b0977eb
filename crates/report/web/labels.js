// Words in the picture: names of bodies, joints and forces, what lies under the pointer, the axes in the corner.
//
// (mechanism, camera) => HTML and SVG over the canvas, which stay sharp and follow the page's colours.
(function (dbd) {
  'use strict';

  const T = window.THREE;
  const { withUnit } = dbd.numbers;
  // Names shown at once.
  const MOST = 80;

  function element(name, className, parent) {
    const made = document.createElement(name);
    if (className) made.className = className;
    if (parent) parent.append(made);
    return made;
  }

  function button(parent, label, content, action) {
    const made = element('button', '', parent);
    made.type = 'button';
    made.setAttribute('aria-label', label);
    made.title = label;
    made.innerHTML = content;
    made.addEventListener('click', action);
    return made;
  }

  function toggle(parent, text, on, action) {
    const label = element('label', 'toggle', parent);
    const box = element('input', '', label);
    box.type = 'checkbox';
    box.checked = on;
    label.append(text);
    box.addEventListener('change', () => action(box.checked));
    return box;
  }

  // What a label says: the thing, and its numbers at this time.
  function describe(label, machine, time) {
    const { film, mechanism } = machine;
    const of = (table) => film.values(table, time, new Float32Array(film.counts[table]));
    if (label.what === 'body') {
      const mass = mechanism.bodies[label.row].mass;
      const at = [0, 1, 2].map((i) => machine.poses[label.row * dbd.film.WORDS + i]);
      return [label.name, withUnit(mass, 'kg', 3), 'centre at ' + at.map((x) => withUnit(x, 'm', 3)).join(', ')];
    }
    if (label.what === 'joint') {
      const lines = [label.name, label.kind.replace('_', ' ') + ' joint'];
      if (film && film.joints.length) {
        const all = of('joints');
        lines.push('force ' + withUnit(all[2 * label.row], 'N', 3) + ', pulled apart by '
          + withUnit(all[2 * label.row + 1], 'm', 3));
      }
      return lines;
    }
    if (label.what === 'spring') {
      const tension = machine.springs.tensions[label.row];
      return [label.name, (tension < 0 ? 'pushes with ' : 'pulls with ') + withUnit(Math.abs(tension), 'N', 3)];
    }
    if (label.what === 'force') {
      return [label.name, withUnit(machine.arrows.values[label.row], label.unit, 3)];
    }
    if (label.what === 'trace') return ['path of ' + label.name];
    return label.name === label.what ? [label.name] : [label.name, label.what];
  }

  class Labels {
    constructor(view, machine) {
      this.machine = machine;
      this.layer = element('div', 'labels', view);
      this.layer.setAttribute('aria-hidden', 'true');
      this.tip = element('div', 'tip', view);
      this.tip.hidden = true;
      this.axes = new Axes(view, machine);
      this.names = false;
      this.values = true;
      this.pool = [];
    }

    remove() {
      for (const part of [this.layer, this.tip, this.axes.picture.parentElement]) part.remove();
    }

    // Where a name stands: the middle of a body's corners, a joint's place, an arrow's tip.
    wanted() {
      const { machine } = this;
      const { mechanism, owners } = machine;
      const found = [];
      if (machine.arrows.shown && this.values) {
        machine.arrows.rows.forEach((row, i) => {
          if (Number.isNaN(row.tip.x)) return;
          const text = (row.label.name === 'load' ? '' : row.label.name + ' ')
            + withUnit(machine.arrows.values[i], row.unit, 2);
          found.push({ at: row.tip, text, kind: 'force' });
        });
      }
      if (!this.names) return found;
      mechanism.bodies.forEach((body, row) => {
        if (found.length > MOST || dbd.bodies.outline(body)[0] === 'spider') return;
        const corners = dbd.bodies.corners(body);
        const middle = new T.Vector3();
        corners.forEach((corner) => middle.add(new T.Vector3().fromArray(corner).divideScalar(corners.length)));
        found.push({ at: middle.applyMatrix4(owners[row]), text: body.name, kind: 'body' });
      });
      mechanism.joints.forEach((joint) => {
        if (found.length > MOST) return;
        const place = joint.places[0];
        const at = new T.Vector3().fromArray(place.point).applyMatrix4(owners[machine.owner(place)]);
        found.push({ at, text: joint.name, kind: 'joint' });
      });
      return found;
    }

    update(camera, width, height) {
      this.axes.update(camera);
      const wanted = this.wanted();
      const taken = [];
      wanted.forEach(({ at, text, kind }, i) => {
        const label = this.pool[i] || (this.pool[i] = element('span', '', this.layer));
        const seen = at.clone().project(camera);
        const [x, y] = [(seen.x + 1) * width / 2, (1 - seen.y) * height / 2];
        const wide = 7 * text.length + 8;
        const left = Math.min(Math.max(x + 8, 2), Math.max(width - wide - 2, 2));
        const top = Math.min(Math.max(y - 10, 2), height - 22);
        const clear = taken.every(([a, b, w]) => left + wide < a || a + w < left || Math.abs(top - b) > 17);
        const inside = seen.z < 1 && x > 0 && x < width && y > 0 && y < height;
        label.hidden = !(inside && clear);
        if (label.hidden) return;
        taken.push([left, top, wide]);
        if (label.textContent !== text) label.textContent = text;
        label.className = kind;
        label.style.transform = `translate(${left}px, ${top}px)`;
      });
      this.pool.slice(wanted.length).forEach((label) => { label.hidden = true; });
    }

    point(label, x, y, time, width) {
      this.tip.hidden = !label;
      if (!label) return;
      this.tip.replaceChildren(...describe(label, this.machine, time).map((line, i) => {
        const made = element(i ? 'span' : 'strong');
        made.textContent = line;
        return made;
      }));
      const left = Math.min(x + 14, width - this.tip.offsetWidth - 6);
      this.tip.style.transform = `translate(${Math.max(left, 4)}px, ${Math.max(y - 10 - this.tip.offsetHeight, 4)}px)`;
    }
  }

  // The world's axes and the direction of gravity, turned as the camera sees them.
  class Axes {
    constructor(view, machine) {
      this.arrows = [['x', [1, 0, 0]], ['y', [0, 1, 0]], ['z', [0, 0, 1]]];
      const { gravity } = machine.mechanism;
      if (gravity && Math.hypot(...gravity) > 0) {
        this.arrows.push(['g', gravity.map((value) => value / Math.hypot(...gravity))]);
      }
      const picture = element('div', 'axes', view);
      picture.innerHTML = '<svg viewBox="-50 -50 100 100" role="img" aria-label="Axes of the world'
        + (this.arrows.length > 3 ? ' and direction of gravity' : '') + '">'
        + this.arrows.map(([name]) => `<g class="axis-${name}"><path/><circle r="2.4"/><text dy="4">${name}</text></g>`).join('')
        + '</svg>';
      this.groups = [...picture.querySelectorAll('g')];
      this.picture = picture.querySelector('svg');
    }

    update(camera) {
      const back = camera.quaternion.clone().invert();
      this.arrows.forEach(([name, direction], i) => {
        const gravity = name === 'g';
        const seen = new T.Vector3().fromArray(direction).applyQuaternion(back).multiplyScalar(gravity ? 22 : 32);
        const [path, head, text] = this.groups[i].children;
        path.setAttribute('d', `M0 0L${seen.x.toFixed(1)} ${(-seen.y).toFixed(1)}`);
        head.setAttribute('cx', seen.x.toFixed(1));
        head.setAttribute('cy', (-seen.y).toFixed(1));
        const far = Math.hypot(seen.x, seen.y);
        // Gravity stands beside its arrow, for an axis may lie along it.
        const [x, y] = far > 3 ? [seen.x * (1 + 10 / far), seen.y * (1 + 10 / far)] : [8, 8];
        text.setAttribute('x', (x + (gravity ? 8 : 0)).toFixed(1));
        text.setAttribute('y', (-y + (gravity ? -6 : 0)).toFixed(1));
        this.groups[i].style.opacity = seen.z < -20 ? 0.55 : 1;
      });
    }
  }

  dbd.labels = { Labels, element, button, toggle };
}(window.dbd = window.dbd || {}));
