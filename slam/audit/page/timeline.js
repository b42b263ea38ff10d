// SPDX-License-Identifier: MIT
// The whole run in a strip: a row for each broken law, and the chosen record.
class TimeLine {
  constructor() {
    this.box = document.querySelector('#timeline .plot');
    views.push(this);
  }

  draw() {
    const width = Math.max(280, this.box.clientWidth);
    const row = 13;
    const rows = Math.max(1, brokenLaws.length);
    const bottom = rows * (row + 3) + 4;
    const height = bottom + 34;
    this.x = runScale(width);
    this.bottom = bottom;
    const root = svg('svg', {width, height, viewBox: `0 0 ${width} ${height}`});
    const strip = (y) => svg('rect', {class: 'whole', x: kMargin.left, y, rx: 2, width: width - kMargin.left - kMargin.right, height: row});
    if (brokenLaws.length === 0) root.append(strip(2));
    brokenLaws.forEach((law, k) => {
      const y = k * (row + 3) + 2;
      root.append(strip(y), this.broken(law, y, row));
      const name = svg('text', {x: kMargin.left - 6, y: y + 11, 'text-anchor': 'end'}, law.name);
      if (law.name.length > 9) name.setAttribute('textLength', kMargin.left - 8);
      if (law.name.length > 9) name.setAttribute('lengthAdjust', 'spacingAndGlyphs');
      root.append(name);
    });
    root.append(runAxis(width, bottom).axis);
    this.handle = svg('path', {class: 'handle'});
    this.cursor = svg('path', {class: 'cursor'});
    root.append(this.cursor, this.handle);
    pickable(root, (k) => brokenAt(kept[k]).join(', ') || 'no law broken');
    this.box.replaceChildren(root);
  }

  // Stretches in which it is broken; a statistical law from where it stood out.
  broken(law, y, height) {
    const index = data.laws.indexOf(law);
    let d = '';
    kept.forEach((record, k) => {
      if (!record.l?.includes(index)) return;
      const from = this.x(placeOf(Math.max(0, k - 1)));
      const to = Math.max(this.x(placeOf(k)), from + 3);
      d += `M${from.toFixed(1)} ${y}H${to.toFixed(1)}v${height}H${from.toFixed(1)}Z`;
    });
    if (law.class !== 'code' && rising) {
      d += `M${this.x(law.first)} ${y}H${this.x(placeOf(kept.length - 1))}v${height}H${this.x(law.first)}Z`;
    }
    return svg('path', {class: `broken ${law.class}`, d});
  }

  choose() {
    const x = this.x(placeOf(chosen));
    this.cursor.setAttribute('d', `M${x} 0V${this.bottom}`);
    this.handle.setAttribute('d', `M${x} ${this.bottom - 2}l6 8h-12Z`);
    const record = kept[chosen];
    this.box.setAttribute('aria-valuemin', kept[0].n);
    this.box.setAttribute('aria-valuemax', kept.at(-1).n);
    this.box.setAttribute('aria-valuenow', record.n);
    this.box.setAttribute('aria-valuetext', `record ${record.n}, ${record.t.toFixed(2)} s`);
    document.getElementById('chosen').textContent =
      `record ${record.n} · ${record.e} · t = ${record.t.toFixed(2)} s`;
  }
}

const brokenAt = (record) => (record.l ?? []).map((index) => data.laws[index].name);
