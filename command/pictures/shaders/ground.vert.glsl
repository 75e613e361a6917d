layout(location = 0) in vec2 corner;  // of the square from -1 to 1

uniform vec3 middle;
uniform vec3 alongU;  // as long as the square reaches [m]
uniform vec3 alongV;
uniform float behind;  // as of solids

out vec3 place;

void main() {
  place = middle + alongU * corner.x + alongV * corner.y;
  gl_Position = clipFromWorld * vec4(place, 1);
  gl_Position.z += behind * gl_Position.w;
}
