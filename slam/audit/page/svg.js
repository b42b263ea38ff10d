// SPDX-License-Identifier: MIT
// SVG nodes, scales, ticks and numbers as people write them.
function svg(name, attributes = {}, ...children) {
  const node = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.append(...children);
  return node;
}

function html(name, attributes = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.append(...children);
  return node;
}

const superscript = (n) => String(n).replace(/[-0-9]/g, (c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[c]));

function format(value, digits = 3) {
  if (value === undefined || value === null || !Number.isFinite(value)) return 'not finite';
  if (value === 0) return '0';
  const power = Math.floor(Math.log10(Math.abs(value)));
  let text;
  if (power >= -3 && power < 5) {
    text = power + 1 >= digits ? value.toFixed(0) : value.toPrecision(digits);
  } else {
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    text = `${mantissa}·10${superscript(Number(exponent))}`;
  }
  return text.replace('-', '−');
}

// A length in the unit that suits it.
function formatLength(metres) {
  if (!Number.isFinite(metres)) return 'not finite';
  const size = Math.abs(metres);
  if (size === 0) return '0 m';
  if (size < 1e-3) return `${format(metres * 1e6)} µm`;
  if (size < 1e-2) return `${format(metres * 1e3)} mm`;
  return size < 1 ? `${format(metres * 1e2)} cm` : `${format(metres)} m`;
}

const degrees = (radians) => (radians * 180) / Math.PI;

// √det as a number and as the σ of a circle of that size.
function formatSize(size) {
  if (size === undefined) return 'not in the map';
  if (Number.isNaN(size)) return data.diagonal_only ? 'not in the log' : 'not finite';
  if (size < 0) return 'not positive';
  return `${format(size)} m² (σ ≈ ${formatLength(Math.sqrt(size))})`;
}

function linearTicks(lo, hi, most) {
  const span = hi - lo;
  if (!(span > 0)) return [lo];
  const raw = span / most;
  const unit = 10 ** Math.floor(Math.log10(raw));
  const step = unit * [1, 2, 5, 10].find((m) => m * unit >= raw);
  const ticks = [];
  for (let k = Math.ceil(lo / step); k * step <= hi * (1 + 1e-12); ++k) ticks.push(k * step);
  return ticks;
}

// Decades, and what is between them where there is room.
function logTicks(lo, hi, most) {
  const [first, last] = [Math.floor(Math.log10(lo)), Math.ceil(Math.log10(hi))];
  const stride = Math.max(1, Math.ceil((last - first) / most));
  for (const steps of [[1, 2, 5], [1, 3], [1]]) {
    const ticks = [];
    for (let power = first; power <= last; power += stride) {
      for (const m of steps) ticks.push(Number(`${m}e${power}`));
    }
    const inside = ticks.filter((tick) => tick >= lo * 0.999 && tick <= hi * 1.001);
    if (inside.length < 2) break;
    if (inside.length <= most + 1 || steps.length === 1) return inside;
  }
  return linearTicks(lo, hi, most);
}

function scale(lo, hi, from, to, log) {
  const f = log ? Math.log10 : (x) => x;
  const [a, b] = [f(lo), f(hi)];
  return (value) => from + ((f(value) - a) / (b - a || 1)) * (to - from);
}

// All of an axis in one manner.
function tickTexts(ticks) {
  const sizes = ticks.filter((tick) => tick !== 0).map(Math.abs);
  const plain = sizes.every((size) => size >= 0.01 && size < 1e5);
  return ticks.map((tick) => {
    if (tick === 0 || plain) return String(Number(tick.toPrecision(6))).replace('-', '−');
    const [mantissa, exponent] = tick.toExponential().split('e');
    const digits = Number(Number(mantissa).toPrecision(3));
    return (digits === 1 ? '' : `${digits}·`) + `10${superscript(Number(exponent))}`;
  });
}

// A path through [x, y]; null parts it.
function pathOf(points) {
  let pen = 'M';
  let text = '';
  for (const point of points) {
    if (!point) { pen = 'M'; continue; }
    text += `${pen}${point[0].toFixed(1)} ${point[1].toFixed(1)}`;
    pen = 'L';
  }
  return text;
}

function key(sample, text) {
  const picture = svg('svg', {width: 24, height: 12, viewBox: '0 0 24 12', 'aria-hidden': 'true'}, sample);
  return html('span', {class: 'key'}, picture, text);
}
const lineKey = (attributes, text) => key(svg('path', {d: 'M0 6H24', ...attributes}), text);

const tip = document.getElementById('tip');
function showTip(event, text) {
  tip.textContent = text;
  tip.hidden = false;
  const {width, height} = tip.getBoundingClientRect();
  const x = event.clientX + 14 + width > innerWidth ? event.clientX - width - 10 : event.clientX + 14;
  const y = event.clientY + 14 + height > innerHeight ? event.clientY - height - 10 : event.clientY + 14;
  tip.style.left = `${Math.max(4, x)}px`;
  tip.style.top = `${Math.max(4, y)}px`;
}
const hideTip = () => { tip.hidden = true; };
