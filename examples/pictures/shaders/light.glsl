uniform sampler2DShadow shadowMap;

const vec3 lampColour = vec3(1.06, 1.0, 0.92);
const vec3 skyLight = vec3(0.29, 0.32, 0.36);     // from above
const vec3 groundLight = vec3(0.20, 0.185, 0.17);  // from below

const vec2 disc[8] = vec2[](vec2(-0.70, -0.22), vec2(0.28, -0.86), vec2(0.80, -0.28), vec2(-0.25, -0.55),
                            vec2(0.30, 0.18), vec2(-0.62, 0.56), vec2(-0.10, 0.90), vec2(0.74, 0.58));

vec3 sky(vec3 direction) {
  float height = dot(direction, up.xyz);
  vec3 horizon = vec3(0.80, 0.85, 0.88);
  vec3 zenith = vec3(0.42, 0.56, 0.70);
  return mix(horizon, zenith, smoothstep(-0.05, 0.75, height));
}

// Share of the lamp's light that arrives, [0, 1].
float lit(vec3 place) {
  vec3 inMap = (shadowFromWorld * vec4(place, 1)).xyz;
  float sum = 0;
  for (int i = 0; i < 8; ++i) sum += texture(shadowMap, vec3(inMap.xy + disc[i] * shadow.y, inMap.z));
  return sum * 0.125;
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

// Highlights bend over instead of being cut; then sRGB.
vec3 encoded(vec3 light) {
  vec3 over = max(light - 0.7, 0.0);
  light = min(light, 0.7) + 0.3 * over / (over + 0.3);
  return mix(12.92 * light, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light));
}
