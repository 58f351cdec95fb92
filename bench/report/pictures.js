// Two pictures or heat maps, one laid over the other up to a slider.
// SPDX-License-Identifier: Apache-2.0

/** All pictures of a scene of a series: [name, image]. */
function picturesOf(run, series, scene) {
  const shown = [];
  for (const result of run.results) {
    if (result.series !== series || result.parameters.scene !== scene || !result.pictures) continue;
    for (const [kind, name] of [['heatmap', 'heat map'], ['picture', 'picture']])
      if (typeof result.pictures[kind] === 'number')
        shown.push({name: `${result.label}, ${name}`, kind, image: DATA.images[result.pictures[kind]]});
  }
  return shown;
}

function slider(shown) {
  const first = shown.find(p => p.kind === 'picture') || shown[0];
  const second = shown.findLast(p => p.kind === 'heatmap') || shown[shown.length - 1];
  const under = el('img', {alt: second.name, src: second.image});
  const over = el('img', {alt: first.name, src: first.image, class: 'over'});
  const bar = el('div', {class: 'bar'});
  const range = el('input', {type: 'range', min: 0, max: 100, step: 0.5, value: 50, 'aria-label': 'how much of the left picture is shown',
                             oninput: () => place()});
  const place = () => {
    over.style.clipPath = `inset(0 ${100 - range.value}% 0 0)`;
    bar.style.left = `${range.value}%`;
  };
  place();
  const options = shown.map((p, i) => [String(i), p.name]);
  const show = (image, i) => { image.src = shown[i].image; image.alt = shown[i].name; };
  return [
    el('div', {class: 'controls'},
      choice('left', options, String(shown.indexOf(first)), i => show(over, i)),
      choice('right', options, String(shown.indexOf(second)), i => show(under, i))),
    el('div', {class: 'compare'}, under, over, bar, range),
  ];
}

function pictureSection(run, series) {
  const scenes = [...new Set(run.results.filter(r => r.series === series && r.pictures).map(r => r.parameters.scene))];
  return scenes.flatMap(scene => {
    const shown = picturesOf(run, series, scene);
    if (shown.length === 0) return [];
    return [el('h3', {}, `Pictures of ${scene}`),
            el('p', {class: 'note'}, 'Heat maps show how many lights each pixel walks, all on one scale. Drag over the picture.'),
            ...slider(shown)];
  });
}
