in vec3 direction;

out vec4 colour;

void main() {
  vec3 light = backdrop(normalize(direction));
  colour = vec4(encoded(light) + dither(), 1);
}
