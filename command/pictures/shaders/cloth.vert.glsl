layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 state;    // saturation; what is coloured by, [0, 1]
layout(location = 3) in vec2 texture;  // [m]

uniform float threadsPerMetre;

out vec3 place;
out vec3 across;
out vec2 thread;
out float saturation;
out float value;

void main() {
  place = position;
  across = normal;
  thread = texture * threadsPerMetre;
  saturation = state.x;
  value = state.y;
  gl_Position = clipFromWorld * vec4(position, 1);
}
