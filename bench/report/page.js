// Puts the page together.
// SPDX-License-Identifier: Apache-2.0

/** The values that a panel's results have, for the menu of its y axis. */
function valuesOf(run, panel) {
  const results = panel.lines.flatMap(line => line.points.map(p => run.results[p.result]));
  return Object.keys(DATA.words).filter(y => results.some(r => spread(r, y))).map(y => [y, DATA.words[y]]);
}

function note(text) {
  return el('p', {class: 'note'}, text);
}

/** A plot with a note that names bars beyond its scale. */
function cutPlot(label, configuration) {
  const beyond = note('');
  const made = plot(300, label, () => {
    const chart = configuration();
    beyond.textContent = chart.beyond.length ? `Cut at the edge: ${chart.beyond.join(', ')} ms.` : '';
    return chart;
  });
  return {...made, beyond};
}

function chartOf(panel) {
  if (panel.x === 'method') return methodChart;
  const numeric = panel.lines.every(line => line.points.every(p => typeof p.x === 'number'));
  return numeric ? sweepChart : groupedChart;
}

function mainPlot(run, panel) {
  const make = chartOf(panel);
  const state = {y: panel.y, logX: panel.log_x, logY: panel.log_y};
  const beyond = note('');
  const made = plot(400, `${panel.series}: ${DATA.words[panel.y]}`, () => {
    const chart = make(run, panel, state);
    beyond.textContent = chart.beyond && chart.beyond.length ? `Cut at the edge: ${chart.beyond.join(', ')}.` : '';
    return chart;
  });
  const toggle = (name, key) => {
    const box = el('input', {type: 'checkbox', onchange: () => { state[key] = box.checked; made.draw(); }});
    box.checked = state[key];
    return el('label', {}, box, name);
  };
  const controls = el('div', {class: 'controls'},
    choice('show', valuesOf(run, panel), state.y, y => { state.y = y; made.draw(); }));
  if (make === sweepChart) controls.append(toggle(`logarithmic ${AXES[panel.x] || panel.x}`, 'logX'));
  if (make !== methodChart) controls.append(toggle('logarithmic values', 'logY'));
  return [controls, made.box, beyond];
}

/** Rows of the stacked bars: all of a chart over methods, else one x that the reader chooses. */
function passRows(run, panel, x) {
  if (panel.x === 'method') return methodRows(run, panel, 'frame');
  return panel.lines.flatMap(line => line.points.filter(p => String(p.x) === x)
    .map(p => ({label: line.label, result: run.results[p.result]}))).filter(row => row.result.times);
}

function passPlot(run, panel) {
  const xs = [...new Set(panel.lines.flatMap(line => line.points.map(p => String(p.x))))];
  let x = xs[xs.length - 1];
  const made = cutPlot('medians of the passes', () => passChart(run, passRows(run, panel, x)));
  const parts = [el('h3', {}, 'Where the time goes')];
  if (panel.x !== 'method' && xs.length > 1)
    parts.push(el('div', {class: 'controls'}, choice(AXES[panel.x] || panel.x, xs.map(v => [v, v]), x, v => { x = v; made.draw(); })));
  return [...parts, made.box, made.beyond];
}

function panelPart(run, panel) {
  const parts = panel.where ? [el('h3', {}, panel.where)] : [];
  parts.push(words(panel.summary));
  if (panel.flight) {
    const label = `${panel.series}: ${DATA.words[panel.y]}`;
    parts.push(plot(400, label + ' by lights', () => scatterChart(run, panel)).box,
      note('Every frame of the flight is a dot; lines are moving averages over the number of lights.'),
      plot(320, label + ' by frame', () => timelineChart(run, panel)).box);
    return parts;
  }
  parts.push(...mainPlot(run, panel));
  if (TIMES.includes(panel.y) && chartOf(panel) !== groupedChart) parts.push(...passPlot(run, panel));
  return parts;
}

function seriesPart(run, series) {
  const results = run.results.filter(r => r.series === series.name);
  if (results.length === 0) return null;
  const part = el('section', {class: 'card', id: `series-${run.place}-${series.name}`}, el('h2', {}, series.title), el('p', {class: 'soft'}, series.about),
    note(`The same in all: ${commonParameters(series, results)}.`));
  for (const panel of run.panels.filter(p => p.series === series.name)) part.append(...panelPart(run, panel));
  part.append(...pictureSection(run, series.name), el('h3', {}, 'All numbers'), resultTable(results), ...remarks(results));
  return part;
}

function tile(text, value, kind = '') {
  return el('div', {class: `tile ${kind}`}, el('span', {class: 'soft'}, text), el('b', {}, value));
}

function tiles(run) {
  const count = verdict => run.results.filter(r => r.verdict === verdict).length;
  const made = [tile('device', run.run.device, 'text'), tile('configurations', run.results.length), tile('verified exact', count('exact'))];
  for (const [verdict, text] of [['approximate', 'approximate'], ['unverified', 'not verified'], ['could not check', 'could not check'], ['wrong', 'wrong'], ['impossible', 'could not run']])
    if (count(verdict)) made.push(tile(text, count(verdict), verdict === 'wrong' ? 'wrong' : ''));
  return el('div', {class: 'tiles'}, ...made);
}

function facts(run) {
  const rows = [['command', el('code', {}, run.run.command)], ['device', `${run.run.device} (${run.run.device_kind})`], ['driver', run.run.driver],
                ['commit', el('code', {}, run.run.commit)], ['begun', run.run.date], ['suite', run.suite.name]];
  if (run.run.shaders && run.run.shaders !== 'built in') rows.push(['shaders', `of --shader-dir, hash ${run.run.shaders}`]);
  if (run.run.pipeline_statistics === 'on') rows.push(['pipeline statistics', 'on: drivers may compile other pipelines']);
  if (run.suite.source) rows.push(['after', run.suite.source]);
  rows.push(['how', 'GPU timestamps. Warm-up, then rounds in which every method renders the same frame once; lights move every frame. ' +
    'Median with p5 and p95. cull: from clearing the plan\'s buffers to the end of its last pass, with depth and lights resident. ' +
    'Every output was held against the oracle and brute force in this run, as the column "output" says.']);
  return el('dl', {class: 'facts'}, ...rows.flatMap(([name, value]) => [el('dt', {}, name), el('dd', {}, value)]));
}

function comparisonPart() {
  const [a, b] = DATA.runs;
  const c = DATA.comparison;
  return el('section', {class: 'card', id: 'comparison'}, el('h2', {}, 'B against A'),
    el('p', {class: 'soft'}, `A: ${a.file}, ${a.run.device}, commit ${a.run.commit}. B: ${b.file}, ${b.run.device}, commit ${b.run.commit}.`),
    words([`${c.rows.length + c.other_scene} configurations were timed in both runs; ${c.only_a} in A alone, ${c.only_b} in B alone.`,
           ...(c.other_scene ? [`${c.other_scene} are left out: the files of their scene changed between the runs.`] : []),
           'Ratios are the time of B over the time of A, geometric means over configurations: under 1, B is faster.',
           ...(a.run.device !== b.run.device ? ['The devices differ: how methods rank within each run is the claim, the ratios are context.'] : [])]),
    ...comparisonTables(c));
}

function runPart(run) {
  const name = DATA.runs.length > 1 ? `${'AB'[run.place]}: ` : '';
  const parts = [];
  if (name) parts.push(el('h1', {}, name + run.suite.title));
  parts.push(tiles(run), el('section', {class: 'card'}, el('h2', {}, 'In short'),
    words([...run.summary, ...run.panels.filter(p => p.summary.length)
      .map(p => `${run.suite.series.find(s => s.name === p.series).title}${p.where ? `, ${p.where}` : ''}. ${p.summary[0]}`)])));
  const sections = run.suite.series.map(series => seriesPart(run, series)).filter(part => part);
  if (sections.length > 1)
    parts.push(el('nav', {'aria-label': 'series'}, ...sections.map(s => el('a', {href: `#${encodeURIComponent(s.id)}`}, s.querySelector('h2').textContent))));
  return [...parts, ...sections, el('section', {class: 'card'}, el('h2', {}, 'How this was measured'), facts(run))];
}

function build() {
  const dark = window.matchMedia && matchMedia('(prefers-color-scheme: dark)').matches;
  document.documentElement.dataset.theme = dark ? 'dark' : 'light';
  DATA.runs.forEach((run, place) => { run.place = place; });
  const suite = DATA.runs[0].suite;
  const head = el('header', {}, el('div', {}, el('p', {class: 'kicker'}, DATA.comparison ? 'Lamplight: two runs' : 'Lamplight: light culling measured'),
    el('h1', {}, suite.title), el('p', {class: 'soft'}, suite.about)),
    el('button', {id: 'theme', onclick: () => setTheme(theme() === 'dark' ? 'light' : 'dark')}, 'light / dark'));
  document.getElementById('page').replaceChildren(head, ...(DATA.comparison ? [comparisonPart()] : []), ...DATA.runs.flatMap(runPart));
  setTheme(theme());
  window.addEventListener('beforeprint', () => setTheme('light'));
}

build();
