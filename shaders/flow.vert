// What lies where, now and in the next picture; `seenSide` as in mask.vert.
#include "frame.glsl"
layout(location = 0) in vec3 position;
layout(location = 3) in vec3 nextPosition;
uniform mat4 transform;
uniform mat4 nextTransform;
uniform mat4 nextProjection;
uniform vec4 seenSide;
out float before;  // [m]
out vec4 next;

void main() {
    vec4 world = transform * vec4(position, 1.0);
    before = dot(seenSide, world);
    next = nextProjection * nextTransform * vec4(nextPosition, 1.0);
    gl_Position = viewProjection * world;
}
