/** Whether a processor draws in the place of a graphics card: then there is less time for edges and shadows. */
function isDrawnByProcessor() {
  const gl = document.createElement('canvas').getContext('webgl2');
  const names = gl && gl.getExtension('WEBGL_debug_renderer_info');
  return Boolean(names) && /swiftshader|llvmpipe|basic render/i.test(gl.getParameter(names.UNMASKED_RENDERER_WEBGL));
}

/** One picture of the scene: ours, or beside it plain Bullet's. */
class Stage {
  constructor(canvas, page, isPlain) {
    Object.assign(this, {canvas, page, isPlain, renderer: null});
    this.hand = new Hand(canvas, () => ({scene: page.scene, camera: page.camera, isPlain}));
    followPointers(canvas, page.lens, () => {});
    new ResizeObserver(() => this.fit()).observe(canvas);
  }
  /** Each scene gets a renderer of its own on the same canvas. */
  begin(scene, colouring) {
    this.run = new LiveRun(scene, this.isPlain);
    this.renderer = new Renderer(this.canvas, this.run, this.page.isHurried);
    this.renderer.setColouring(colouring);
    this.fit();
  }
  fit() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2) * this.page.fineness.share;
    this.canvas.width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    this.canvas.height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
  }
  draw(camera) {
    this.run.look();
    this.renderer.draw(0, camera);
  }
}

/** How finely pictures are drawn: less where the machine would not come to 60 a second otherwise. */
class Fineness {
  constructor() {
    this.share = 1;  // of the screen's pixels along an edge
    this.begin();
  }
  begin() {
    this.frames = 0;
    this.seconds = 0;
  }
  /** Whether it has become another one. */
  note(elapsed) {
    this.frames += 1;
    this.seconds += elapsed;
    if (this.frames < 20) return false;
    const isSlow = this.seconds / this.frames > 1 / 56;
    this.begin();
    if (!isSlow || this.share <= 0.3) return false;
    this.share = Math.max(0.3, 0.85 * this.share);
    return true;
  }
}

/** Runs a scene on the page's clock and draws it. */
class Page {
  constructor(program, names) {
    Object.assign(this, {program, scene: null, camera: null, isPaused: false, isCompared: false, pictures: 0, fineness: new Fineness()});
    this.isHurried = isDrawnByProcessor();
    // The camera of now, for listeners that outlive a scene.
    this.lens = {};
    for (const move of ['orbit', 'pan', 'zoom']) this.lens[move] = (...how) => this.camera && this.camera[move](...how);
    this.wet = new Stage(byId('picture'), this, false);
    this.plain = new Stage(byId('plain'), this, true);
    this.panel = new Panel(this);
    byId('scene').replaceChildren(...names.map((name) => made('option', words(name), {value: name})));
    this.perSecond = 0;
    requestAnimationFrame((now) => this.tick(now));
  }

  async load(name) {
    const answer = await fetch(`scenes/${name}.json`);
    if (!answer.ok) throw new Error(`scenes/${name}.json: ${answer.status}`);
    const text = await answer.text();
    const scene = this.program.open(text, name);
    if (!scene) {
      this.panel.complain(this.program.error());
      return;
    }
    if (this.scene) this.scene.delete();
    this.scene = scene;
    byId('scene').value = name;
    byId('about').textContent = JSON.parse(text).description || '';
    this.isCompared = false;
    document.body.classList.remove('compared');
    this.wet.begin(scene, byId('colouring').value);
    this.camera = new OrbitCamera(this.wet.run.view, this.wet.run.scenery.up);
    this.panel.complain('');
    this.panel.begin(scene);
    this.setPaused(false);
  }

  reset() {
    this.scene.reset();
    this.panel.complain(this.program.error());
  }
  setPaused(paused) {
    this.isPaused = paused;
    this.scene.setPaused(paused);
    byId('pause').textContent = paused ? 'Go on' : 'Pause';
  }
  setCompared(compared) {
    this.scene.setCompared(compared);
    this.isCompared = compared;
    document.body.classList.toggle('compared', compared);
    if (compared) this.plain.begin(this.scene, byId('colouring').value);
    this.wet.fit();
  }
  setColouring(name) {
    for (const {renderer} of [this.wet, this.plain]) if (renderer) renderer.setColouring(name);
  }

  tick(now) {
    requestAnimationFrame((next) => this.tick(next));
    const elapsed = Math.min((now - (this.before ?? now)) / 1000, 0.25);
    this.before = now;
    if (!this.scene) return;
    if (elapsed > 0) this.perSecond += 0.05 * (1 / elapsed - this.perSecond);
    if (this.fineness.note(elapsed)) for (const stage of [this.wet, this.plain]) stage.fit();
    this.scene.advance(elapsed);
    this.wet.draw(this.camera);
    if (this.isCompared) this.plain.draw(this.camera);
    this.pictures += 1;
    if (this.pictures % 6 === 0) this.panel.show(JSON.parse(this.scene.state()), this.perSecond);
  }
}

try {
  const [program, names] = await Promise.all([openProgram(), fetch('scenes/index.json').then((answer) => answer.json())]);
  const page = new Page(program, names);
  const wanted = new URLSearchParams(location.search).get('scene');
  await page.load(names.includes(wanted) ? wanted : names[0]);
  // For whoever drives the page by script.
  window.wetcloth = {
    ready: true,
    get pictures() { return page.pictures; },
    get drags() { return page.wet.hand.drags + page.plain.hand.drags; },
    state: () => JSON.parse(page.scene.state()),
    positions: (cloth = 0) => { page.scene.look(false); return Array.from(page.scene.positions(cloth)); },
    load: (name) => page.load(name),
  };
} catch (error) {
  byId('notice').textContent = `It cannot be shown: ${error.message}`;
  throw error;
}
