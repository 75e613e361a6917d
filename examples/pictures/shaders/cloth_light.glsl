in vec3 place;
in vec3 across;
in vec2 thread;
in float saturation;
in float value;

out vec4 colour;

// Light on the side that the eye sees, and what shines through from the other.
vec3 diffuse(vec3 normal, float lampShare, float through) {
  float facing = dot(normal, towardsLamp.xyz);
  float soft = max((facing + 0.15) / 1.15, 0.0);
  float behind = max(-facing, 0.0) * through;
  return lampColour * (lampShare * (0.80 * soft + behind)) + ambient(normal);
}

// Sheet over sheet: the place is lifted towards the lamp, lest the cloth shade itself.
float lampShare(vec3 normal) {
  float side = dot(normal, towardsLamp.xyz) < 0.0 ? -1.0 : 1.0;
  return lit(place + normal * (side * 2.5 * shadow.x));
}
