// One triangle that covers the picture.
out vec3 direction;

void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1);
  direction = forward.xyz + right.xyz * (corner.x * right.w) + above.xyz * (corner.y * above.w);
  gl_Position = vec4(corner, 1, 1);
}
