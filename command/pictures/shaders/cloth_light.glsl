in vec3 place;
in vec3 across;
in vec2 thread;
in float saturation;
in float value;

out vec4 colour;

// Of the side that the eye sees. A face tells which one that is: at the rim of a fold smooth normals turn away from the
// eye before the faces do, and would be taken for those of the other side, which lies in shade.
vec3 seenNormal(vec3 towardsEye) {
  vec3 face = cross(dFdx(place), dFdy(place));
  vec3 normal = normalize(across);
  if (dot(face, towardsEye) * dot(face, normal) < 0.0) normal = -normal;
  return normalize(normal + towardsEye * max(-dot(normal, towardsEye), 0.0));
}

// Light on the side that the eye sees, and what shines through from the other.
vec3 diffuse(vec3 normal, float lampShare, float through) {
  float facing = dot(normal, towardsLamp.xyz);
  float soft = max((facing + 0.15) / 1.15, 0.0);
  float behind = max(-facing, 0.0) * through;
  return lampColour * (lampShare * (0.86 * soft + behind)) + ambient(normal);
}
