// SPDX-License-Identifier: MIT
// Which record is chosen: by pointer, key, button, or #record=N in the address.
let waiting = false;

function choose(k, byUser = true) {
  const next = Math.max(0, Math.min(kept.length - 1, k));
  const changed = next !== chosen;
  chosen = next;
  if (byUser && changed) history.replaceState(null, '', `#record=${kept[chosen].n}`);
  if (waiting) return;
  waiting = true;  // once a frame, however fast the pointer
  requestAnimationFrame(() => {
    waiting = false;
    for (const view of views) view.choose();
  });
}

function pick(a, b) {
  const again = picked && picked[0] === a && picked[1] === b;
  picked = again ? null : [a, b];
  drawAll();
}

function drawAll() {
  for (const view of views) {
    view.draw();
    view.choose();
  }
}

function fromAddress() {
  const asked = /^#record=(\d+)$/.exec(location.hash);
  if (!asked) return false;
  choose(keptAt(Number(asked[1])), false);
  return true;
}

function onKey(event) {
  if (event.ctrlKey || event.altKey || event.metaKey || event.target.closest('pre, .wide')) return;
  const step = event.shiftKey ? 10 : 1;
  const onLine = event.target.getAttribute('role') === 'slider';
  if (event.key === 'ArrowLeft') choose(chosen - step);
  else if (event.key === 'ArrowRight') choose(chosen + step);
  else if (event.key === 'Home' && onLine) choose(0);
  else if (event.key === 'End' && onLine) choose(kept.length - 1);
  else return;
  event.preventDefault();
}

function start() {
  if (kept.length === 0) {
    document.getElementById('run').replaceChildren(html('p', {class: 'legend'}, 'The run has no record.'));
    return;
  }
  new TimeLine();
  new PairsPlot();
  new NisPlot();
  new HeadingPlot();
  new Matrix();
  new Numbers();
  // Whole runs open at their end, others where the first law broke.
  if (!fromAddress()) choose(Number.isFinite(firstBreak) ? keptAt(firstBreak) : kept.length - 1, false);
  drawAll();
  addEventListener('hashchange', () => {
    if (fromAddress()) document.getElementById('timeline').scrollIntoView({block: 'nearest'});
  });
  document.addEventListener('keydown', onKey);
  document.getElementById('previous').addEventListener('click', () => choose(chosen - 1));
  document.getElementById('next').addEventListener('click', () => choose(chosen + 1));
  let width = document.body.clientWidth;
  new ResizeObserver(() => {
    if (document.body.clientWidth === width) return;
    width = document.body.clientWidth;
    requestAnimationFrame(drawAll);
  }).observe(document.body);
}

start();
