// Vectors of three numbers, and matrices of 4 x 4 by columns.
const sum = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const difference = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const scaled = (a, factor) => [a[0] * factor, a[1] * factor, a[2] * factor];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.hypot(a[0], a[1], a[2]);
const unit = (a) => scaled(a, 1 / Math.max(length(a), 1e-12));
const perpendicular = (a) => unit(cross(a, Math.abs(a[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0]));
const clamped = (value, low, high) => Math.min(high, Math.max(low, value));

/** Turned about an axis of length 1 (Rodrigues). */
function turned(vector, axis, angle) {
  const along = scaled(axis, dot(axis, vector) * (1 - Math.cos(angle)));
  return sum(sum(scaled(vector, Math.cos(angle)), scaled(cross(axis, vector), Math.sin(angle))), along);
}

/** By a quaternion x, y, z, w of length 1. */
function turnedBy([x, y, z, w], vector) {
  const axis = [x, y, z];
  return sum(vector, scaled(cross(axis, sum(cross(axis, vector), scaled(vector, w))), 2));
}

function product(a, b) {
  const result = new Float32Array(16);
  for (let column = 0; column < 4; ++column) {
    for (let row = 0; row < 4; ++row) {
      for (let k = 0; k < 4; ++k) result[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    }
  }
  return result;
}

const lookFrom = (eye, right, up, forward) => [
  right[0], up[0], -forward[0], 0,
  right[1], up[1], -forward[1], 0,
  right[2], up[2], -forward[2], 0,
  -dot(right, eye), -dot(up, eye), dot(forward, eye), 1];

const perspective = (tangentX, tangentY, nearest, farthest) => [
  1 / tangentX, 0, 0, 0,
  0, 1 / tangentY, 0, 0,
  0, 0, -(farthest + nearest) / (farthest - nearest), -1,
  0, 0, -2 * farthest * nearest / (farthest - nearest), 0];

function orthographic(low, high) {
  const size = difference(high, low);
  const both = sum(high, low);
  return [
    2 / size[0], 0, 0, 0,
    0, 2 / size[1], 0, 0,
    0, 0, -2 / size[2], 0,
    -both[0] / size[0], -both[1] / size[1], both[2] / size[2], 1];
}
