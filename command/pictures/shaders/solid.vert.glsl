layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 instance;  // moved by xyz [m], made w times as large

uniform float behind;  // cloth lies on solids: their depth is this much greater

out vec3 place;
out vec3 across;

void main() {
  place = position * instance.w + instance.xyz;
  across = normal;
  gl_Position = clipFromWorld * vec4(place, 1);
  gl_Position.z += behind * gl_Position.w;
}
