// What is seen where there is nothing.
vec3 backdrop(vec3 direction) {
  float height = dot(direction, up.xyz);
  vec3 low = vec3(0.60, 0.62, 0.63);
  vec3 horizon = vec3(0.74, 0.78, 0.80);
  vec3 high = vec3(0.42, 0.53, 0.64);
  return height > 0.0 ? mix(horizon, high, smoothstep(0.0, 0.7, height))
                      : mix(horizon, low, smoothstep(0.0, 0.8, -height));
}

// Hides the steps of eight bits in a smooth gradient (interleaved gradient noise, J. Jimenez).
float dither() { return (fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5) / 255.0; }
