// SPDX-License-Identifier: MIT
// √det of P_d of every pair at the chosen record; on the diagonal the features' own.
class Matrix {
  constructor() {
    this.figure = document.getElementById('matrix');
    this.box = this.figure.querySelector('.plot');
    this.value = html('span', {class: 'value'});
    this.figure.querySelector('figcaption').append(html('b', {}, 'Relative covariance √det P', html('sub', {}, 'd'), ', m²'), this.value);
    views.push(this);
  }

  draw() { this.choose(); }

  // The same rows at every record, where they are not too many.
  rows(record) {
    return allIds.length <= data.most_features ? allIds : record.i;
  }

  choose() {
    const record = kept[chosen];
    const ids = this.rows(record);
    this.value.textContent = `at record ${record.n}`;
    if (ids.length === 0) {
      this.box.replaceChildren(html('p', {class: 'legend'}, 'No feature is in the map yet.'));
      return;
    }
    const width = Math.min(620, Math.max(260, this.box.clientWidth));
    const label = 8 + 7.5 * String(ids.reduce((a, b) => Math.max(a, b))).length;
    const cell = Math.min(44, (width - label - 4) / ids.length);
    const side = cell * ids.length;
    const height = side + 22;
    const root = svg('svg', {viewBox: `0 0 ${width} ${height}`, style: `max-width: ${width}px`, role: 'img',
      'aria-label': `relative covariance at record ${record.n}`});
    root.append(hatching());
    const marks = svg('g');
    ids.forEach((a, i) => {
      for (let j = 0; j <= i; ++j) this.cell(root, marks, record, [a, ids[j]], {x: label + j * cell, y: i * cell, cell});
    });
    root.append(marks);
    this.labels(root, record, ids, {label, cell, side});
    this.scale(root, {width, label, side, cell, count: ids.length});
    this.box.replaceChildren(root);
    this.legend(record);
  }

  cell(root, marks, record, [a, b], {x, y, cell}) {
    const size = sizeOf(record, a, b);
    const rect = svg('rect', {x, y, width: cell, height: cell, class: 'cell', 'data-pair': `${b} ${a}`});
    if (size === undefined) {
      rect.classList.add('void');
    } else if (Number.isNaN(size) || size < 0) {
      rect.classList.add(data.diagonal_only ? 'void' : 'odd');
    } else {
      rect.style.fill = shade(size);
    }
    rect.addEventListener('pointermove', (event) => showTip(event, describePair(record, b, a)));
    rect.addEventListener('pointerleave', hideTip);
    if (a !== b) rect.addEventListener('click', () => pick(b, a));
    root.append(rect);
    const bad = size !== undefined && (isBlamed(record, a) || isBlamed(record, b));
    if (bad) {
      const inset = Math.min(1.2, cell / 8);
      const s = cell - 2 * inset;
      marks.append(svg('rect', {class: 'mark', x: x + inset, y: y + inset, width: s, height: s,
        style: `stroke-width: ${cell < 12 ? 0.8 : 1.6}`}));
      const c = Math.min(8, cell / 3);
      marks.append(svg('path', {class: 'corner', d: `M${x + inset} ${y + inset}h${c}l${-c} ${c}Z`}));
    }
    if (picked && picked.includes(a) && picked.includes(b) && a !== b) {
      marks.append(svg('rect', {class: 'picked-cell', x, y, width: cell, height: cell}));
    }
  }

  labels(root, record, ids, {label, cell, side}) {
    const stride = Math.ceil(14 / cell);
    const across = Math.ceil((8 + 7.5 * String(ids.at(-1)).length) / cell);
    ids.forEach((id, k) => {
      const bad = isBlamed(record, id) && record.i.includes(id);
      const style = bad ? {class: 'blamed'} : {};
      if (bad || k % stride === 0) {
        root.append(svg('text', {x: label - 5, y: (k + 0.5) * cell + 4, 'text-anchor': 'end', ...style}, String(id)));
      }
      if ((bad && across === 1) || k % across === 0) {
        root.append(svg('text', {x: label + (k + 0.5) * cell, y: side + 15, 'text-anchor': 'middle', ...style}, String(id)));
      }
    });
  }

  // The empty corner holds the scale.
  scale(root, {width, label, side, cell, count}) {
    const [lo, hi] = data.range;
    const span = hi - lo;
    if (!(span > 0) || count < 3) return;
    const height = Math.min(150, side * 0.42);
    const x = Math.min(width - 64, label + side - 50);
    const y = 8;
    const steps = 24;
    for (let k = 0; k < steps; ++k) {
      root.append(svg('rect', {x, y: y + (k * height) / steps, width: 12, height: height / steps + 0.6,
        style: `fill: ${shade(10 ** (hi - ((k + 0.5) / steps) * span))}`}));
    }
    const ticks = logTicks(10 ** lo, 10 ** hi, height / 22);
    const texts = tickTexts(ticks);
    ticks.forEach((tick, k) => {
      const at = y + ((hi - Math.log10(tick)) / span) * height;
      root.append(svg('text', {x: x + 17, y: at + 4}, texts[k]));
    });
  }

  legend(record) {
    const parts = [];
    if (record.i.some((id) => isBlamed(record, id))) {
      parts.push(key(svg('g', {}, svg('rect', {class: 'mark', x: 6, y: 0.8, width: 10.4, height: 10.4}),
        svg('path', {class: 'corner', d: 'M6 1h6l-6 6Z'})), 'with a blamed feature'));
    }
    const sizes = [...sizesOf(record)];
    if (!data.diagonal_only && sizes.some((size) => !(size >= 0))) {
      parts.push(key(svg('rect', {class: 'cell odd', x: 6, width: 12, height: 12}), 'not finite or not positive'));
    }
    if (data.diagonal_only) parts.push('Only the diagonal of P was logged. ');
    if (record.f > record.i.length) {
      parts.push(`${record.i.length} of ${record.f} features: the blamed ones and the largest; the other ${record.f - record.i.length} are left out. `);
    }
    parts.push('Rows in the order of the state; diagonal: √det P', html('sub', {}, 'ii'), data.diagonal_only ? '.' : '. Click a cell to follow its pair.');
    this.figure.querySelector('.legend').replaceChildren(...parts);
  }
}

function hatching() {
  return svg('defs', {}, svg('pattern', {id: 'odd', width: 5, height: 5, patternUnits: 'userSpaceOnUse', patternTransform: 'rotate(45)'},
    svg('rect', {width: 5, height: 5, style: 'fill: var(--ground)'}),
    svg('rect', {width: 2, height: 5, style: 'fill: var(--blame)'})));
}

function shade(size) {
  const [lo, hi] = data.range;
  if (size === 0) return 'var(--low)';
  const share = hi > lo ? (Math.log10(size) - lo) / (hi - lo) : 0.5;
  return `color-mix(in oklab, var(--high) ${(100 * Math.min(1, Math.max(0, share))).toFixed(1)}%, var(--low))`;
}

function describePair(record, a, b) {
  const size = sizeOf(record, a, b);
  let text = a === b ? `feature ${a}: ` : `features ${a} and ${b}: `;
  text += formatSize(size);
  const before = lastWhole >= 0 && kept[lastWhole].n < record.n ? sizeOf(kept[lastWhole], a, b) : undefined;
  if (size > 0 && before > 0) {
    text += `\n${format(size / before)} times that of record ${kept[lastWhole].n}, the last whole one`;
  }
  const bad = [...new Set([a, b])].filter((id) => isBlamed(record, id));
  return bad.length ? `${text}\nblamed: ${bad.join(', ')}` : text;
}
