#include "frame.glsl"
uniform mat4 toWorld;  // inverse of viewProjection
out vec3 way;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    vec4 far = toWorld * vec4(corner, 1.0, 1.0);
    way = far.xyz / far.w - eye.xyz;
    gl_Position = vec4(corner, 1.0, 1.0);
}
