#include "frame.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
uniform mat4 transform;
uniform mat3 normalTransform;
out vec3 place;
out vec3 upright;
out vec2 along;

void main() {
    vec4 world = transform * vec4(position, 1.0);
    place = world.xyz;
    upright = normalTransform * normal;
    along = uv;
    gl_Position = viewProjection * world;
}
