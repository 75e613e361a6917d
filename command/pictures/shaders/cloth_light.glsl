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
  return lampColour * (lampShare * (0.86 * soft + behind)) + ambient(normal);
}
