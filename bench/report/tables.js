// Tables that sort by a click on a column's head.
// SPDX-License-Identifier: Apache-2.0

/** columns: {name, text?, title?, value(row), show?(row)}; numbers sort as numbers, what is missing comes last. */
function table(columns, rows) {
  const body = el('tbody');
  const heads = columns.map((column, i) => el('th', {class: column.text ? 'text' : null, scope: 'col', title: column.title || null},
    el('button', {onclick: () => sortBy(i)}, column.name)));
  const fill = sorted => body.replaceChildren(...sorted.map(row => el('tr', {}, ...columns.map(column => {
    const shown = column.show ? column.show(row) : column.value(row);
    return el('td', {class: column.text ? 'text' : null}, shown === null || shown === undefined ? '' : shown);
  }))));
  const sortBy = i => {
    const up = heads[i].getAttribute('aria-sort') !== 'ascending';
    heads.forEach(head => head.removeAttribute('aria-sort'));
    heads[i].setAttribute('aria-sort', up ? 'ascending' : 'descending');
    const missing = v => v === null || v === undefined || v === '';
    const order = (a, b) => {
      const [x, y] = [columns[i].value(a), columns[i].value(b)];
      if (missing(x) || missing(y)) return missing(x) - missing(y);
      const sign = typeof x === 'number' ? x - y : String(x).localeCompare(String(y));
      return up ? sign : -sign;
    };
    fill([...rows].sort(order));
  };
  fill(rows);
  return el('div', {class: 'scroll'}, el('table', {}, el('thead', {}, el('tr', {}, ...heads)), body));
}

function timeColumn(name, key) {
  return {
    name, title: 'median, and p5 to p95, milliseconds',
    value: r => r.times ? r.times[key].median : null,
    show: r => r.times ? el('span', {}, short(r.times[key].median), ' ', el('small', {}, `${short(r.times[key].p5)}–${short(r.times[key].p95)}`)) : '',
  };
}

function statColumn(name, key, title) {
  return {name, title, value: r => r.stats[key] === undefined ? null : r.stats[key],
          show: r => typeof r.stats[key] === 'number' ? short(r.stats[key]) : ''};
}

/** Passes on the CPU, ms, or null when there are none. */
function hostTime(result) {
  const host = (result.stats.passes || []).filter(pass => pass.part === 'host');
  return result.times && host.length ? host.reduce((sum, pass) => sum + pass.ms_median, 0) : null;
}

/** Registers of the shading pass, or null where the driver did not say. */
function shadeRegisters(result) {
  const shade = (result.stats.passes || []).find(pass => pass.part === 'shade' && pass.registers !== undefined);
  return shade ? shade.registers : null;
}

/** Of a result; null where it does not say, but for counts of what there is none of. */
function parameterOf(result, key) {
  return result.parameters[key] ?? (key === 'decals' || key === 'probes' ? 0 : null);
}

/** Parameters in which the results of a series differ: some say less than others. */
function changingParameters(results) {
  const keys = [...new Set(results.flatMap(r => Object.keys(r.parameters)))].filter(k => k !== 'method');
  return keys.filter(k => results.some(r => parameterOf(r, k) !== parameterOf(results[0], k)));
}

/** What all results of a series have in common, in words; where a flight changes lights, they are no part of it. */
function commonParameters(series, results) {
  const changing = [...changingParameters(results), 'method', ...(series.flight ? ['lights'] : [])];
  const first = ['scene', 'size', 'lights'];
  const keys = [...first, ...Object.keys(results[0].parameters).filter(key => !first.includes(key))];
  const shown = value => typeof value === 'number' ? value.toLocaleString('en-US') : value;
  return keys.filter(key => !changing.includes(key)).map(key => `${key.replace('option:', '')} ${shown(results[0].parameters[key])}`).join(', ');
}

function resultTable(results) {
  const parameters = changingParameters(results).map(k => ({
    name: k.replace('option:', ''), text: !results.some(r => typeof parameterOf(r, k) === 'number'), value: r => parameterOf(r, k),
    show: r => typeof parameterOf(r, k) === 'number' ? parameterOf(r, k).toLocaleString('en-US') : parameterOf(r, k),
  }));
  return table([
    {name: 'what', text: true, value: r => r.label}, ...parameters,
    {name: 'output', text: true, title: 'held against the oracle and brute force in this run', value: r => r.verdict,
     show: r => el('span', {class: r.verdict.replaceAll(' ', '-'), title: r.reason || null}, r.verdict)},
    ...(results.some(r => r.verified !== results[0].verified) ?
      [{name: 'checked', text: true, title: 'what of the picture was held against the oracle and brute force', value: r => r.verified}] : []),
    timeColumn('cull, ms', 'cull'), timeColumn('shade, ms', 'shade'), timeColumn('both, ms', 'cull+shade'), timeColumn('frame, ms', 'frame'),
    ...(results.some(r => hostTime(r) !== null) ?
      [{name: 'host, ms', title: 'passes on the CPU, before the GPU begins: sum of their medians', value: hostTime,
        show: r => hostTime(r) === null ? '' : short(hostTime(r))}] : []),
    ...(results.some(r => shadeRegisters(r) !== null) ?
      [{name: 'registers', title: 'of the shading pass, as the driver counts them', value: shadeRegisters}] : []),
    statColumn('list', 'list_mean', 'lights a cell, mean'), statColumn('longest', 'list_max', 'lights a cell, longest list'),
    statColumn('waste', 'waste', 'lights walked for each that reaches its pixel'),
    statColumn('excess', 'excess', 'length of the lists over the lights that reach the cell'),
    statColumn('missed', 'missed', 'pairs of pixel and light that the method did not find'),
    ...(results.some(r => r.stats.overflowed_cells) ?
      [statColumn('overflow', 'overflowed_cells', 'cells whose list overflowed and that walk all lights')] : []),
    {name: 'MB', title: 'all buffers of the method', value: r => r.stats.bytes ? r.stats.bytes.total / 1e6 : null,
     show: r => r.stats.bytes ? short(r.stats.bytes.total / 1e6) : ''},
  ], results);
}

/** Why results are not exact, and what the device made otherwise than was asked: each text once, with whose it is. */
function remarks(results) {
  const labels = new Map();
  const add = (text, label) => text && labels.set(text, (labels.get(text) || new Set()).add(label));
  for (const r of results) {
    if (r.verdict !== 'exact') add(r.reason, r.label);
    for (const text of r.stats.notes || []) add(text, r.label);
  }
  if (labels.size === 0) return [];
  return [el('ul', {class: 'soft'}, ...[...labels].map(([text, whose]) => el('li', {}, `${[...whose].join(', ')}: ${text}`)))];
}

function ratioColumn(name, key) {
  return {name, title: 'time of B over time of A: under 1, B is faster', value: r => r[key] || null,
          show: r => r[key] ? el('span', {class: r[key] < 0.98 ? 'better' : r[key] > 1.02 ? 'worse' : null}, short(r[key])) : ''};
}

function comparisonTables(comparison) {
  const ratios = [ratioColumn('cull', 'cull'), ratioColumn('cull and shade', 'cull+shade'), ratioColumn('frame', 'frame')];
  const [a, b] = DATA.runs;
  const median = (name, run, side) => ({
    name, title: 'cull and shade, median, ms', value: r => run.results[r[side]].times['cull+shade'].median,
    show: r => short(run.results[r[side]].times['cull+shade'].median)});
  return [
    table([{name: 'series', text: true, value: r => r.series}, {name: 'what', text: true, value: r => r.label},
           {name: 'configurations', value: r => r.count}, ...ratios], comparison.lines),
    el('details', {}, el('summary', {}, 'Every configuration'),
      table([{name: 'configuration', text: true, value: r => r.key}, {name: 'what', text: true, value: r => r.label},
             median('A, ms', a, 'a'), median('B, ms', b, 'b'), ...ratios], comparison.rows)),
  ];
}
