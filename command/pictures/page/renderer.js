const threads = 128;  // across a cloth; real ones would be finer than pixels
const shadowSoftness = 0.009;  // over the size of what there is to see
const sunk = 0.035;  // over the same: cloth sinks a little into what it lies on
/** A film of water makes what is below it darker, by reflecting inside, and smooth. */
const wetSolid = (colour, wet) => ({albedo: scaled(colour, 1 - 0.3 * wet), roughness: 0.7 - 0.5 * wet});
const metal = {albedo: [0.16, 0.17, 0.19], roughness: 0.4};
const water = {albedo: [0.30, 0.42, 0.50], roughness: 0.15};

/** Viridis, M. Zucker's polynomial; ColourMap.cpp has it for the pictures. */
function mappedColour(t) {
  const factors = [
    [0.27773, 0.00541, 0.33410], [0.10509, 1.40461, 1.38459], [-0.33086, 0.21485, 0.09510],
    [-4.63423, -5.79910, -19.33244], [6.22827, 14.17993, 56.69055], [4.77638, -13.74515, -65.35303],
    [-5.43546, 4.64585, 26.31244]];
  return [0, 1, 2].map((channel) =>
    clamped(factors.reduceRight((colour, factor) => colour * t + factor[channel], 0), 0, 1));
}

/** The picture's shaders are written for OpenGL 3.3; WebGL 2 wants another first line and precisions. */
function compiled(gl, kind, pieces) {
  const shader = gl.createShader(kind);
  const start = '#version 300 es\nprecision highp float;\nprecision highp sampler2DShadow;\n';
  gl.shaderSource(shader, start + pieces.join('\n').replace(/^#version.*$/m, ''));
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
  return shader;
}

class Program {
  constructor(gl, vertexPieces, fragmentPieces) {
    this.gl = gl;
    this.program = gl.createProgram();
    this.locations = new Map();
    gl.attachShader(this.program, compiled(gl, gl.VERTEX_SHADER, vertexPieces));
    gl.attachShader(this.program, compiled(gl, gl.FRAGMENT_SHADER, fragmentPieces));
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(this.program));
    const block = gl.getUniformBlockIndex(this.program, 'Picture');
    if (block !== gl.INVALID_INDEX) gl.uniformBlockBinding(this.program, block, 0);
    this.use({});
    gl.uniform1i(this.locationOf('shadowMap'), 0);
    gl.uniform1i(this.locationOf('colourMap'), 1);
  }
  /** To ask the graphics card is to wait for it: it is asked once. */
  locationOf(name) {
    if (!this.locations.has(name)) this.locations.set(name, this.gl.getUniformLocation(this.program, name));
    return this.locations.get(name);
  }
  /** @param uniforms  numbers, or arrays of 2, 3 or 16 numbers, by name */
  use(uniforms) {
    const {gl} = this;
    gl.useProgram(this.program);
    for (const [name, value] of Object.entries(uniforms)) {
      const at = this.locationOf(name);
      if (value.length === 16) gl.uniformMatrix4fv(at, false, value);
      else if (value.length === 3) gl.uniform3fv(at, value);
      else if (value.length === 2) gl.uniform2fv(at, value);
      else gl.uniform1f(at, value);
    }
  }
}

/** What all shaders of a picture know: the block Picture of common.glsl. */
class PictureBlock {
  constructor(gl, program) {
    this.gl = gl;
    this.program = program;
    const block = gl.getUniformBlockIndex(program, 'Picture');
    this.data = new Float32Array(
        gl.getActiveUniformBlockParameter(program, block, gl.UNIFORM_BLOCK_DATA_SIZE) / 4);
    this.buffer = gl.createBuffer();
    gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, this.buffer);
  }
  /** Where the numbers of these names are; those that no shader reads are left out. */
  findOffsets(names) {
    const {gl, program} = this;
    const indices = gl.getUniformIndices(program, names);
    const known = names.filter((_, i) => indices[i] !== gl.INVALID_INDEX);
    const offsets = gl.getActiveUniforms(program, gl.getUniformIndices(program, known), gl.UNIFORM_OFFSET);
    return known.map((name, i) => [name, offsets[i] / 4]);
  }
  set(values) {
    const {gl} = this;
    this.offsets = this.offsets || this.findOffsets(Object.keys(values));
    for (const [name, offset] of this.offsets) this.data.set(values[name], offset);
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.buffer);
    gl.bufferData(gl.UNIFORM_BUFFER, this.data, gl.DYNAMIC_DRAW);
  }
}

/** Depth as the lamp sees it. */
class ShadowMap {
  /** @param texels  along an edge */
  constructor(gl, texels) {
    this.gl = gl;
    this.texels = texels;
    this.texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, texels, texels);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    this.framebuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.texture, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  /** The map reaches a little beyond all points, moving and growing in steps, lest the edges of shadows shimmer. */
  fit(points, towardsLamp) {
    const right = perpendicular(towardsLamp);
    const up = cross(towardsLamp, right);
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const positions of points) {
      for (let i = 0; i < positions.length; i += 3) {
        const point = [positions[i], positions[i + 1], positions[i + 2]];
        [right, up, towardsLamp].forEach((axis, k) => {
          low[k] = Math.min(low[k], dot(axis, point));
          high[k] = Math.max(high[k], dot(axis, point));
        });
      }
    }
    Object.assign(this, {low: low.slice(), high: high.slice(), right, up, towardsLamp});
    this.width = 2 ** (Math.ceil(4 * Math.log2(1.1 * Math.max(high[0] - low[0], high[1] - low[1], 1e-3))) / 4);
    const step = this.width / 64;
    this.width += 2 * step;
    for (const k of [0, 1]) {
      const middle = step * Math.round((low[k] + high[k]) / 2 / step);
      low[k] = middle - this.width / 2;
      high[k] = middle + this.width / 2;
    }
    low[2] -= 0.1 * this.width;
    high[2] += 0.1 * this.width;
    this.depth = high[2] - low[2];
    this.clipFromWorld = product(orthographic(low, high), lookFrom([0, 0, 0], right, up, scaled(towardsLamp, -1)));
  }
  /** Of a plane, what can lie in shadow; null where light only grazes it. */
  footprintOn({normal, offset}) {
    const {low, high, right, up, towardsLamp} = this;
    const facing = dot(normal, towardsLamp);
    if (facing < 0.05) return null;
    const margin = 0.05 * this.width;  // for the soft edge
    const along = (point) => difference(point, scaled(towardsLamp, dot(normal, point) / facing));
    const middle = along(sum(scaled(right, (low[0] + high[0]) / 2), scaled(up, (low[1] + high[1]) / 2)));
    return {
      middle: sum(middle, scaled(towardsLamp, offset / facing)),
      alongU: along(scaled(right, (high[0] - low[0]) / 2 + margin)),
      alongV: along(scaled(up, (high[1] - low[1]) / 2 + margin)),
    };
  }
  fromWorld() {
    return product([0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0.5, 0.5, 0.5, 1], this.clipFromWorld);
  }
  begin() {
    const {gl} = this;
    gl.bindTexture(gl.TEXTURE_2D, null);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    gl.viewport(0, 0, this.texels, this.texels);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1.5, 4);
    gl.clear(gl.DEPTH_BUFFER_BIT);
  }
  end() {
    this.gl.disable(this.gl.POLYGON_OFFSET_FILL);
    this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, null);
  }
}

/** A lamp above and beside the first view. */
function lampOf({viewDirection, up}) {
  const sideways = cross(unit(viewDirection), up);
  const right = length(sideways) < 1e-3 ? perpendicular(up) : unit(sideways);
  const level = cross(up, right);
  return unit(difference(difference(up, scaled(right, 0.55)), scaled(level, 0.55)));
}

/** A ball around points. */
function ballAround(points) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const positions of points) {
    for (let i = 0; i < positions.length; ++i) {
      low[i % 3] = Math.min(low[i % 3], positions[i]);
      high[i % 3] = Math.max(high[i % 3], positions[i]);
    }
  }
  return {middle: scaled(sum(low, high), 0.5), radius: Math.max(length(difference(high, low)) / 2, 1e-3)};
}

/** How much greater the depth is a little farther from the eye than a place. */
function depthStep(clipFromWorld, eye, place, distance) {
  const row = (i, at) =>
    [0, 1, 2].reduce((all, k) => all + clipFromWorld[4 * k + i] * at[k], clipFromWorld[12 + i]);
  const depthAt = (at) => row(2, at) / row(3, at);
  return depthAt(sum(place, scaled(unit(difference(place, eye)), distance))) - depthAt(place);
}

/** Draws the run as the pictures of `wetcloth render` show it. */
class Renderer {
  /** @param isHurried  with rougher edges and shadows */
  constructor(canvas, run, isHurried = false) {
    const gl = canvas.getContext('webgl2', {antialias: !isHurried, alpha: false});
    if (!gl) throw new Error('This browser has no WebGL 2');
    Object.assign(this, {gl, canvas, run, scenery: run.scenery, lamp: lampOf(run.scenery)});
    this.makePrograms(run.shaders);
    this.block = new PictureBlock(gl, this.programs.cloth.program);
    this.shadowMap = new ShadowMap(gl, isHurried ? 512 : 1024);
    this.colourMap = this.madeColourMap();
    this.square = squareMesh(gl);
    this.nothing = gl.createVertexArray();
    this.drop = ballMesh(gl);
    this.cloths = run.cloths.map((track) => new ClothMesh(gl, track));
    this.solids = run.solids.map((solid) => new SolidMesh(gl, solid));
    this.bars = {of: null, meshes: []};
    this.setColouring('fabric');
  }

  makePrograms(shaders) {
    const {gl} = this;
    const {common, light, backdrop, clothLight} = shaders;
    const program = (vertex, ...fragment) => new Program(gl, [common, vertex], [common, ...fragment]);
    this.programs = {
      caster: program(shaders.casterVertex, shaders.casterFragment),
      cloth: program(shaders.clothVertex, light, clothLight, shaders.clothFragment),
      measured: program(shaders.clothVertex, light, clothLight, shaders.measuredFragment),
      solid: program(shaders.solidVertex, light, shaders.solidFragment),
      shadedGround: program(shaders.groundVertex, light, backdrop, shaders.groundShaded, shaders.groundFragment),
      ground: program(shaders.groundVertex, light, backdrop, shaders.groundOpen, shaders.groundFragment),
      water: program(shaders.groundVertex, light, shaders.waterFragment),
      backdrop: program(shaders.backdropVertex, light, backdrop, shaders.backdropFragment),
    };
  }

  madeColourMap() {
    const {gl} = this;
    const colours = Array.from({length: 256}, (_, i) => mappedColour(i / 255)).flat();
    const texture = gl.createTexture();
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, 256, 1, 0, gl.RGB, gl.UNSIGNED_BYTE,
                  Uint8Array.from(colours, (value) => Math.round(255 * value)));
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.activeTexture(gl.TEXTURE0);
    return texture;
  }

  setColouring(colouring) {
    this.colouring = colouring;
    this.scale = colouring === 'fabric' ? [0, 1] : this.run.ranges[colouring];
  }

  /** @param place  in frames, between two of them as well */
  draw(place, camera) {
    const frame = Math.min(Math.floor(place), this.run.times.length - 1);
    const share = frame + 1 < this.run.times.length ? place - frame : 0;
    for (const cloth of this.cloths) cloth.update(frame, share, this.colouring, this.scale);
    if (this.run.poses) this.poseSolids(frame, share);
    this.setBars(this.run.rods[frame]);
    const points = [...this.cloths.map((cloth) => cloth.positions), ...this.solids.map((solid) => solid.vertices)];
    this.ball = ballAround(points);
    this.size = this.size || 2 * this.ball.radius;
    this.gl.enable(this.gl.DEPTH_TEST);
    this.castShadows(points);
    this.setPicture(camera, this.run.times[frame]);
    this.drawCloths();
    this.drawSolids(this.run.drops[frame], this.run.wetness[frame]);
    this.drawGrounds();
    this.drawBackdrop();
    this.drawWater();
  }

  poseSolids(frame, share) {
    const from = this.run.poses[frame];
    const to = this.run.poses[share > 0 ? frame + 1 : frame];
    this.solids.forEach((solid, i) => solid.update(from[i], to[i], share));
  }

  /** A cloth's bars move with its pins. */
  setBars(rods) {
    const of = JSON.stringify(rods);
    if (this.bars.of !== of) this.bars = {of, meshes: rods.map((rod) => barMesh(this.gl, rod))};
  }

  castShadows(points) {
    this.shadowMap.fit(points, this.lamp);
    this.shadowMap.begin();
    const {caster} = this.programs;
    caster.use({clipFromCaster: this.shadowMap.clipFromWorld, behind: 0});
    for (const mesh of [...this.cloths.map((cloth) => cloth.mesh), ...this.bars.meshes]) mesh.draw();
    caster.use({behind: 2 * sunk * this.size / this.shadowMap.depth});
    for (const {mesh} of this.solids) mesh.draw();
    this.shadowMap.end();
  }

  setPicture(camera, time) {
    const {gl, canvas, ball} = this;
    const look = camera.look(canvas.width / canvas.height);
    const distance = length(difference(ball.middle, look.eye));
    const nearest = Math.max((distance - ball.radius) / 2, 0.01 * ball.radius);
    const lens = perspective(look.tangentX, look.tangentY, nearest, distance + 80 * ball.radius);
    const clipFromWorld = product(lens, lookFrom(look.eye, look.right, look.above, look.forward));
    this.behind = depthStep(clipFromWorld, look.eye, ball.middle, sunk * this.size);
    const softness = shadowSoftness * this.size + 2 * this.shadowMap.width / this.shadowMap.texels;
    this.block.set({
      clipFromWorld,
      shadowFromWorld: this.shadowMap.fromWorld(),
      eye: [...look.eye, 1],
      towardsLamp: [...this.lamp, 0],
      up: [...this.scenery.up, this.size],
      right: [...look.right, look.tangentX],
      above: [...look.above, look.tangentY],
      forward: [...look.forward, time],
      shadow: [softness, softness / this.shadowMap.width, 0, 0],
    });
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.depthFunc(gl.LEQUAL);
    gl.bindTexture(gl.TEXTURE_2D, this.shadowMap.texture);
  }

  drawCloths() {
    const program = this.colouring === 'fabric' ? this.programs.cloth : this.programs.measured;
    for (const cloth of this.cloths) {
      let first = 0;
      for (const {triangles, dryColour, wetColour, roughness} of cloth.track.facts.parts) {
        program.use({
          threadsPerMetre: threads / cloth.side, threadsPerLine: threads / 16, dryColour, wetColour, roughness});
        cloth.mesh.draw(first, triangles);
        first += triangles;
      }
    }
  }

  drawSolids(drops, wetness) {
    const {gl, programs: {solid}} = this;
    gl.vertexAttrib4f(2, 0, 0, 0, 1);  // the solid itself, neither moved nor scaled
    this.solids.forEach(({mesh, solid: {colour}}, i) => {
      solid.use({behind: this.behind, ...wetSolid(colour, wetness[i] || 0)});
      mesh.draw();
    });
    solid.use({behind: 0, ...metal});
    for (const mesh of this.bars.meshes) mesh.draw();
    if (drops.length === 0) return;
    solid.use({...water});
    this.drop.drawAt(drops);
  }

  drawGrounds() {
    const {gl} = this;
    gl.enable(gl.CULL_FACE);  // who is below the ground looks through it
    for (const ground of this.scenery.grounds) {
      const {normal, offset} = ground;
      const shaded = this.shadowMap.footprintOn(ground);
      if (shaded) this.drawGround(this.programs.shadedGround, normal, this.behind, shaded);
      this.drawGround(this.programs.ground, normal, 1.01 * this.behind, this.squareOn(normal, offset, 30 * this.size));
    }
    gl.disable(gl.CULL_FACE);
  }

  drawGround(program, normal, behind, where) {
    program.use({normal, behind, ...where});
    this.square.draw();
  }

  /** Of a plane, the square below what there is to see. */
  squareOn(normal, offset, reach) {
    const u = perpendicular(normal);
    const middle = difference(this.ball.middle, scaled(normal, dot(normal, this.ball.middle) - offset));
    return {middle, alongU: scaled(u, reach), alongV: scaled(cross(normal, u), reach)};
  }

  drawBackdrop() {
    this.programs.backdrop.use({});
    this.gl.bindVertexArray(this.nothing);
    this.gl.drawArrays(this.gl.TRIANGLES, 0, 3);
  }

  drawWater() {
    const {gl, scenery} = this;
    if (scenery.waterLevel === undefined) return;
    const reach = 6 * this.size;
    this.programs.water.use({behind: 0, reach, ...this.squareOn(scenery.up, scenery.waterLevel, reach)});
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    this.square.draw();
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }
}
