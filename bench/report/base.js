// Data, elements, numbers, colours, theme.
// SPDX-License-Identifier: Apache-2.0
'use strict';

const DATA = JSON.parse(document.getElementById('data').textContent);
const charts = [];

/** An element with attributes, listeners (onclick: ...) and children. */
function el(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
    else if (value !== null) element.setAttribute(key, value);
  }
  element.append(...children);
  return element;
}

/** Three significant digits, thousands grouped. */
function short(value) {
  if (value === null || value === undefined || Number.isNaN(value)) return '';
  if (value === 0) return '0';
  const decimals = Math.max(0, 2 - Math.floor(Math.log10(Math.abs(value))));
  return Number(value.toFixed(Math.min(decimals, 12))).toLocaleString('en-US', {maximumFractionDigits: 12});
}

const TIMES = ['cull', 'shade', 'cull+shade', 'frame'];

/** {median, p5, p95} of a result's value; null where it has none. */
function spread(result, y) {
  if (TIMES.includes(y)) return result.times ? result.times[y] : null;
  const value = y === 'bytes' ? result.stats.bytes && result.stats.bytes.total : result.stats[y];
  return typeof value === 'number' ? {median: value, p5: value, p95: value} : null;
}

// Ten hues that stay apart for most kinds of colour vision; dashes and marks tell their second use from the first.
const HUES = {
  light: ['#1f66c1', '#c4500c', '#23803d', '#8f3fae', '#b8860b', '#0b7c8c', '#c2255c', '#5b6170', '#6741d9', '#7c4a03'],
  dark: ['#6ea8ff', '#ff9a5c', '#6fd88a', '#d58bf0', '#f2c94c', '#46cfdf', '#ff7fa5', '#b6bcc9', '#a48bff', '#d9a066'],
};
const MARKS = ['circle', 'rect', 'triangle', 'rectRot', 'star', 'crossRot'];
const hueOf = new Map();

function style(label) {
  if (!hueOf.has(label)) hueOf.set(label, hueOf.size);
  const place = hueOf.get(label);
  const hues = HUES[theme()];
  return {
    color: hues[place % hues.length],
    dash: place >= hues.length ? [6, 4] : [],
    mark: MARKS[place % MARKS.length],
  };
}

function faded(color, share) {
  return color + Math.round(255 * share).toString(16).padStart(2, '0');
}

function theme() {
  return document.documentElement.dataset.theme;
}

function ink(name) {
  return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
}

function setTheme(name) {
  document.documentElement.dataset.theme = name;
  Chart.defaults.color = ink('soft');
  Chart.defaults.borderColor = ink('line');
  for (const draw of charts) draw();
}

/** A canvas that is drawn by `configuration()` now and whenever theme or controls change. */
function plot(height, label, configuration) {
  const canvas = el('canvas', {role: 'img', 'aria-label': label});
  const box = el('div', {class: 'plot', style: `height:${height}px`}, canvas);
  let chart = null;
  const draw = () => {
    if (chart) chart.destroy();
    const made = configuration();
    box.style.height = (made.height || height) + 'px';
    chart = new Chart(canvas, made);
  };
  charts.push(draw);
  return {box, draw};
}

function choice(text, options, chosen, onchange) {
  const select = el('select', {onchange: () => onchange(select.value)},
    ...options.map(([value, name]) => el('option', {value}, name)));
  select.value = chosen;
  return el('label', {}, text, select);
}

function words(sentences) {
  return el('ul', {class: 'words'}, ...sentences.map(sentence => el('li', {}, sentence)));
}
