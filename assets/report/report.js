'use strict';
const root = document.documentElement;
const setTheme = name => {
  root.dataset.theme = name;
  document.getElementById('theme').textContent = name === 'dark' ? 'Light' : 'Dark';
};
const dark = matchMedia('(prefers-color-scheme: dark)');
setTheme(dark.matches ? 'dark' : 'light');
dark.addEventListener('change', event => setTheme(event.matches ? 'dark' : 'light'));
document.getElementById('theme').addEventListener('click', () => setTheme(root.dataset.theme === 'dark' ? 'light' : 'dark'));

const failing = document.getElementById('failing');
failing.addEventListener('click', () => {
  const on = document.body.classList.toggle('only-failing');
  failing.setAttribute('aria-pressed', on);
});

// One viewer a scenario: the slider moves all three pictures, pointing at golden or actual swaps the two.
for (const viewer of document.querySelectorAll('.viewer')) {
  const frames = JSON.parse(viewer.querySelector('script').textContent);
  const slider = viewer.querySelector('input');
  const figures = Object.fromEntries([...viewer.querySelectorAll('figure')].map(f => [f.dataset.kind, f]));
  const names = {golden: 'Golden', actual: 'Actual', difference: 'Difference × 16'};
  let now = null;
  const stops = frames.map((frame, i) => {
    const stop = document.createElement('button');
    stop.className = frame.verdict;
    stop.textContent = frame.frame;
    stop.title = frame.label + ': ' + frame.verdict;
    stop.tabIndex = -1;
    stop.addEventListener('click', () => { slider.value = i; show(i); });
    viewer.querySelector('.stops').append(stop);
    return stop;
  });
  const source = kind => kind === 'actual' && now.same ? now.golden : now[kind];
  const put = (kind, shown, swapped) => {
    const figure = figures[kind], image = figure.querySelector('img'), data = source(shown);
    figure.querySelector('b').textContent = names[shown];
    figure.querySelector('.frame').classList.toggle('swapped', swapped);
    figure.querySelector('.none').hidden = Boolean(data);
    image.hidden = !data;
    if (data) image.src = 'data:image/png;base64,' + data; else image.removeAttribute('src');
    const box = figure.querySelector('svg'), isMarked = Boolean(data) && now.tile[2] > 0;
    box.style.display = isMarked ? '' : 'none';
    box.setAttribute('viewBox', '0 0 ' + now.size.join(' '));
    for (const rect of box.querySelectorAll('rect'))
      ['x', 'y', 'width', 'height'].forEach((name, i) => rect.setAttribute(name, now.tile[i]));
    image.alt = names[shown] + ', frame ' + now.frame;
    figure.dataset.shown = shown;
  };
  const show = index => {
    now = frames[index];
    viewer.dataset.key = now.key;
    for (const kind of ['golden', 'actual', 'difference']) put(kind, kind, false);
    viewer.querySelector('.where').textContent = now.label;
    stops.forEach((stop, i) => stop.classList.toggle('on', i === index));
    const mark = viewer.querySelector('.scrub .mark');
    mark.className = 'mark ' + now.verdict;
    mark.textContent = now.verdict;
    const reason = viewer.querySelector('.reason');
    reason.hidden = !now.reason;
    reason.className = 'reason ' + now.verdict;
    reason.querySelector('span').textContent = now.reason;
    viewer.querySelector('.figures').textContent = now.reason ? '' : now.figures;
    viewer.querySelector('.why').textContent = now.why ? '“' + now.why + '”' : '';
    viewer.querySelector('.made').textContent = now.madeBy;
  };
  for (const [kind, other] of [['golden', 'actual'], ['actual', 'golden']]) {
    const frame = figures[kind].querySelector('.frame');
    frame.addEventListener('pointerenter', () => { if (now.golden && source('actual')) put(kind, other, true); });
    frame.addEventListener('pointerleave', () => put(kind, kind, false));
  }
  slider.addEventListener('input', () => show(Number(slider.value)));
  show(Number(slider.value));
}

for (const button of document.querySelectorAll('.copy'))
  button.addEventListener('click', async () => {
    const text = button.parentElement.querySelector('code').textContent;
    try { await navigator.clipboard.writeText(text); button.textContent = 'Copied'; }
    catch { getSelection().selectAllChildren(button.parentElement.querySelector('code')); button.textContent = 'Selected'; }
    setTimeout(() => { button.textContent = 'Copy'; }, 1500);
  });
