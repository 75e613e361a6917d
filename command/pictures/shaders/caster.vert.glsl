layout(location = 0) in vec3 position;

uniform mat4 clipFromCaster;
uniform float behind;  // as of solids

void main() {
  gl_Position = clipFromCaster * vec4(position, 1);
  gl_Position.z += behind;
}
