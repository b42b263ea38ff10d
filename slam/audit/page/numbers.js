// SPDX-License-Identifier: MIT
// The chosen record in numbers.
class Numbers {
  constructor() {
    this.section = document.getElementById('numbers');
    views.push(this);
  }

  draw() { this.choose(); }

  choose() {
    const record = kept[chosen];
    const list = html('dl');
    const add = (name, value, style = '') => {
      if (value) list.append(html('dt', {}, name), html('dd', style ? {class: style} : {}, value));
    };
    add('record', `${record.n}, ${record.e}, t = ${record.t.toFixed(3)} s`);
    if (record.c > 1) add('', `with the ${record.c - 1} before it that are not drawn:`);
    add('broken here', brokenAt(record).join(', '), 'bad');
    add('blamed here', (record.b ?? []).length ? ranges(record.b) : '', 'bad');
    add('observed', record.o ? ranges([...record.o].sort((a, b) => a - b)) || 'nothing' : 'not in the log');
    if (data.means_known) this.pose(record, add);
    this.extremes(record, add);
    this.clusters(record, add);
    this.section.replaceChildren(list);
  }

  pose(record, add) {
    const sigma = record.v.map((variance) => (variance === null ? NaN : Math.sqrt(variance)));
    const both = (value, deviation, unit) =>
      `${value === null ? 'not finite' : format(value, 4)} ± ${Number.isFinite(deviation) ? format(deviation) : 'not finite'} ${unit}`;
    add('x ± σ', both(record.p[0], sigma[0], 'm'));
    add('y ± σ', both(record.p[1], sigma[1], 'm'));
    add('θ ± σ', both(record.p[2] === null ? null : degrees(record.p[2]), degrees(sigma[2]), '°'));
  }

  extremes(record, add) {
    add('features', String(record.f));
    const pairs = pairsOf(record.i).map((pair) => [pair, sizeOf(record, ...pair)]).filter(([, size]) => size >= 0);
    if (pairs.length === 0) return;
    const most = pairs.reduce((a, b) => (b[1] > a[1] ? b : a));
    const least = pairs.reduce((a, b) => (b[1] < a[1] ? b : a));
    add('greatest pair', `${most[0].join(' and ')}: ${formatSize(most[1])}`);
    add('least pair', `${least[0].join(' and ')}: ${formatSize(least[1])}`);
  }

  clusters(record, add) {
    const count = Math.max(-1, ...record.k) + 1;
    if (count < 2) return;
    const words = Array.from({length: Math.min(count, 6)}, (_, c) => `${c + 1} {${ranges(membersOf(record, c))}}`);
    add('clusters', words.join('  ') + (count > 6 ? `  and ${count - 6} more` : ''));
  }
}
