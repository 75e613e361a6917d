layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 instance;  // moved by xyz [m], made w times as large

uniform float behind;  // cloth lies on solids: they are drawn this much farther from the eye [m]

out vec3 place;
out vec3 across;

void main() {
  place = position * instance.w + instance.xyz;
  across = normal;
  vec3 fromEye = place - eye.xyz;
  gl_Position = clipFromWorld * vec4(place + normalize(fromEye) * behind, 1);
}
