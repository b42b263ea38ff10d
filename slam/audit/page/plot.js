// SPDX-License-Identifier: MIT
// A plot over the run: axes, cursor, hover and picking; what it shows is its `draw`.
const kMargin = {left: 68, right: 14, top: 6, bottom: 38};
let chosen = 0;
let picked = null;  // pair of features that was clicked in the matrix
const views = [];   // each with draw() on a new size or pair, and choose() on a new record

function runScale(width) {
  const last = kept.length - 1;
  return scale(placeOf(0), placeOf(last), kMargin.left, width - kMargin.right, false);
}

function timeAt(place) {
  return kept[nearestKept(place)].t;
}

function runAxis(width, y) {
  const x = runScale(width);
  const axis = svg('g', {'text-anchor': 'middle'});
  const ticks = linearTicks(placeOf(0), placeOf(kept.length - 1), width / 90).filter((t) => t % 1 === 0);
  const span = kept.at(-1).t - kept[0].t;
  for (const tick of ticks) {
    axis.append(svg('text', {x: x(tick), y: y + 15}, String(tick)));
    const time = timeAt(tick).toFixed(span < 2 ? 2 : span < 200 ? 1 : 0);
    axis.append(svg('text', {x: x(tick), y: y + 30, class: 'time'}, time));
  }
  const name = {x: kMargin.left - 18, 'text-anchor': 'end'};
  axis.append(svg('text', {...name, y: y + 15}, 'record'), svg('text', {...name, y: y + 30}, 't in s'));
  return {axis, ticks};
}

// Clicking, dragging and hovering along the run.
function pickable(surface, describe) {
  const at = (event) => {
    const box = surface.getBoundingClientRect();
    const [lo, hi] = [placeOf(0), placeOf(kept.length - 1)];
    const inner = box.width - kMargin.left - kMargin.right;
    const share = (event.clientX - box.left - kMargin.left) / inner;
    return nearestKept(lo + share * (hi - lo));
  };
  surface.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    surface.setPointerCapture(event.pointerId);
    choose(at(event));
  });
  surface.addEventListener('pointermove', (event) => {
    if (surface.hasPointerCapture(event.pointerId)) choose(at(event));
    const k = at(event);
    const box = surface.getBoundingClientRect();
    const text = describe(k, event.clientY - box.top);
    showTip(event, `record ${kept[k].n}, t = ${kept[k].t.toFixed(2)} s\n${text}`);
  });
  surface.addEventListener('pointerleave', hideTip);
}

class Plot {
  constructor(name, height) {
    this.figure = document.getElementById(name);
    this.box = this.figure.querySelector('.plot');
    this.height = height;
    this.caption = html('b');  // with subscripts
    this.value = html('span', {class: 'value'});
    this.figure.querySelector('figcaption').append(this.caption, this.value);
    this.legend = this.figure.querySelector('.legend');
    views.push(this);
  }

  // {lo, hi, log, name}: the y axis; extremes that are not finite are given by the caller.
  frame({lo, hi, log, name}) {
    this.width = Math.max(280, this.box.clientWidth);
    const bottom = this.height - kMargin.bottom;
    this.x = runScale(this.width);
    this.y = scale(lo, hi, bottom, kMargin.top, log);
    this.log = log;
    this.bottom = bottom;
    const {width, height} = this;
    this.root = svg('svg', {width, height, viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': name});
    const clip = `clip-${this.figure.id}`;
    this.root.append(svg('clipPath', {id: clip}, svg('rect', {
      x: kMargin.left, y: kMargin.top, width: width - kMargin.left - kMargin.right, height: bottom - kMargin.top})));
    const {axis, ticks} = runAxis(width, bottom);
    for (const tick of ticks) {
      this.root.append(svg('path', {class: 'grid', d: `M${this.x(tick)} ${kMargin.top}V${bottom}`}));
    }
    const rungs = (log ? logTicks : linearTicks)(lo, hi, this.height / 32);
    const texts = tickTexts(rungs);
    rungs.forEach((tick, k) => {
      const y = this.y(tick);
      this.root.append(svg('path', {class: 'grid', d: `M${kMargin.left} ${y}H${width - kMargin.right}`}));
      this.root.append(svg('text', {x: kMargin.left - 6, y: y + 4, 'text-anchor': 'end'}, texts[k]));
    });
    this.root.append(axis);
    this.inside = svg('g', {'clip-path': `url(#${clip})`});
    this.cursor = svg('path', {class: 'cursor'});
    this.root.append(this.inside, svg('path', {class: 'frame',
      d: `M${kMargin.left} ${kMargin.top}V${bottom}H${width - kMargin.right}`}), this.cursor);
    if (Number.isFinite(firstBreak) && rising) {
      const x = this.x(firstBreak);
      this.inside.append(svg('path', {class: 'break', d: `M${x} ${kMargin.top}V${bottom}`}));
    }
    pickable(this.root, (k, y) => this.describe(k, y));
    this.box.replaceChildren(this.root);
  }

  // Points of the run as a path; what can't be drawn parts it.
  path(attributes, valueAt) {
    const points = kept.map((record, k) => {
      const value = valueAt(record, k);
      if (!Number.isFinite(value) || (this.log && value <= 0)) return null;
      return [this.x(placeOf(k)), this.y(value)];
    });
    const node = svg('path', {...attributes, d: pathOf(points)});
    this.inside.append(node);
    return node;
  }

  choose() {
    if (!this.cursor) return;
    const x = this.x(placeOf(chosen));
    this.cursor.setAttribute('d', `M${x} ${kMargin.top}V${this.bottom}`);
    this.value.textContent = this.describe(chosen, null);
  }

  nothing(reason) {
    this.cursor = null;
    this.value.textContent = '';
    this.legend.replaceChildren();
    this.box.replaceChildren(html('p', {class: 'legend'}, reason));
  }
}

function extent(values, log) {
  const usable = values.filter((v) => Number.isFinite(v) && (!log || v > 0));
  if (usable.length === 0) return null;
  let lo = usable.reduce((a, b) => Math.min(a, b));
  let hi = usable.reduce((a, b) => Math.max(a, b));
  if (log) return hi / lo < 1.05 ? [lo / 1.3, hi * 1.3] : [lo / 1.15, hi * 1.15];
  return [lo, hi + 0.05 * (hi - lo || 1)];
}
