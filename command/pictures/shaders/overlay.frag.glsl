in vec2 at;
in vec4 paint;

uniform sampler2D atlas;

out vec4 colour;

void main() { colour = vec4(paint.rgb, paint.a * texture(atlas, at).r); }
