layout(location = 0) in vec3 position;
uniform mat4 toMap;

void main() { gl_Position = vec4(2.0 * (toMap * vec4(position, 1.0)).xyz - 1.0, 1.0); }
