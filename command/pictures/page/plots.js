const plotSize = {width: 294, height: 118, left: 40, right: 8, top: 8, bottom: 20};

function svg(name, attributes, parent) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  parent?.append(element);
  return element;
}

function html(name, text, parent) {
  const element = document.createElement(name);
  element.textContent = text;
  parent?.append(element);
  return element;
}

/** Round numbers from low to high, about so many. */
function ticks(low, high, count) {
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough * 0.999);
  const list = [];
  for (let k = Math.ceil(low / step - 1e-6); k * step <= high + 1e-6 * step; ++k) list.push(k * step);
  return list;
}

/** A few digits, as many as the largest of them needs. */
const tickText = (value) => String(Number(value.toPrecision(4)));

/** Quantities of one unit share a plot, numbers without one do not; small masses are shown in grams. */
function plotGroups(series) {
  const groups = new Map();
  for (const one of series) {
    const key = one.unit === '1' ? one.name : one.unit;
    groups.set(key, [...(groups.get(key) || []), one]);
  }
  return [...groups.values()].map((group) => {
    const inGrams = group[0].unit === 'kg' && Math.max(...group.flatMap((one) => one.values)) < 1;
    if (!inGrams) return group;
    return group.map((one) => ({...one, unit: 'g', values: one.values.map((value) => 1000 * value)}));
  });
}

/** One plot against time with a cursor; calls seek(time) where it is pressed. */
class Plot {
  constructor(parent, times, group, seek) {
    Object.assign(this, {times, group});
    const values = group.flatMap((one) => one.values);
    [this.low, this.high] = Plot.range(Math.min(...values), Math.max(...values));
    this.figure = html('figure', '', parent);
    this.figure.className = 'plot';
    const caption = html('figcaption', group.length > 1 ? Plot.sharedName(group) : group[0].name, this.figure);
    html('span', group[0].unit === '1' ? '' : `[${group[0].unit}]`, caption);
    this.legend = html('ul', '', this.figure);
    this.labels = group.map((one, i) => {
      const label = html('li', '', this.legend);
      label.style.setProperty('--own', `var(--series-${i})`);
      return label;
    });
    this.svg = svg('svg', {viewBox: `0 0 ${plotSize.width} ${plotSize.height}`}, this.figure);
    this.drawAxes();
    this.drawLines();
    this.followPointer(seek);
  }
  static range(low, high) {
    if (low >= 0 && low < 0.5 * high) low = 0;
    const size = high - low || Math.abs(high) || 1;
    return high > low ? [low, high + 0.05 * size] : [low - 0.5 * size, high + 0.5 * size];
  }
  /** Their common first word. */
  static sharedName(group) {
    const word = group[0].name.split(' ')[0];
    return group.every((one) => one.name.startsWith(`${word} `)) ? word : '';
  }
  nameOf(one) {
    return this.group.length > 1 ? one.name.slice(Plot.sharedName(this.group).length).trim() : '';
  }

  x(time) {
    const end = this.times[this.times.length - 1] || 1;
    return plotSize.left + (plotSize.width - plotSize.left - plotSize.right) * time / end;
  }
  y(value) {
    const share = (value - this.low) / (this.high - this.low);
    return plotSize.height - plotSize.bottom - (plotSize.height - plotSize.top - plotSize.bottom) * share;
  }

  drawAxes() {
    for (const value of ticks(this.low, this.high, 4)) {
      const y = this.y(value);
      svg('line', {class: 'grid', x1: plotSize.left, x2: plotSize.width - plotSize.right, y1: y, y2: y}, this.svg);
      svg('text', {x: plotSize.left - 5, y: y + 3.5, 'text-anchor': 'end'}, this.svg).textContent = tickText(value);
    }
    const end = this.times[this.times.length - 1] || 1;
    const marks = ticks(0, end, 5);
    marks.forEach((time, i) => {
      const attributes = {x: this.x(time), y: plotSize.height - 6, 'text-anchor': 'middle'};
      svg('text', attributes, this.svg).textContent = tickText(time) + (i === marks.length - 1 ? ' s' : '');
    });
  }

  drawLines() {
    this.cursor = svg('line', {class: 'cursor', y1: plotSize.top, y2: plotSize.height - plotSize.bottom}, this.svg);
    this.dots = this.group.map((one, i) => {
      const own = `--own: var(--series-${i})`;
      const points = one.values.map((value, k) => `${this.x(this.times[k]).toFixed(1)},${this.y(value).toFixed(1)}`);
      svg('polyline', {class: 'line', style: own, points: points.join(' ')}, this.svg);
      return svg('circle', {r: 3.2, style: own}, this.svg);
    });
  }

  followPointer(seek) {
    const go = (event) => {
      const box = this.svg.getBoundingClientRect();
      const x = (event.clientX - box.left) * plotSize.width / box.width;
      const end = this.times[this.times.length - 1];
      const share = (x - plotSize.left) / (plotSize.width - plotSize.left - plotSize.right);
      seek(clamped(share, 0, 1) * end);
    };
    this.svg.addEventListener('pointerdown', (event) => {
      this.svg.setPointerCapture(event.pointerId);
      go(event);
    });
    this.svg.addEventListener('pointermove', (event) => event.buttons && go(event));
  }

  /** Moves the cursor. @param place  in frames */
  show(place) {
    const frame = Math.min(Math.floor(place), this.times.length - 1);
    const next = Math.min(frame + 1, this.times.length - 1);
    const mixed = (values) => values[frame] + (place - frame) * (values[next] - values[frame]);
    const x = this.x(mixed(this.times));
    this.cursor.setAttribute('x1', x);
    this.cursor.setAttribute('x2', x);
    this.group.forEach((one, i) => {
      const value = mixed(one.values);
      this.dots[i].setAttribute('cx', x);
      this.dots[i].setAttribute('cy', this.y(value));
      this.labels[i].textContent = `${this.nameOf(one)} ${value.toPrecision(3)}`;
    });
  }
}
