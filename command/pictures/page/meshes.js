/** Triangles on the graphics card. Each buffer: {first: location, sizes: of the attributes in it, data}. */
class Mesh {
  constructor(gl, triangles, buffers) {
    this.gl = gl;
    this.count = triangles.length;
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    this.buffers = buffers.map(({first, sizes, data}) => {
      const buffer = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
      const stride = 4 * sizes.reduce((a, b) => a + b);
      let offset = 0;
      sizes.forEach((size, i) => {
        gl.enableVertexAttribArray(first + i);
        gl.vertexAttribPointer(first + i, size, gl.FLOAT, false, stride, offset);
        offset += 4 * size;
      });
      return buffer;
    });
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, Uint32Array.from(triangles), gl.STATIC_DRAW);
    gl.bindVertexArray(null);
  }
  update(buffer, data) {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.buffers[buffer]);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, data, this.gl.DYNAMIC_DRAW);
  }
  /** Some of its triangles, or all. */
  draw(first = 0, triangles = this.count / 3) {
    this.gl.bindVertexArray(this.array);
    this.gl.drawElements(this.gl.TRIANGLES, 3 * triangles, this.gl.UNSIGNED_INT, 12 * first);
  }
  /** @param {Float32Array} places  x, y, z and size of each copy */
  drawAt(places) {
    const {gl} = this;
    gl.bindVertexArray(this.array);
    if (!this.places) {
      this.places = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
      gl.enableVertexAttribArray(2);
      gl.vertexAttribPointer(2, 4, gl.FLOAT, false, 0, 0);
      gl.vertexAttribDivisor(2, 1);
    }
    gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
    gl.bufferData(gl.ARRAY_BUFFER, places, gl.DYNAMIC_DRAW);
    gl.drawElementsInstanced(gl.TRIANGLES, this.count, gl.UNSIGNED_INT, 0, places.length / 4);
  }
}

function interleaved(vertices, normals) {
  const data = new Float32Array(2 * vertices.length);
  for (let i = 0; i < vertices.length; i += 3) {
    data.set(vertices.slice(i, i + 3), 2 * i);
    data.set(normals.slice(i, i + 3), 2 * i + 3);
  }
  return data;
}

/** All are numbers, one after the other. */
const solidMesh = (gl, vertices, normals, triangles) =>
    new Mesh(gl, triangles, [{first: 0, sizes: [3, 3], data: interleaved(vertices, normals)}]);

/** A rigid body, which may move. */
class SolidMesh {
  constructor(gl, solid) {
    this.solid = solid;
    this.vertices = Float32Array.from(solid.vertices);
    this.normals = Float32Array.from(solid.normals);
    this.mesh = solidMesh(gl, this.vertices, this.normals, solid.triangles);
  }

  /** Between two poses. */
  update(from, to, share) {
    const same = from.turn.reduce((sum, x, i) => sum + x * to.turn[i], 0) < 0 ? -1 : 1;
    const mixed = from.turn.map((x, i) => (1 - share) * x + share * same * to.turn[i]);
    const turn = mixed.map((x) => x / Math.hypot(...mixed));
    const place = from.place.map((x, i) => (1 - share) * x + share * to.place[i]);
    const {vertices, normals} = this.solid;
    for (let i = 0; i < vertices.length; i += 3) {
      this.vertices.set(sum(place, turnedBy(turn, vertices.slice(i, i + 3))), i);
      this.normals.set(turnedBy(turn, normals.slice(i, i + 3)), i);
    }
    this.mesh.update(0, interleaved(this.vertices, this.normals));
  }
}

const squareMesh = (gl) =>
    new Mesh(gl, [0, 1, 2, 0, 2, 3], [{first: 0, sizes: [2], data: new Float32Array([-1, -1, 1, -1, 1, 1, -1, 1])}]);

/** Rows of places that are joined to their neighbours. */
function gridTriangles(rows, columns) {
  const triangles = [];
  for (let row = 0; row + 1 < rows; ++row) {
    for (let column = 0; column + 1 < columns; ++column) {
      const here = row * columns + column;
      triangles.push(here, here + columns, here + columns + 1, here, here + columns + 1, here + 1);
    }
  }
  return triangles;
}

function ballMesh(gl) {
  const vertices = [];
  for (let ring = 0; ring <= 8; ++ring) {
    for (let sector = 0; sector <= 12; ++sector) {
      const polar = Math.PI * ring / 8;
      const around = Math.PI * sector / 6;
      vertices.push([Math.sin(polar) * Math.sin(around), Math.cos(polar), Math.sin(polar) * Math.cos(around)]);
    }
  }
  return solidMesh(gl, vertices.flat(), vertices.flat(), gridTriangles(9, 13));
}

/** A round bar with flat ends. */
function barMesh(gl, {from, to, radius}) {
  const axis = unit(difference(to, from));
  const u = perpendicular(axis);
  const v = cross(axis, u);
  const vertices = [];
  const normals = [];
  const ring = (centre, reach, normalOf) => {
    for (let side = 0; side <= 20; ++side) {
      const angle = Math.PI * side / 10;
      const outwards = sum(scaled(u, Math.cos(angle)), scaled(v, Math.sin(angle)));
      vertices.push(sum(centre, scaled(outwards, reach)));
      normals.push(normalOf(outwards));
    }
  };
  const backwards = scaled(axis, -1);
  ring(from, 0, () => backwards);
  ring(from, radius, () => backwards);
  ring(from, radius, (outwards) => outwards);
  ring(to, radius, (outwards) => outwards);
  ring(to, radius, () => axis);
  ring(to, 0, () => axis);
  return solidMesh(gl, vertices.flat(), normals.flat(), gridTriangles(6, 21));
}

/** A cloth's surface; its normals are averaged twice, as the triangles' own show every wrinkle of the mesh. */
class ClothMesh {
  constructor(gl, track) {
    this.track = track;
    this.positions = new Float32Array(3 * track.nodes);
    this.rough = new Float32Array(3 * track.nodes);
    this.normals = new Float32Array(3 * track.nodes);
    this.saturation = new Float32Array(track.nodes);
    this.value = new Float32Array(track.nodes);
    this.moving = new Float32Array(8 * track.nodes);
    this.mesh = new Mesh(gl, track.triangles, [
      {first: 0, sizes: [3, 3, 2], data: this.moving}, {first: 3, sizes: [2], data: track.texture}]);
    let side = 1e-3;
    for (const axis of [0, 1]) {
      const places = track.texture.filter((_, i) => i % 2 === axis);
      side = Math.max(side, places.reduce((a, b) => Math.max(a, b)) - places.reduce((a, b) => Math.min(a, b)));
    }
    this.side = side;
  }

  /** @param colouring  a value's name, or fabric; scale: its [low, high] */
  update(frame, share, colouring, scale) {
    const {track, moving} = this;
    track.positionsAt(frame, share, this.positions);
    track.valuesAt('saturation', frame, share, this.saturation);
    if (colouring !== 'fabric') track.valuesAt(colouring, frame, share, this.value);
    this.findNormals();
    for (let node = 0; node < track.nodes; ++node) {
      for (let axis = 0; axis < 3; ++axis) {
        moving[8 * node + axis] = this.positions[3 * node + axis];
        moving[8 * node + 3 + axis] = this.normals[3 * node + axis];
      }
      moving[8 * node + 6] = this.saturation[node];
      moving[8 * node + 7] = clamped((this.value[node] - scale[0]) / (scale[1] - scale[0]), 0, 1);
    }
    this.mesh.update(0, moving);
  }

  findNormals() {
    const {positions: p, rough, normals, track: {triangles}} = this;
    rough.fill(0);
    normals.fill(0);
    for (let i = 0; i < triangles.length; i += 3) {
      const a = 3 * triangles[i];
      const b = 3 * triangles[i + 1];
      const c = 3 * triangles[i + 2];
      const u = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
      const v = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
      ClothMesh.add(rough, a, b, c, cross(u, v));
    }
    ClothMesh.toUnit(rough);
    for (let i = 0; i < triangles.length; i += 3) {
      const a = 3 * triangles[i];
      const b = 3 * triangles[i + 1];
      const c = 3 * triangles[i + 2];
      ClothMesh.add(normals, a, b, c, [0, 1, 2].map((axis) => rough[a + axis] + rough[b + axis] + rough[c + axis]));
    }
    ClothMesh.toUnit(normals);
  }
  static add(vectors, a, b, c, vector) {
    for (let axis = 0; axis < 3; ++axis) {
      vectors[a + axis] += vector[axis];
      vectors[b + axis] += vector[axis];
      vectors[c + axis] += vector[axis];
    }
  }
  static toUnit(vectors) {
    for (let i = 0; i < vectors.length; i += 3) {
      const size = Math.hypot(vectors[i], vectors[i + 1], vectors[i + 2]) || 1;
      for (let axis = 0; axis < 3; ++axis) vectors[i + axis] /= size;
    }
  }
}
