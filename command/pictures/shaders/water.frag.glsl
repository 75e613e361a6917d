in vec3 place;

uniform vec3 middle;
uniform float reach;  // the surface fades out there [m]

out vec4 colour;

vec3 rippled() {
  float scale = 14.0 / up.w;
  vec2 at = vec2(dot(place, right.xyz), dot(place, cross(up.xyz, right.xyz))) * scale;
  float time = forward.w;
  vec2 slope = vec2(cos(at.x * 1.9 + at.y * 0.7 + 1.3 * time) + 0.6 * cos(at.x * 3.7 - at.y * 2.9 - 1.9 * time),
                    cos(at.y * 2.3 - at.x * 0.9 - 1.1 * time) + 0.6 * cos(at.y * 4.1 + at.x * 2.3 + 2.1 * time));
  return normalize(up.xyz + 0.022 * (right.xyz * slope.x + cross(up.xyz, right.xyz) * slope.y));
}

void main() {
  vec3 towardsEye = normalize(eye.xyz - place);
  vec3 normal = rippled();
  if (dot(up.xyz, towardsEye) < 0.0) normal = -normal;
  float rim = 1.0 - max(dot(normal, towardsEye), 0.0);
  float fresnel = 0.02 + 0.98 * rim * rim * rim * rim * rim;
  float shade = lit(place, up.xyz);
  vec3 body = vec3(0.02, 0.13, 0.18) * (0.75 + 0.35 * shade);
  vec3 light = mix(body, sky(reflect(-towardsEye, normal)), fresnel);
  light += lampColour * (3.0 * gloss(normal, towardsEye, 0.18) * shade);
  float away = length(place - middle) / reach;
  float cover = mix(0.58, 0.95, fresnel) * (1.0 - smoothstep(0.15, 1.0, away));
  colour = vec4(encoded(light), cover);
}
