uniform sampler2D picture;
uniform vec2 origin;  // of the area [pixels]

out vec4 colour;

float brightness(vec3 light) { return dot(light, vec3(0.299, 0.587, 0.114)); }

// Smooths the steps of edges, as T. Lottes's FXAA does: blurs along the edge where neighbours differ.
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy - origin);
  ivec2 last = textureSize(picture, 0) - 1;
  vec3 middle = texelFetch(picture, here, 0).rgb;
  float upLeft = brightness(texelFetch(picture, clamp(here + ivec2(-1, 1), ivec2(0), last), 0).rgb);
  float upRight = brightness(texelFetch(picture, clamp(here + ivec2(1, 1), ivec2(0), last), 0).rgb);
  float downLeft = brightness(texelFetch(picture, clamp(here + ivec2(-1, -1), ivec2(0), last), 0).rgb);
  float downRight = brightness(texelFetch(picture, clamp(here + ivec2(1, -1), ivec2(0), last), 0).rgb);
  float centre = brightness(middle);
  float least = min(centre, min(min(upLeft, upRight), min(downLeft, downRight)));
  float most = max(centre, max(max(upLeft, upRight), max(downLeft, downRight)));
  vec2 along = vec2(downLeft + downRight - upLeft - upRight, upLeft + downLeft - upRight - downRight);
  float reduce = max(0.03125 * (upLeft + upRight + downLeft + downRight), 0.0078125);
  along = clamp(along / (min(abs(along.x), abs(along.y)) + reduce), -8.0, 8.0);
  vec2 texel = 1.0 / vec2(last + 1);
  vec2 at = (vec2(here) + 0.5) * texel;
  vec3 near = 0.5 * (texture(picture, at - along * texel / 6.0).rgb + texture(picture, at + along * texel / 6.0).rgb);
  vec3 wide = 0.5 * near + 0.25 * (texture(picture, at - along * texel * 0.5).rgb +
                                   texture(picture, at + along * texel * 0.5).rgb);
  float widest = brightness(wide);
  vec3 smoothed = widest < least || widest > most ? near : wide;
  colour = vec4(most - least > 0.06 ? smoothed : middle, 1);
}
