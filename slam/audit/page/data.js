// SPDX-License-Identifier: MIT
// What C++ wrote (report_page_data.cpp), made easy to ask.
const data = JSON.parse(document.getElementById('data').textContent);
const kept = data.kept;

// Features of the matrix and their clusters stand only where they changed.
let sameIds = [];
let sameClusters = [];
for (const record of kept) {
  sameIds = record.i ??= sameIds;
  sameClusters = record.k ??= sameClusters;
}

// From the record where it was blamed first; of laws that speak of the whole run, from theirs.
const blamedFrom = new Map(data.blamed.map(({id, first}) => {
  const seen = kept.find((record) => record.b?.includes(id));
  return [id, seen ? seen.n : first];
}));
const brokenLaws = data.laws.filter((law) => law.class);
const firstBreak = Math.min(...brokenLaws.map((law) => law.first));  // Infinity where whole
const allIds = [...new Set(kept.flatMap((record) => record.i))];
const isBlamed = (record, id) => record.n >= (blamedFrom.get(id) ?? Infinity);

// Records by number where numbers rise, as they should; else by their place.
const rising = kept.every((record, k) => k === 0 || record.n > kept[k - 1].n);
const placeOf = (k) => (rising ? kept[k].n : k);

function nearestKept(place) {
  let best = 0;
  for (let k = 1; k < kept.length; ++k) {
    if (Math.abs(placeOf(k) - place) < Math.abs(placeOf(best) - place)) best = k;
  }
  return best;
}

// The newest kept record that is not after record `n`.
function keptAt(n) {
  let found = 0;
  kept.forEach((record, k) => { if (record.n <= n) found = k; });
  return found;
}

// The last whole record: the measure of growth.
const lastWhole = kept.findLastIndex((record) => record.n < firstBreak);

// √det of the lower triangle: NaN not finite, −1 not positive.
function sizesOf(record) {
  if (record.sizes) return record.sizes;
  const bytes = atob(record.m);
  const [lo, hi] = data.range;
  record.sizes = Float64Array.from({length: bytes.length / 2}, (_, k) => {
    const code = bytes.charCodeAt(2 * k) + 256 * bytes.charCodeAt(2 * k + 1);
    if (code < 4) return [NaN, NaN, -1, 0][code];
    return 10 ** (lo + ((code - 4) / 65531) * (hi - lo));
  });
  record.place = new Map(record.i.map((id, k) => [id, k]));
  return record.sizes;
}

// undefined where one of them is not in the matrix of that record.
function sizeOf(record, a, b) {
  const sizes = sizesOf(record);
  const i = record.place.get(a);
  const j = record.place.get(b);
  if (i === undefined || j === undefined) return undefined;
  const [low, high] = i < j ? [i, j] : [j, i];
  return sizes[(high * (high + 1)) / 2 + low];
}

function pairsOf(ids) {
  const pairs = [];
  for (let i = 1; i < ids.length; ++i) {
    for (let j = 0; j < i; ++j) pairs.push([ids[j], ids[i]]);
  }
  return pairs;
}

// "1–5, 8"
function ranges(ids) {
  const words = [];
  for (let k = 0; k < ids.length;) {
    let end = k;
    while (end + 1 < ids.length && ids[end + 1] === ids[end] + 1) ++end;
    words.push(end > k + 1 ? `${ids[k]}–${ids[end]}` : ids.slice(k, end + 1).join(', '));
    k = end + 1;
  }
  return words.join(', ');
}

const membersOf = (record, cluster) => record.i.filter((_, k) => record.k[k] === cluster);
