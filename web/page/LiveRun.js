/** A cloth as it is now, where the renderer of pages would look into a run that is over. */
class LiveCloth {
  constructor(scene, number, facts) {
    Object.assign(this, {scene, number, facts, nodes: facts.nodes});
    this.texture = Float32Array.from(scene.texture(number));
    this.triangles = Uint32Array.from(scene.triangles(number));
  }
  positionsAt(_frame, _share, positions) {
    positions.set(this.scene.positions(this.number));
  }
  valuesAt(name, _frame, _share, values) {
    values.set(this.scene[name](this.number));
  }
}

/** A run of one frame, which is now. */
class LiveRun {
  /** @param isPlain  whether it shows the same scene in plain Bullet */
  constructor(scene, isPlain) {
    const head = JSON.parse(scene.run());
    Object.assign(this, head, {scene, isPlain, times: [0]});
    this.cloths = head.cloths.map((facts, i) => new LiveCloth(scene, i, facts));
    this.solids = head.solids.map(({colour}, i) => ({
      colour,
      vertices: Float32Array.from(scene.solidVertices(i)),
      normals: Float32Array.from(scene.solidNormals(i)),
      triangles: Uint32Array.from(scene.solidTriangles(i)),
    }));
    this.look();
  }
  look() {
    this.scene.look(this.isPlain);
    const {poses, rods, wetness} = JSON.parse(this.scene.among());
    this.poses = poses.length > 0 ? [poses] : null;
    this.rods = [rods];
    this.wetness = [wetness];
    this.drops = [Float32Array.from(this.scene.drops())];
  }
}
