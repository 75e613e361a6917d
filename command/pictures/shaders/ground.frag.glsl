in vec3 place;

uniform vec3 normal;

out vec4 colour;

void main() {
  vec3 fromEye = place - eye.xyz;
  float distance = length(fromEye) / up.w;
  vec3 light = vec3(0.60, 0.59, 0.57) *
               (lampColour * (0.80 * max(dot(normal, towardsLamp.xyz), 0.0) * lampShare(place)) + ambient(normal));
  float haze = distance * distance / (distance * distance + 90.0);
  light = mix(light, backdrop(fromEye / (distance * up.w)), haze);
  colour = vec4(encoded(light) + dither(), 1);
}
