const byId = (id) => document.getElementById(id);
const words = (key) => key.replaceAll('_', ' ');
const microseconds = (value) => (value < 1000 ? `${value.toFixed(value < 9.95 ? 1 : 0)} µs` : `${(value / 1000).toFixed(1)} ms`);
const grams = (kilograms) => (kilograms < 1 ? `${(1000 * kilograms).toFixed(1)} g` : `${kilograms.toFixed(2)} kg`);

function made(tag, content, parts = {}) {
  const element = Object.assign(document.createElement(tag), parts);
  element.append(...[content].flat());
  return element;
}

/** The effects of a scene as boxes to tick, each with what it costs. */
class EffectList {
  constructor(place, scene, effects) {
    this.rows = effects.map(({key, inScene}, index) => {
      const box = made('input', [], {type: 'checkbox', id: `effect-${key}`});
      const cost = made('output', '');
      const note = made('small', '');
      box.addEventListener('change', () => scene.turnEffect(index, box.checked));
      const row = made('label', [box, made('span', words(key)), cost, note], {className: inScene ? 'named' : ''});
      return {row, box, cost, note};
    });
    const named = this.rows.filter((_, i) => effects[i].inScene);
    const others = this.rows.filter((_, i) => !effects[i].inScene);
    const more = made('details', [made('summary', 'more than the scene names'), ...others.map(({row}) => row)]);
    place.replaceChildren(...named.map(({row}) => row), more);
  }
  show(effects) {
    effects.forEach(({on, waits, refusal, microseconds: time}, i) => {
      const {box, cost, note} = this.rows[i];
      box.checked = on;
      cost.textContent = on ? microseconds(time) : '';
      note.textContent = refusal || (waits ? 'from the next reset on' : '');
    });
  }
}

/** What can be changed while a scene runs, and what it comes to. */
class Panel {
  constructor(page) {
    this.page = page;
    const withScene = (id, event, action) =>
      byId(id).addEventListener(event, () => { if (page.scene) action(page.scene, byId(id)); });
    for (const axis of ['x', 'y', 'z']) withScene(`wind-${axis}`, 'input', (scene) => scene.setWind(...this.wind()));
    withScene('rain', 'input', (scene, slider) => scene.setRain(Number(slider.value) / 3600));
    withScene('exposure', 'input', (scene, slider) => scene.setExposure(Number(slider.value)));
    for (const [id, set] of [['fabric', 'setFabric'], ['solver', 'setSolver']]) {
      withScene(id, 'change', (scene, choice) => {
        scene[set](choice.value);
        this.complain(page.program.error());
        page.reset();
      });
    }
    withScene('reset', 'click', () => page.reset());
    withScene('restore', 'click', (scene) => { scene.restore(); this.showLevers(); });
    withScene('pause', 'click', () => page.setPaused(!page.isPaused));
    withScene('compared', 'change', (_, box) => page.setCompared(box.checked));
    byId('colouring').addEventListener('change', (event) => page.setColouring(event.target.value));
    byId('scene').addEventListener('change', (event) => page.load(event.target.value));
  }

  wind() {
    return ['x', 'y', 'z'].map((axis) => Number(byId(`wind-${axis}`).value));
  }
  complain(text) {
    byId('notice').textContent = text;
  }

  /** A scene has begun. */
  begin(scene) {
    this.effects = new EffectList(byId('effects'), scene, JSON.parse(scene.state()).effects);
    byId('fabric').value = '';
    byId('compared').checked = false;
    this.showLevers();
  }
  showLevers() {
    const {wind, rain, exposure, solver} = JSON.parse(this.page.scene.state());
    ['x', 'y', 'z'].forEach((axis, i) => { byId(`wind-${axis}`).value = wind[i]; });
    byId('rain').value = 3600 * rain;
    byId('exposure').value = exposure;
    byId('solver').value = solver;
  }

  show(state, picturesPerSecond) {
    this.effects.show(state.effects);
    byId('time').textContent = `${state.time.toFixed(2)} s`;
    byId('pictures').textContent = `${picturesPerSecond.toFixed(0)} pictures/s`;
    byId('water').textContent = `${grams(state.water)}, ${(100 * state.saturation).toFixed(0)} % of what it can hold`;
    byId('library').textContent = microseconds(state.library);
    byId('bullet').textContent = microseconds(state.bullet);
    for (const [axis, value] of [['x', 0], ['y', 1], ['z', 2]]) {
      byId(`wind-${axis}-value`).textContent = state.wind[value].toFixed(1);
    }
    const isOn = (key) => state.effects.some((effect) => effect.key === key && effect.on);
    byId('wind-levers').disabled = !isOn('wind');
    byId('rain').disabled = !isOn('rain');
    byId('exposure').disabled = !isOn('absorption');
    if (state.failure || state.notice) this.complain(state.failure || state.notice);
  }
}
