// SPDX-License-Identifier: MIT
// √det P_d of pairs, NIS and heading over the run.
const kLines = 24;  // of each kind
const colour = (k) => `var(--c${k % 6})`;

// `most` of a list, evenly over it, with both ends.
function spread(list, most) {
  if (list.length <= most) return list;
  return Array.from({length: most}, (_, k) => list[Math.round((k * (list.length - 1)) / (most - 1))]);
}

function pairLines() {
  const greatest = ([a, b]) => {
    let size = 0;
    for (const record of kept) size = Math.max(size, sizeOf(record, a, b) || 0);
    return size;
  };
  const all = pairsOf(allIds).map((pair) => ({pair, size: greatest(pair)}));
  const drawable = all.filter((line) => line.size > 0).sort((a, b) => b.size - a.size);
  const isBad = ({pair}) => pair.some((id) => blamedFrom.has(id));
  const bad = drawable.filter(isBad);
  const good = drawable.filter((line) => !isBad(line));
  return {total: all.length, bad: bad.slice(0, kLines), badTotal: bad.length, good: spread(good, kLines), goodTotal: good.length};
}

class PairsPlot extends Plot {
  constructor() {
    super('pairs', 300);
    this.caption.append('√det P', html('sub', {}, 'd'), ' of feature pairs, m²');
    this.lines = pairLines();
    // Clusters are numbered by their first member, so a pair of numbers is a line.
    this.clusters = [...new Set(kept.flatMap((r) => (r.g ?? []).map((g) => `${g[0]} ${g[1]}`)))].sort().slice(0, 6);
  }

  groupAt(record, name) {
    return record.g?.find((g) => `${g[0]} ${g[1]}` === name);
  }

  // One cluster is the whole map.
  groupName(name) {
    const [a, b] = name.split(' ').map(Number);
    return a === b ? 'all pairs' : `clusters ${a + 1} and ${b + 1}`;
  }

  draw() {
    const shown = [...this.lines.bad, ...this.lines.good];
    const sizes = kept.flatMap((r) => [...shown.map(({pair}) => sizeOf(r, ...pair)), ...(r.g ?? []).flatMap((g) => g.slice(2))]);
    const range = extent(sizes, true);
    if (!range) {
      this.nothing(data.diagonal_only ? 'Only the diagonal of P was logged: P_d is not known.'
                                      : 'No record has two features with a finite P_d.');
      return;
    }
    this.frame({lo: range[0], hi: range[1], log: true, name: 'size of relative covariance over the run'});
    for (const {pair} of this.lines.good) this.path({class: 'pair'}, (r) => sizeOf(r, ...pair));
    for (const {pair} of this.lines.bad) this.path({class: 'pair blamed'}, (r) => sizeOf(r, ...pair));
    this.clusters.forEach((name, c) => {
      const style = `stroke: ${colour(c)}`;
      for (const part of [2, 4]) this.path({class: 'edge', style}, (r) => this.groupAt(r, name)?.[part]);
      this.path({class: 'mean', style}, (r) => this.groupAt(r, name)?.[3]);
    });
    this.nameClusters();
    if (picked) this.path({class: 'pair picked'}, (r) => sizeOf(r, ...picked));
    this.keys();
  }

  // At the line, so that nobody has to tell colours apart.
  nameClusters() {
    this.clusters.forEach((name, c) => {
      const k = kept.findLastIndex((record) => this.groupAt(record, name)?.[3] > 0);
      if (k < 0) return;
      const [a, b] = name.split(' ').map((cluster) => Number(cluster) + 1);
      const end = k === kept.length - 1;
      this.inside.append(svg('text', {class: 'name', style: `fill: ${colour(c)}`, 'text-anchor': end ? 'end' : 'start',
        x: this.x(placeOf(k)) + (end ? -4 - 34 * (c % 3) : 4), y: this.y(this.groupAt(kept[k], name)[3]) - 5}, a === b ? 'all' : `${a}–${b}`));
    });
  }

  keys() {
    const {good, bad, goodTotal, badTotal} = this.lines;
    const count = (some, all) => (some < all ? `${some} of ${all}` : `${all}`);
    const keys = [];
    if (bad.length) keys.push(lineKey({class: 'pair blamed'}, `blamed pairs, ${count(bad.length, badTotal)}${bad.length < badTotal ? ', largest' : ''}`));
    if (good.length) keys.push(lineKey({class: 'pair'}, `${badTotal ? 'other pairs' : 'pairs'}, ${count(good.length, goodTotal)}${good.length < goodTotal ? ', evenly by size' : ''}`));
    this.clusters.forEach((name, c) => keys.push(lineKey({class: 'mean', style: `stroke: ${colour(c)}`}, this.groupName(name))));
    if (this.clusters.length) keys.push(lineKey({class: 'edge', style: 'stroke: var(--soft)'}, 'their least and greatest (solid: mean)'));
    if (Number.isFinite(firstBreak)) keys.push(lineKey({class: 'break'}, `first break, record ${firstBreak}`));
    if (kept.some((r) => r.f > r.i.length)) keys.push(`Lines part where a feature is not among the ${data.most_features} kept. `);
    if (picked) keys.push(lineKey({class: 'pair picked'}, `${picked[0]} and ${picked[1]}`));
    this.legend.replaceChildren(...keys);
  }

  // The line that is nearest to the pointer; without a pointer the whole record.
  describe(k, y) {
    const record = kept[k];
    if (y === null) {
      if (picked) return `${picked[0]} and ${picked[1]}: ${formatSize(sizeOf(record, ...picked))}`;
      const group = record.g?.[0];
      if (!group) return '';
      const name = this.groupName(`${group[0]} ${group[1]}`);
      return `${name}: ${format(group[2])} … ${format(group[3])} … ${format(group[4])}`;
    }
    const lines = [...this.lines.bad, ...this.lines.good].map(({pair}) => [`${pair[0]} and ${pair[1]}`, sizeOf(record, ...pair)]);
    for (const group of record.g ?? []) {
      ['least', 'mean', 'greatest'].forEach((word, part) => lines.push([
        `${this.groupName(`${group[0]} ${group[1]}`)}, ${word}`, group[2 + part]]));
    }
    const near = lines.filter(([, size]) => size > 0)
        .map(([name, size]) => ({name, size, distance: Math.abs(this.y(size) - y)}))
        .sort((a, b) => a.distance - b.distance)[0];
    return near ? `${near.name}: ${formatSize(near.size)}` : 'no pair';
  }
}

class NisPlot extends Plot {
  constructor() {
    super('nis', 200);
    this.caption.textContent = 'NIS per degree of freedom';
    let [nis, dof] = [0, 0];
    this.running = kept.map(({q}) => {
      if (q && Number.isFinite(q[0])) { nis += q[0]; dof += q[1]; }
      return dof ? nis / dof : NaN;
    });
  }

  draw() {
    const points = kept.map(({q}) => (q && q[0] !== null ? q[0] / q[1] : NaN));
    const most = extent([...points, ...this.running], false)?.[1];
    if (most === undefined) {
      this.nothing('No innovation could be measured from x and P.');
      return;
    }
    const log = most > 12;
    const bands = kept.map(({q}) => q?.[3] ?? 0);
    const [lo, hi] = log ? extent([...points.map((v) => Math.max(v, 0.02)), 3], true)
                         : [-0.15, Math.max(most, Math.min(6, bands.reduce((a, b) => Math.max(a, b))) * 1.05)];
    this.frame({lo, hi, log, name: 'normalised innovation squared over the run'});
    this.drawBand();
    this.inside.append(svg('path', {class: 'one', d: `M0 ${this.y(1)}H${this.width}`}));
    points.forEach((value, k) => {
      if (!Number.isFinite(value)) return;
      const [, , low, high] = kept[k].q;
      const [x, y] = [this.x(placeOf(k)), this.y(Math.max(value, lo))];
      this.inside.append(value < low || value > high
        ? svg('path', {class: 'outside', d: `M${x} ${y - 4.5}L${x + 4.5} ${y}L${x} ${y + 4.5}L${x - 4.5} ${y}Z`})
        : svg('circle', {class: 'inside', cx: x, cy: y, r: 1.8}));
    });
    this.path({class: 'mean', style: 'stroke: var(--ink)'}, (_, k) => this.running[k]);
    const each = kept.some(({c}) => c > 2) ? 'each point: the records since the one kept before' : 'each point: one update';
    this.legend.replaceChildren(
      key(svg('circle', {class: 'inside', cx: 12, cy: 6, r: 2.5}), each),
      key(svg('path', {class: 'outside', d: 'M12 1L17 6L12 11L7 6Z'}), 'outside of the band'),
      key(svg('rect', {class: 'band', width: 24, height: 12}), '99 % of χ²'),
      lineKey({class: 'mean', style: 'stroke: var(--ink)'}, 'mean so far, 1 where the filter is right'));
  }

  drawBand() {
    const measured = kept.map((r, k) => [k, r.q]).filter(([, q]) => q);
    const edge = (part) => measured.map(([k, q]) => [this.x(placeOf(k)), this.y(this.log ? Math.max(q[part], 1e-6) : q[part])]);
    const d = `${pathOf(edge(3))}${pathOf(edge(2).reverse()).replace('M', 'L')}Z`;
    this.inside.prepend(svg('path', {class: 'band', d}));
  }

  describe(k) {
    const {q} = kept[k];
    const mean = Number.isFinite(this.running[k]) ? `mean so far ${format(this.running[k])}` : '';
    if (!q) return `no update here${mean ? `; ${mean}` : ''}`;
    const value = q[0] === null ? 'not finite' : format(q[0] / q[1]);
    return `${value} with ${q[1]} degrees of freedom (99 %: ${format(q[2])} … ${format(q[3])})${mean ? `; ${mean}` : ''}`;
  }
}

class HeadingPlot extends Plot {
  constructor() {
    super('heading', 170);
    this.caption.append('Variance of the heading P', html('sub', {}, 'θθ'), ', rad²');
  }

  draw() {
    const {floor, reason} = data.heading;
    const range = extent([...kept.map((r) => r.v[2]), floor], true);
    if (!range) {
      this.nothing('No record has a heading with a positive, finite variance.');
      return;
    }
    this.frame({lo: range[0], hi: range[1], log: true, name: 'variance of the heading over the run'});
    this.path({class: 'quantity'}, (r) => r.v[2]);
    const keys = [lineKey({class: 'quantity'}, 'variance')];
    if (floor) {
      const y = this.y(floor);
      this.inside.append(svg('path', {class: 'floor', d: `M0 ${y}H${this.width}`}));
      keys.push(lineKey({class: 'floor'}, 'floor: 0.99 of the first; relative sensing can’t go below'));
    } else {
      keys.push(`no floor${reason ? `: ${reason}` : ''}`);
    }
    this.legend.replaceChildren(...keys);
  }

  describe(k) {
    const variance = kept[k].v[2];
    if (variance === null) return 'not finite';
    return `${format(variance)} rad²` + (variance >= 0 ? ` (σ = ${format(degrees(Math.sqrt(variance)))}°)` : '');
  }
}
