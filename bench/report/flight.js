// A flight's frames: by lights with moving averages, and in their order.
// SPDX-License-Identifier: Apache-2.0

function sampleValue(sample, y) {
  if (y === 'cull+shade') return sample.cull + sample.shade;
  return y === 'frame' ? sample.frame_ms : sample[y];
}

function flightAxes(panel, x) {
  return {
    x: {type: 'linear', title: axisTitle(x), ticks: {maxRotation: 0}, grace: 0},
    y: {beginAtZero: true, title: axisTitle(DATA.words[panel.y]), ticks: {callback: value => short(value)}},
  };
}

function flightLines(run, panel) {
  return panel.lines.map(line => ({label: line.label, samples: run.results[line.points[0].result].samples || []}));
}

function scatterChart(run, panel) {
  const points = flightLines(run, panel).map(line => ({
    type: 'scatter', label: line.label, points: true, data: line.samples.map(s => ({x: s.lights, y: sampleValue(s, panel.y)})),
    backgroundColor: faded(style(line.label).color, 0.35), borderWidth: 0, pointRadius: 2.5, order: 2,
  }));
  const averages = panel.trends.map(trend => ({
    type: 'line', label: trend.label, data: trend.points.map(([x, y]) => ({x, y})), borderColor: style(trend.label).color,
    backgroundColor: style(trend.label).color, borderWidth: 2.5, pointRadius: 0, order: 1,
  }));
  return {
    type: 'scatter', data: {datasets: [...averages, ...points]},
    options: {
      scales: flightAxes(panel, 'lights'),
      plugins: {
        legend: {position: 'bottom', labels: {filter: (item, data) => !data.datasets[item.datasetIndex].points}},
        tooltip: {filter: item => item.dataset.points,
                  callbacks: {label: item => `${item.dataset.label}: ${short(item.parsed.y)} ms, ${item.parsed.x} lights`}},
      },
    },
  };
}

function timelineChart(run, panel) {
  const lines = flightLines(run, panel);
  const datasets = lines.map(line => ({
    label: line.label, data: line.samples.map(s => ({x: s.frame, y: sampleValue(s, panel.y)})),
    borderColor: style(line.label).color, backgroundColor: style(line.label).color, borderWidth: 1.5, pointRadius: 0,
  }));
  datasets.push({
    label: 'lights (right axis)', data: lines[0].samples.map(s => ({x: s.frame, y: s.lights})), yAxisID: 'count', fill: true,
    borderWidth: 0, backgroundColor: faded(ink('soft'), 0.14), pointRadius: 0, order: 9,
  });
  const scales = flightAxes(panel, 'frame of the flight');
  scales.x.max = Math.max(...lines[0].samples.map(s => s.frame));
  scales.count = {position: 'right', title: axisTitle('lights'), grid: {display: false}, beginAtZero: true};
  return {
    type: 'line', data: {datasets},
    options: {scales, interaction: {mode: 'x', intersect: false}, plugins: {legend: {position: 'bottom'}, tooltip: {
      callbacks: {title: items => items.length ? `frame ${items[0].parsed.x}` : '',
                  label: item => `${item.dataset.label}: ${short(item.parsed.y)}`}}}},
  };
}
