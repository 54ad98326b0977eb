// Packed numbers of the report's data, and numbers as people read them.
//
// base64 => typed arrays; value, unit => "12.3 mm". Ticks, legends and labels all come from here, so that a
// quantity looks the same wherever it stands.
(function (dbd) {
  'use strict';

  function bytes(text) {
    const raw = atob(text || '');
    const array = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; i += 1) array[i] = raw.charCodeAt(i);
    return array.buffer;
  }

  const MINUS = '\u2212';
  // Steps of a thousand. A unit that has no prefixes (kg, %, 1) keeps its own.
  const PREFIXES = ['f', 'p', 'n', '\u00b5', 'm', '', 'k', 'M', 'G', 'T'];
  const PLAIN = 5;
  const PREFIXED = /^(m|N|J|s|Hz|W|rad|N\u00b7m|m\/s|m\/s\u00b2|rad\/s|rad\/s\u00b2|N\/m)$/;

  // The prefix in which a largest value reads as 1 to 999; of several values one for all.
  function scale(unit, largest) {
    const size = Math.abs(largest);
    if (!PREFIXED.test(unit) || !(size > 0) || !Number.isFinite(size)) return { unit, factor: 1 };
    // Angles and times beyond a thousand stay as they are: nobody says kilosecond.
    const most = /^(s|rad)/.test(unit) ? PLAIN : PREFIXES.length - 1;
    let step = PLAIN + Math.floor(Math.log10(size * 1.0000001) / 3);
    step = Math.min(Math.max(step, 0), most);
    return { unit: PREFIXES[step] + unit, factor: 10 ** (3 * (PLAIN - step)) };
  }

  // A number in so many significant digits, without trailing zeros.
  function plain(value, digits) {
    if (value === null || value === undefined || Number.isNaN(value)) return '\u2013';
    if (!Number.isFinite(value)) return value > 0 ? '\u221e' : MINUS + '\u221e';
    const places = digits === undefined ? 4 : digits;
    const size = Math.abs(value);
    let text;
    if (size !== 0 && (size >= 1e6 || size < 1e-4)) {
      const [mantissa, power] = value.toExponential(places - 1).split('e');
      text = Number(mantissa) + 'e' + Number(power);
    } else {
      text = String(Number(value.toPrecision(places)));
    }
    return text.replace(/-/g, MINUS);
  }

  // A value with its unit: "12.3 mm".
  function withUnit(value, unit, digits) {
    if (!Number.isFinite(value)) return plain(value);
    const chosen = scale(unit, value);
    const text = plain(value * chosen.factor, digits === undefined ? 4 : digits);
    return chosen.unit ? text + '\u00a0' + chosen.unit : text;
  }

  // A value in the unit of an axis, as fine as five digits of the axis' largest value.
  function onAxis(value, { unit, factor }, largest) {
    if (!Number.isFinite(value)) return plain(value);
    const places = Math.min(Math.max(4 - Math.floor(Math.log10(largest * factor || 1)), 0), 12);
    const text = plain(Number((value * factor).toFixed(places)), 6);
    return unit ? text + '\u00a0' + unit : text;
  }

  // A time with as many places as frames of so many seconds need.
  function time(value, spacing) {
    const places = spacing > 0 ? Math.min(Math.max(Math.ceil(-Math.log10(spacing)), 1), 7) : 3;
    return value.toFixed(places).replace('-', MINUS) + '\u00a0s';
  }

  dbd.numbers = {
    bytes,
    f32s: (text) => new Float32Array(bytes(text)),
    f64s: (text) => new Float64Array(bytes(text)),
    i16s: (text) => new Int16Array(bytes(text)),
    scale, plain, withUnit, onAxis, time, MINUS,
  };
}(window.dbd = window.dbd || {}));
