uniform sampler2D colourMap;

// The least light that still shows the form: a value's colour should be found on the bar.
void main() {
  vec3 normal = seenNormal(normalize(eye.xyz - place));
  float shade = 0.80 + 0.20 * clamp(0.75 * lit(place, normal) * (dot(normal, towardsLamp.xyz) + 0.35), 0.0, 1.0);
  colour = vec4(texture(colourMap, vec2(value, 0.5)).rgb * shade, 1);
}
