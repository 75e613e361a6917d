in vec3 place;
in vec3 across;

uniform vec3 albedo;
uniform float roughness;

out vec4 colour;

void main() {
  vec3 normal = normalize(across);
  vec3 towardsEye = normalize(eye.xyz - place);
  float facing = max(dot(normal, towardsLamp.xyz), 0.0);
  float lamp = lit(place, normal);
  float rim = 1.0 - max(dot(normal, towardsEye), 0.0);
  vec3 light = albedo * (lampColour * (0.85 * facing * lamp) + ambient(normal));
  light += lampColour * (2.0 * gloss(normal, towardsEye, roughness) * facing * lamp);
  light += sky(reflect(-towardsEye, normal)) * ((1.0 - roughness) * (0.02 + 0.3 * rim * rim * rim));
  colour = vec4(encoded(light), 1);
}
