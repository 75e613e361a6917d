uniform vec3 dryColour;
uniform vec3 wetColour;
uniform vec2 roughness;        // dry, wet
uniform float threadsPerLine;  // of the checked pattern

// How much of the pixel is on a line of width 1/8 that repeats every 1, in each direction (after I. Quilez).
vec2 lines(vec2 at, vec2 width) {
  vec2 a = at + 0.5 * width;
  vec2 b = at - 0.5 * width;
  return (floor(a) + min(fract(a) * 8.0, 1.0) - floor(b) - min(fract(b) * 8.0, 1.0)) / (8.0 * width);
}

// A plain weave and a large window-pane pattern, both filtered over the pixel.
float pattern() {
  vec2 width = fwidth(thread) + 1e-4;
  float blurred = max(width.x, width.y);
  float fade = clamp(2.0 - 5.0 * blurred, 0.0, 1.0);
  vec2 wave = sin(3.14159265 * thread);
  float weave = 1.0 + fade * (0.16 * wave.x * wave.y - 0.05);
  vec2 line = lines(thread / threadsPerLine, width / threadsPerLine);
  return weave * (1.0 - 0.13 * (line.x + line.y));
}

void main() {
  vec3 towardsEye = normalize(eye.xyz - place);
  vec3 normal = seenNormal(towardsEye);
  float facing = dot(normal, towardsEye);
  float wet = clamp(saturation, 0.0, 1.0);
  float threads = pattern();
  vec3 albedo = mix(dryColour, wetColour, wet) * threads;
  float lamp = lit(place, normal);
  float rough = max(mix(roughness.x, roughness.y, wet), 0.50);  // threads and folds finer than the mesh
  float rim = 1.0 - facing;
  float fuzz = rim * rim * rim;
  vec3 light = albedo * (diffuse(normal, lamp, 0.30) + 0.22 * fuzz * (1.0 - wet));
  float shine = gloss(normal, towardsEye, rough) * max(dot(normal, towardsLamp.xyz), 0.0) * lamp;
  light += lampColour * (shine * threads * (0.5 + 0.9 * wet));
  light += sky(reflect(-towardsEye, normal)) * (wet * wet * (0.006 + 0.10 * fuzz * rim * rim));  // film of water
  colour = vec4(encoded(light), 1);
}
