uniform sampler2DShadow shadowMap;

const vec3 lampColour = vec3(1.06, 1.0, 0.92);
const vec3 skyLight = vec3(0.25, 0.28, 0.32);      // from above
const vec3 groundLight = vec3(0.16, 0.148, 0.136);  // from below

vec3 sky(vec3 direction) {
  float height = dot(direction, up.xyz);
  vec3 horizon = vec3(0.80, 0.85, 0.88);
  vec3 zenith = vec3(0.42, 0.56, 0.70);
  return mix(horizon, zenith, smoothstep(-0.05, 0.75, height));
}

float tap(vec3 inMap, float x, float y) {
  return textureLod(shadowMap, vec3(inMap.xy + vec2(x, y) * shadow.y, inMap.z), 0.0);
}

vec3 inShadowMap(vec3 place) {
  vec3 inMap = (shadowFromWorld * vec4(place, 1)).xyz;
  return vec3(inMap.xy, min(inMap.z, 1.0));
}

// Share of the lamp's light that arrives, [0, 1]. The place is lifted by as much as a surface on a slope rises between
// what is looked at in the map, lest it shade itself.
float lit(vec3 place, vec3 normal) {
  float facing = dot(normal, towardsLamp.xyz);
  float lift = 0.5 * shadow.x * sqrt(max(1.0 - facing * facing, 0.04));
  vec3 at = inShadowMap(place + normal * (facing < 0.0 ? -lift : lift));
  return 0.25 * (tap(at, -0.33, -0.11) + tap(at, 0.11, -0.33) + tap(at, 0.33, 0.11) + tap(at, -0.11, 0.33));
}

// The same with a wide soft edge, as on a ground far below.
float softlyLit(vec3 place) {
  vec3 at = inShadowMap(place);
  float outside = tap(at, -0.95, -0.31) + tap(at, 0.31, -0.95) + tap(at, 0.95, 0.31) + tap(at, -0.31, 0.95);
  float inside = tap(at, -0.52, 0.16) + tap(at, -0.16, -0.52) + tap(at, 0.52, -0.16) + tap(at, 0.16, 0.52);
  return 0.125 * (outside + inside);
}

vec3 ambient(vec3 normal) { return mix(groundLight, skyLight, 0.5 + 0.5 * dot(normal, up.xyz)); }

// Trowbridge-Reitz, with the visibility term of Karis's approximation; F0 of water and of fibres.
float gloss(vec3 normal, vec3 towardsEye, float roughness) {
  vec3 between = normalize(towardsLamp.xyz + towardsEye);
  float alpha = roughness * roughness;
  float nh = max(dot(normal, between), 0.0);
  float lh = max(dot(towardsLamp.xyz, between), 0.1);
  float d = nh * nh * (alpha * alpha - 1.0) + 1.0;
  return 0.04 * alpha * alpha / (4.0 * d * d * lh * lh * (roughness + 0.5));
}

// Highlights bend over instead of being cut; then sRGB, by roots (I. Taylor), within a quarter of an 8-bit step.
vec3 encoded(vec3 light) {
  vec3 over = max(light - 0.7, 0.0);
  light = min(light, 0.7) + 0.3 * over / (over + 0.3);
  vec3 root2 = sqrt(light);
  vec3 root4 = sqrt(root2);
  vec3 root8 = sqrt(root4);
  vec3 curve = 0.662002687 * root2 + 0.684122060 * root4 - 0.323583601 * root8 - 0.0225411470 * light;
  return mix(12.92 * light, curve, step(0.0031308, light));
}
