layout(location = 0) in vec2 corner;   // [pixels], from the upper left of the area
layout(location = 1) in vec2 inAtlas;  // [0, 1]
layout(location = 2) in vec4 tint;     // sRGB and cover

uniform vec2 areaSize;  // [pixels]

out vec2 at;
out vec4 paint;

void main() {
  at = inAtlas;
  paint = tint;
  gl_Position = vec4(2.0 * corner.x / areaSize.x - 1.0, 1.0 - 2.0 * corner.y / areaSize.y, 0, 1);
}
