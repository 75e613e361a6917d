const icons = {play: 'M7 4.5v15l13-7.5z', pause: 'M6 5h4v14H6zM14 5h4v14h-4z'};
const paces = [0.125, 0.25, 0.5, 1, 2, 4, 8, 16];
const scaleTitles = {saturation: 'saturation [%]', stretch: 'length / rest length', speed: 'speed [m/s]'};
const byId = (id) => document.getElementById(id);

/** Plays the run and listens to the page's controls. */
class Player {
  constructor(run) {
    this.run = run;
    this.last = run.times.length - 1;
    this.place = 0;  // in frames
    this.isPlaying = false;
    this.pace = 1;
    this.renderer = new Renderer(byId('picture'), run);
    this.camera = new OrbitCamera(run.view, run.scenery.up);
    this.plots = plotGroups(run.series).map((group) =>
      new Plot(byId('plots'), run.times, group, (time) => this.seek(this.placeOf(time))));
    this.describe();
    this.listen();
    new ResizeObserver(() => this.fitCanvas()).observe(byId('stage'));
    this.fitCanvas();
    this.drawNow();
  }

  describe() {
    const {run} = this;
    document.querySelector('h1').textContent = run.scenery.title.replaceAll('_', ' ');
    const nodes = run.cloths.reduce((all, cloth) => all + cloth.nodes, 0);
    byId('facts').textContent =
        `${run.cloths.map((cloth) => cloth.facts.name).join(', ')} · ${nodes} nodes · ${run.times.length} frames`;
    byId('scrub').max = this.last;
    this.showPlaying();
  }

  listen() {
    const picture = byId('picture');
    followPointers(picture, this.camera, () => this.redraw());
    byId('play').addEventListener('click', () => this.setPlaying(!this.isPlaying));
    byId('scrub').addEventListener('input', (event) => this.seek(Number(event.target.value)));
    byId('pace').addEventListener('change', (event) => { this.pace = Number(event.target.value); });
    byId('colouring').addEventListener('change', (event) => this.setColouring(event.target.value));
    byId('help').addEventListener('click', () => this.toggleKeys());
    document.addEventListener('keydown', (event) => this.press(event));
    picture.addEventListener('webglcontextlost', () => {
      byId('notice').textContent = 'The graphics card was lost; load the page again';
    });
  }

  press(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches('select')) return;
    const names = [...byId('colouring').options].map((option) => option.value);
    const actions = {
      ' ': () => this.setPlaying(!this.isPlaying),
      ArrowLeft: () => this.seek(Math.ceil(this.place) - 1),
      ArrowRight: () => this.seek(Math.floor(this.place) + 1),
      Home: () => this.seek(0),
      End: () => this.seek(this.last),
      '-': () => this.changePace(-1),
      '+': () => this.changePace(1),
      '=': () => this.changePace(1),
      r: () => this.resetView(),
      h: () => this.toggleKeys(),
      '?': () => this.toggleKeys(),
    };
    names.forEach((name, i) => { actions[i + 1] = () => this.setColouring(name); });
    const action = actions[event.key] || actions[event.key.toLowerCase()];
    if (!action) return;
    event.preventDefault();
    action();
  }

  changePace(by) {
    this.pace = paces[clamped(paces.indexOf(this.pace) + by, 0, paces.length - 1)];
    byId('pace').value = this.pace;
  }
  resetView() {
    this.camera.reset();
    this.redraw();
  }
  toggleKeys() {
    byId('keys').hidden = !byId('keys').hidden;
  }

  setColouring(name) {
    byId('colouring').value = name;
    this.renderer.setColouring(name);
    const scale = byId('scale');
    scale.hidden = name === 'fabric';
    if (!scale.hidden) this.drawScale(scale, name);
    this.redraw();
  }
  drawScale(scale, name) {
    scale.querySelector('figcaption').textContent = scaleTitles[name];
    const context = scale.querySelector('canvas').getContext('2d');
    for (let i = 0; i < 256; ++i) {
      context.fillStyle = `rgb(${mappedColour(i / 255).map((value) => Math.round(255 * value))})`;
      context.fillRect(i, 0, 1, 1);
    }
    const [low, high] = this.renderer.scale.map((value) => value * (name === 'saturation' ? 100 : 1));
    const labels = [0, 1, 2, 3, 4].map((i) => html('span', tickText(low + (high - low) * i / 4)));
    labels.forEach((label) => { label.textContent = String(Number(Number(label.textContent).toPrecision(3))); });
    scale.querySelector('div').replaceChildren(...labels);
  }

  placeOf(time) {
    const {times} = this.run;
    const next = times.findIndex((one) => one >= time);
    if (next <= 0) return next < 0 ? this.last : 0;
    return next - (times[next] - time) / (times[next] - times[next - 1]);
  }
  seek(place) {
    this.setPlaying(false);
    this.place = clamped(place, 0, this.last);
    this.redraw();
  }
  setPlaying(isPlaying) {
    if (isPlaying && this.place >= this.last) this.place = 0;
    this.isPlaying = isPlaying && this.last > 0;
    this.lastTick = undefined;
    this.showPlaying();
    this.redraw();
  }
  showPlaying() {
    byId('play').querySelector('path').setAttribute('d', this.isPlaying ? icons.pause : icons.play);
    byId('play').setAttribute('aria-label', this.isPlaying ? 'Pause' : 'Play');
  }

  fitCanvas() {
    const canvas = byId('picture');
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    this.redraw();
  }

  redraw() {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame((now) => {
      this.isWaiting = false;
      this.advance(now);
      this.drawNow();
      if (this.isPlaying) this.redraw();
    });
  }
  advance(now) {
    if (!this.isPlaying) return;
    const {times} = this.run;
    const frame = Math.min(Math.floor(this.place), this.last - 1);
    const elapsed = this.lastTick === undefined ? 0 : Math.min((now - this.lastTick) / 1000, 0.25);
    this.lastTick = now;
    this.place += elapsed * this.pace / Math.max(times[frame + 1] - times[frame], 1e-9);
    if (this.place < this.last) return;
    this.place = this.last;
    this.isPlaying = false;
    this.showPlaying();
  }
  drawNow() {
    this.renderer.draw(this.place, this.camera);
    const frame = Math.floor(this.place);
    const {times} = this.run;
    const time = times[frame] + (this.place - frame) * ((times[frame + 1] ?? times[frame]) - times[frame]);
    byId('time').textContent = `${time.toFixed(2)} s of ${times[this.last].toFixed(2)} s`;
    byId('scrub').value = Math.round(this.place);
    for (const plot of this.plots) plot.show(this.place);
  }
}

try {
  const player = new Player(await unpackedRun());
  byId('notice').textContent = '';
  // For whoever drives the page by script.
  window.wetcloth = {
    ready: true,
    frames: player.last + 1,
    get frame() { return Math.round(player.place); },
    setFrame(frame) {
      player.seek(frame);
      player.drawNow();
    },
    setColouring: (name) => player.setColouring(name),
    play: () => player.setPlaying(true),
    /** Of each cloth in the frame that is shown, x, y, z of each node [m], and each one's saturation. */
    state: () => player.renderer.cloths.map((cloth) => (
      {positions: Array.from(cloth.positions), saturation: Array.from(cloth.saturation)})),
  };
} catch (error) {
  byId('notice').textContent = `The run cannot be shown: ${error.message}`;
  throw error;
}
