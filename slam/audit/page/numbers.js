// SPDX-License-Identifier: MIT
// The chosen record in numbers.

// The first of a list of features; `all` is how many there are, where more than stand in it.
function some(ids, all = ids.length) {
  const shown = [...ids].sort((a, b) => a - b).slice(0, 20);
  return ranges(shown) + (all > shown.length ? ` and ${all - shown.length} more` : '');
}

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
    if (record.l) {
      const laws = record.l.flatMap((index) => [html('span', {class: `bad ${data.laws[index].class}`}, data.laws[index].name), ' ']);
      list.append(html('dt', {}, 'broken here'), html('dd', {}, ...laws));
    }
    if (record.l && record.c > 1) add('', record.c > 2 ? `or in the ${record.c - 1} records before it, which are not drawn` : 'or in the record before it, which is not drawn');
    add('blamed here', record.b ? some(record.b) : '', 'bad code');
    add('observed', record.o ? some(record.o, record.on) || 'nothing' : 'not in the log');
    if (data.means_known) this.pose(record, add);
    this.extremes(record, add);
    this.clusters(record, add);
    this.section.replaceChildren(list);
  }

  pose(record, add) {
    const sigma = record.v.map((variance) => (variance === null ? NaN : Math.sqrt(variance)));
    // As many places as σ has.
    const both = (value, deviation, unit) => {
      const places = deviation > 0 ? Math.min(9, Math.max(0, 2 - Math.floor(Math.log10(deviation)))) : 4;
      const number = value === null ? 'not finite' : value.toFixed(places).replace('-', '−');
      return `${number} ± ${format(deviation)} ${unit}`;
    };
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
    const words = Array.from({length: Math.min(count, 6)}, (_, c) => `${c + 1}: ${some(membersOf(record, c))}`);
    add('clusters', words.join('; ') + (count > 6 ? `  and ${count - 6} more` : ''));
  }
}
