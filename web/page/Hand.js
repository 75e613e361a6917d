/** Pulls the cloth with the mouse or a finger; beside the cloth, or with two fingers, the view is moved instead. */
class Hand {
  /** @param of  tells the scene and the camera of now, and whether this canvas shows plain Bullet */
  constructor(canvas, of) {
    Object.assign(this, {canvas, of, pointer: null, drags: 0});
    canvas.addEventListener('pointerdown', (event) => this.take(event), {capture: true});
    canvas.addEventListener('pointermove', (event) => this.drag(event), {capture: true});
    for (const end of ['pointerup', 'pointercancel']) {
      canvas.addEventListener(end, (event) => this.letGo(event), {capture: true});
    }
  }

  /** Through a pixel, as the camera sees it. */
  rayAt(event) {
    const {canvas} = this;
    const box = canvas.getBoundingClientRect();
    const look = this.of().camera.look(canvas.width / canvas.height);
    const x = look.tangentX * (2 * (event.clientX - box.left) / box.width - 1);
    const y = look.tangentY * (1 - 2 * (event.clientY - box.top) / box.height);
    const direction = unit(sum(look.forward, sum(scaled(look.right, x), scaled(look.above, y))));
    return {origin: look.eye, direction, forward: look.forward};
  }

  take(event) {
    const {scene, isPlain} = this.of();
    if (!scene || this.pointer !== null || event.button !== 0 || event.shiftKey) return;
    const {origin, direction, forward} = this.rayAt(event);
    const distance = scene.grab(...origin, ...direction, isPlain);
    if (distance < 0) return;
    this.depth = distance * dot(direction, forward);
    this.pointer = event.pointerId;
    this.drags += 1;
    this.canvas.setPointerCapture(event.pointerId);
    event.stopImmediatePropagation();
  }

  /** Across the view, at the depth at which the cloth was taken. */
  drag(event) {
    if (event.pointerId !== this.pointer) return;
    const {origin, direction, forward} = this.rayAt(event);
    this.of().scene.dragTo(...sum(origin, scaled(direction, this.depth / dot(direction, forward))));
    event.stopImmediatePropagation();
  }

  letGo(event) {
    if (event.pointerId !== this.pointer) return;
    this.pointer = null;
    this.of().scene.release();
    event.stopImmediatePropagation();
  }
}
