/** Reads numbers one after the other, lowest byte first. */
class Reader {
  constructor(bytes) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.at = 0;
  }
  take(count) {
    this.at += count;
    return this.bytes.subarray(this.at - count, this.at);
  }
  uint16() {
    this.at += 2;
    return this.view.getUint16(this.at - 2, true);
  }
  floats(count) {
    const values = new Float32Array(count);
    for (let i = 0; i < count; ++i, this.at += 4) values[i] = this.view.getFloat32(this.at, true);
    return values;
  }
  uint32s(count) {
    const values = new Uint32Array(count);
    for (let i = 0; i < count; ++i, this.at += 4) values[i] = this.view.getUint32(this.at, true);
    return values;
  }
}

async function inflated(base64) {
  const packed = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The inverse of Packer::putPositions in PackedRun.cpp: frame by frame, one axis. */
function unpackAxis(reader, frames, nodes) {
  const all = new Uint16Array(frames * nodes);
  const low = reader.take(frames * nodes);
  const high = reader.take(frames * nodes);
  for (let frame = 0; frame < frames; ++frame) {
    const now = frame * nodes;
    const last = frame > 0 ? now - nodes : -1;
    const before = frame > 1 ? last - nodes : -1;
    let left = 0;
    for (let node = 0; node < nodes; ++node) {
      const folded = low[now + node] | high[now + node] << 8;
      left += folded & 1 ? -(folded + 1) / 2 : folded / 2;
      all[now + node] = left + (last < 0 ? 0 : 2 * all[last + node]) - (before < 0 ? 0 : all[before + node]);
    }
  }
  return all;
}

/** The inverse of Packer::putValues. */
function unpackValues(reader, frames, nodes) {
  const all = new Uint8Array(frames * nodes);
  for (let frame = 0; frame < frames; ++frame) {
    const changes = reader.take(nodes);
    const now = frame * nodes;
    let left = 0;
    for (let node = 0; node < nodes; ++node) {
      left += changes[node];
      all[now + node] = left + (frame > 0 ? all[now - nodes + node] : 0);
    }
  }
  return all;
}

function unpackRods(reader, frames) {
  return Array.from({length: frames}, () => Array.from({length: reader.uint16()}, () => {
    const values = Array.from(reader.floats(7));
    return {from: values.slice(0, 3), to: values.slice(3, 6), radius: values[6]};
  }));
}

/** Of each frame's drops x, y, z and radius [m], one after the other. */
function unpackDrops(reader, frames, head) {
  const [low, high] = head.box;
  return Array.from({length: frames}, () => {
    const places = new Float32Array(4 * reader.uint16());
    for (let i = 0; i < places.length; ++i) {
      const share = reader.uint16() / 65535;
      places[i] = i % 4 === 3 ? share * head.largestDrop : low[i % 4] + share * (high[i % 4] - low[i % 4]);
    }
    return places;
  });
}

/** One cloth of the run; at() tells its state between two frames. */
class ClothTrack {
  constructor(head, facts, reader) {
    const frames = head.times.length;
    Object.assign(this, {box: head.box, facts, nodes: facts.nodes});
    this.texture = reader.floats(2 * facts.nodes);
    this.triangles = reader.uint32s(3 * facts.triangles);
    this.axes = [0, 1, 2].map(() => unpackAxis(reader, frames, facts.nodes));
    this.values = {};
    for (const name of ['saturation', 'stretch', 'speed']) {
      this.values[name] = {all: unpackValues(reader, frames, facts.nodes), range: head.ranges[name]};
    }
  }

  /** Fills x, y, z of each node [m]. */
  positionsAt(frame, share, positions) {
    const from = frame * this.nodes;
    const to = share > 0 ? from + this.nodes : from;
    for (let axis = 0; axis < 3; ++axis) {
      const all = this.axes[axis];
      const low = this.box[0][axis];
      const step = (this.box[1][axis] - low) / 65535;
      for (let node = 0; node < this.nodes; ++node) {
        positions[3 * node + axis] = low + step * ((1 - share) * all[from + node] + share * all[to + node]);
      }
    }
  }

  /** Fills one value per node, in its own unit. */
  valuesAt(name, frame, share, values) {
    const {all, range: [low, high]} = this.values[name];
    const from = frame * this.nodes;
    const to = share > 0 ? from + this.nodes : from;
    for (let node = 0; node < this.nodes; ++node) {
      values[node] = low + (high - low) / 255 * ((1 - share) * all[from + node] + share * all[to + node]);
    }
  }
}

/** Of each frame each solid's place [m] and its turn, a quaternion; null where none moves. */
function unpackPoses(reader, frames, head) {
  if (!head.posed) return null;
  return Array.from({length: frames}, () => head.solids.map(() => {
    const values = Array.from(reader.floats(7));
    return {place: values.slice(0, 3), turn: values.slice(3, 7)};
  }));
}

async function unpackedRun() {
  const head = JSON.parse(document.getElementById('head').textContent);
  const reader = new Reader(await inflated(document.getElementById('bytes').textContent));
  const frames = head.times.length;
  const cloths = head.cloths.map((facts) => new ClothTrack(head, facts, reader));
  const solids = head.solids.map(({vertices, triangles, colour}) => ({
    colour,
    vertices: reader.floats(3 * vertices),
    normals: reader.floats(3 * vertices),
    triangles: reader.uint32s(3 * triangles),
  }));
  const poses = unpackPoses(reader, frames, head);
  return {...head, cloths, solids, poses, rods: unpackRods(reader, frames), drops: unpackDrops(reader, frames, head)};
}
