layout(location = 0) in vec3 position;

uniform mat4 clipFromCaster;

void main() { gl_Position = clipFromCaster * vec4(position, 1); }
