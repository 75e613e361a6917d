/** Looks at a target from all sides; up stays up. Starts as the page's view was fitted. */
class OrbitCamera {
  constructor(view, up) {
    this.up = up;
    this.tangent = Math.tan(view.fieldOfView * Math.PI / 360);
    this.first = view;
    this.reset();
  }
  reset() {
    this.target = this.first.target.slice();
    this.offset = difference(this.first.eye, this.target);  // from the target to the eye
  }

  /** @param across, upwards  of the picture's height */
  orbit(across, upwards) {
    this.offset = turned(this.offset, this.up, -across * Math.PI);
    const {right} = this.axes();
    const slope = Math.acos(clamped(dot(unit(this.offset), this.up), -1, 1));  // from the zenith
    this.offset = turned(this.offset, right, slope - clamped(slope - upwards * Math.PI, 0.05, 0.62 * Math.PI));
  }
  pan(across, upwards) {
    const size = 2 * this.tangent * length(this.offset);
    const {right, above} = this.axes();
    this.target = sum(this.target, sum(scaled(right, -across * size), scaled(above, -upwards * size)));
  }
  zoom(factor) {
    const distance = length(difference(this.first.eye, this.first.target));
    this.offset = scaled(unit(this.offset), clamped(length(this.offset) * factor, distance / 20, distance * 5));
  }

  axes() {
    const forward = unit(scaled(this.offset, -1));
    const sideways = cross(forward, this.up);
    const right = length(sideways) < 1e-4 ? perpendicular(this.up) : unit(sideways);
    return {right, above: cross(right, forward), forward};
  }

  /** @param aspect  width over height; a narrow picture is seen from farther away, so that all stays in it */
  look(aspect) {
    const back = Math.max(1, this.first.aspect / aspect);
    const eye = sum(this.target, scaled(this.offset, back));
    return {eye, ...this.axes(), tangentX: this.tangent * aspect, tangentY: this.tangent};
  }
}

/** One finger or the left button turns, two fingers or another button move and zoom. */
function followPointers(canvas, camera, changed) {
  const pointers = new Map();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, size: Math.hypot(a.x - b.x, a.y - b.y)};
  };
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  });
  for (const end of ['pointerup', 'pointercancel']) {
    canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  canvas.addEventListener('pointermove', (event) => {
    const last = pointers.get(event.pointerId);
    if (!last || pointers.size > 2) return;
    const before = pointers.size === 2 ? spread() : last;
    const now = {x: event.clientX, y: event.clientY};
    pointers.set(event.pointerId, now);
    const after = pointers.size === 2 ? spread() : now;
    const across = (after.x - before.x) / canvas.clientHeight;
    const upwards = (before.y - after.y) / canvas.clientHeight;
    const pans = pointers.size === 2 || event.shiftKey || event.buttons > 1;
    if (pans) camera.pan(across, upwards);
    else camera.orbit(across, -upwards);
    if (pointers.size === 2) camera.zoom(before.size / Math.max(after.size, 1));
    changed();
  });
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    camera.zoom(Math.exp(clamped(event.deltaY, -200, 200) * 0.0015));
    changed();
  }, {passive: false});
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
}
