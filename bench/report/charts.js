// Sweeps as lines with bands, methods as bars, passes as stacked bars.
// SPDX-License-Identifier: Apache-2.0

Chart.defaults.animation = false;
Chart.defaults.maintainAspectRatio = false;
Chart.defaults.plugins.legend.labels.boxWidth = 14;
Chart.defaults.font.family = 'system-ui, "Segoe UI", "DejaVu Sans", sans-serif';

const AXES = {lights: 'lights', size: 'picture', spots: 'share of spots', range: 'range of lights, m', path: 'shading path'};

function axisTitle(text) {
  return {display: true, text};
}

/** Ticks of a logarithmic axis at `values`, without those whose labels would run into the one before. */
function ticksAt(values, axis) {
  let free = -Infinity;
  axis.ticks = values.filter(value => value >= axis.min && value <= axis.max).map(value => ({value})).filter(({value}) => {
    const [at, room] = axis.isHorizontal() ? [axis.width, 12 + 7 * value.toLocaleString('en-US').length] : [axis.height, 16];
    const place = at * Math.log(value / axis.min) / Math.log(axis.max / axis.min);
    if (place < free) return false;
    free = place + room;
    return true;
  });
}

/** The same at 1, 2 and 5 of each power of ten, or at the powers alone where these are many. */
function decadeTicks(axis) {
  const decades = Math.log10(axis.max / axis.min);
  const steps = decades < 1 ? [1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9] : decades < 4 ? [1, 2, 5] : [1];
  const values = [];
  for (let power = Math.floor(Math.log10(axis.min)); power <= Math.log10(axis.max); ++power)
    values.push(...steps.map(step => step * 10 ** power));
  ticksAt(values, axis);
}

/** An axis of values, from 0 unless it is logarithmic. */
function valueAxis(y, isLog) {
  return {
    type: isLog ? 'logarithmic' : 'linear', title: axisTitle(DATA.words[y]), beginAtZero: !isLog,
    afterBuildTicks: isLog ? decadeTicks : undefined, ticks: {callback: value => short(value)},
  };
}

/** Draws p5 to p95 over bars whose datasets carry `whiskers`, one [low, high] or null a bar. */
const WHISKERS = {
  id: 'whiskers',
  afterDatasetsDraw(chart) {
    const g = chart.ctx;
    const area = chart.chartArea;
    g.save();
    g.beginPath();
    g.rect(area.left, area.top, area.width, area.height);
    g.clip();
    g.strokeStyle = ink('ink');
    g.lineWidth = 1.25;
    chart.data.datasets.forEach((dataset, i) => {
      if (!dataset.whiskers || !chart.isDatasetVisible(i)) return;
      const upright = chart.options.indexAxis !== 'y';
      const scale = upright ? chart.scales.y : chart.scales.x;
      chart.getDatasetMeta(i).data.forEach((bar, j) => {
        if (!dataset.whiskers[j]) return;
        const [low, high] = dataset.whiskers[j].map(value => scale.getPixelForValue(value));
        g.beginPath();
        if (upright) {
          g.moveTo(bar.x, low); g.lineTo(bar.x, high);
          for (const end of [low, high]) { g.moveTo(bar.x - 3, end); g.lineTo(bar.x + 3, end); }
        } else {
          g.moveTo(low, bar.y); g.lineTo(high, bar.y);
          for (const end of [low, high]) { g.moveTo(end, bar.y - 3); g.lineTo(end, bar.y + 3); }
        }
        g.stroke();
      });
    });
    g.restore();
  },
};

/** Median lines, each followed by the edges of its band. */
function sweepDatasets(run, panel, y) {
  return panel.lines.flatMap(line => {
    const {color, dash, mark} = style(line.label);
    const points = line.points.map(p => ({x: p.x, of: spread(run.results[p.result], y)})).filter(p => p.of);
    const edge = (key, fill) => ({
      label: line.label, band: true, data: points.map(p => ({x: p.x, y: p.of[key]})), borderWidth: 0, pointRadius: 0,
      pointHitRadius: 0, fill, backgroundColor: faded(color, 0.16),
    });
    return [
      {
        label: line.label, data: points.map(p => ({x: p.x, y: p.of.median, of: p.of})), borderColor: color,
        backgroundColor: color, borderDash: dash, pointStyle: mark, pointRadius: 3.5, borderWidth: 2, tension: 0, clip: 8,
      },
      edge('p5', false), edge('p95', '-1'),
    ];
  });
}

/** A click on a name hides its line and its band. */
function toggleLine(event, item, legend) {
  const chart = legend.chart;
  const visible = !chart.isDatasetVisible(item.datasetIndex);
  for (let i = 0; i < 3; ++i) chart.setDatasetVisibility(item.datasetIndex + i, visible);
  chart.update();
}

function sweepChart(run, panel, state) {
  const xs = [...new Set(panel.lines.flatMap(line => line.points.map(p => p.x)))].sort((a, b) => a - b);
  return {
    type: 'line',
    data: {datasets: sweepDatasets(run, panel, state.y)},
    options: {
      interaction: {mode: 'x', intersect: false},
      scales: {
        x: {
          type: state.logX ? 'logarithmic' : 'linear', title: axisTitle(AXES[panel.x] || panel.x),
          ...(xs.length > 1 ? {min: xs[0], max: xs[xs.length - 1]} : {}),
          afterBuildTicks: state.logX ? axis => ticksAt(xs, axis) : undefined,
          ticks: {callback: value => Number(value).toLocaleString('en-US'), maxRotation: 0, autoSkip: !state.logX, autoSkipPadding: 12},
        },
        y: valueAxis(state.y, state.logY),
      },
      plugins: {
        legend: {position: 'bottom', onClick: toggleLine,
                 labels: {usePointStyle: true, filter: (item, data) => !data.datasets[item.datasetIndex].band}},
        tooltip: {
          filter: item => !item.dataset.band, itemSort: (a, b) => b.parsed.y - a.parsed.y,
          callbacks: {
            title: items => items.length ? `${items[0].parsed.x.toLocaleString('en-US')} ${panel.x}` : '',
            label: item => `${item.dataset.label}: ${short(item.parsed.y)}` +
              (TIMES.includes(state.y) ? `  (p5 ${short(item.raw.of.p5)}, p95 ${short(item.raw.of.p95)})` : ''),
          },
        },
      },
    },
  };
}

/** One group of bars a value of x, one bar a line. */
function groupedChart(run, panel, state) {
  const xs = [...new Set(panel.lines.flatMap(line => line.points.map(p => p.x)))];
  const datasets = panel.lines.map(line => {
    const of = xs.map(x => {
      const point = line.points.find(p => p.x === x);
      return point ? spread(run.results[point.result], state.y) : null;
    });
    return {
      label: line.label, data: of.map(s => s && s.median), backgroundColor: style(line.label).color, maxBarThickness: 34,
      whiskers: TIMES.includes(state.y) ? of.map(s => s && [s.p5, s.p95]) : null,
    };
  });
  return {
    type: 'bar', plugins: [WHISKERS], data: {labels: xs.map(String), datasets},
    options: {
      scales: {
        x: {title: axisTitle(AXES[panel.x] || panel.x.replace('option:', 'option '))},
        y: valueAxis(state.y, state.logY),
      },
      plugins: {legend: {position: 'bottom'},
                tooltip: {callbacks: {label: item => `${item.dataset.label}: ${short(item.parsed.y)}`}}},
    },
  };
}

/** Where an axis of bars ends: bars far beyond the others are cut, and named under the chart. */
function cutOf(values) {
  const sorted = values.filter(v => v > 0).sort((a, b) => a - b);
  if (sorted.length < 4) return null;
  const limit = 4 * sorted[Math.floor(sorted.length / 2)];
  if (sorted[sorted.length - 1] <= limit) return null;
  return 1.15 * sorted.filter(v => v <= limit).pop();
}

function horizontal(labels, datasets, title, cut, more = {}) {
  return {
    type: 'bar', plugins: [WHISKERS], height: 70 + 24 * labels.length + (more.legend === false ? 0 : 40), data: {labels, datasets},
    options: {
      indexAxis: 'y',
      interaction: {mode: 'index', axis: 'y', intersect: false},
      scales: {x: {stacked: true, max: cut || undefined, title: axisTitle(title),
                   ticks: {includeBounds: false, callback: value => short(value)}},
               y: {stacked: true, ticks: {autoSkip: false}, grid: {display: false}}},
      plugins: {legend: {position: 'bottom', display: more.legend !== false},
                tooltip: {filter: item => item.parsed.x > 0,
                          callbacks: {label: item => `${item.dataset.label}: ${short(item.parsed.x)}`}}},
    },
  };
}

/** Rows of a chart over methods, the least first. */
function methodRows(run, panel, y) {
  return panel.lines.flatMap(line => line.points).map(p => ({label: p.x, result: run.results[p.result]}))
    .map(row => ({...row, of: spread(row.result, y)})).filter(row => row.of)
    .sort((a, b) => a.of.median - b.of.median);
}

function methodChart(run, panel, state) {
  const rows = methodRows(run, panel, state.y);
  const cut = cutOf(rows.map(row => row.of.median));
  const hues = HUES[theme()];
  const bar = (label, key, color) => ({
    label, data: rows.map(row => row.result.times[key].median), backgroundColor: color, maxBarThickness: 18,
  });
  const datasets = state.y === 'cull+shade'
    ? [bar('cull', 'cull', hues[1]), bar('shade', 'shade', hues[0])]
    : [{label: DATA.words[state.y], data: rows.map(row => row.of.median), backgroundColor: hues[0], maxBarThickness: 18}];
  if (TIMES.includes(state.y)) datasets[datasets.length - 1].whiskers = rows.map(row => [row.of.p5, row.of.p95]);
  const made = horizontal(rows.map(row => row.label), datasets, DATA.words[state.y], cut, {legend: datasets.length > 1});
  made.beyond = rows.filter(row => cut && row.of.median > cut).map(row => `${row.label} ${short(row.of.median)}`);
  return made;
}

// From the first to the last shade of the passes of one part of the frame.
const PARTS = {
  cull: {light: ['#7a2f00', '#fbd3b4'], dark: ['#ffd2b0', '#9a4410']},
  shade: {light: ['#1f66c1', '#8fb8ea'], dark: ['#6ea8ff', '#2c62ad']},
  other: {light: ['#5b6170', '#c3c7cf'], dark: ['#b6bcc9', '#555b68']},
};

function shadeOf(part, place, count) {
  const [from, to] = PARTS[part][theme()].map(hex => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16)));
  const t = count > 1 ? place / (count - 1) : 0;
  return `rgb(${from.map((value, i) => Math.round(value + t * (to[i] - value))).join(',')})`;
}

/** Passes of the bars; what transparent surfaces take, their own cull included, is one. */
function passTimes(result) {
  const times = new Map();
  for (const pass of result.stats.passes) {
    if (pass.part === 'host') continue; // before the frame, not a part of it
    const name = pass.name.startsWith('transparent') ? 'transparent' : pass.name;
    const key = `${pass.part}: ${name}`;
    const before = times.get(key);
    times.set(key, {name, part: pass.part, ms: pass.ms_median + (before ? before.ms : 0)});
  }
  return times;
}

/** Median of every pass, one bar a method or line. */
function passChart(run, rows) {
  const times = rows.map(row => passTimes(row.result));
  const order = ['cull', 'shade', 'other'];
  const all = [...new Map(times.flatMap(t => [...t])).entries()];
  all.sort((a, b) => order.indexOf(a[1].part) - order.indexOf(b[1].part));
  const cut = cutOf(rows.map(row => row.result.stats.frame_ms));
  const datasets = all.map(([key, {name, part}]) => {
    const peers = all.filter(([, other]) => other.part === part);
    return {
      label: part === 'cull' ? key : name, backgroundColor: shadeOf(part, peers.findIndex(([other]) => other === key), peers.length),
      maxBarThickness: 18, data: times.map(t => t.has(key) ? t.get(key).ms : 0),
    };
  });
  const made = horizontal(rows.map(row => row.label), datasets, 'medians of the passes, ms', cut);
  made.height += 22 * Math.floor(datasets.length / 6);
  made.beyond = rows.filter(row => cut && row.result.stats.frame_ms > cut).map(row => `${row.label} ${short(row.result.stats.frame_ms)}`);
  return made;
}
