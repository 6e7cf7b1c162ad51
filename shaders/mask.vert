// What lies where, without light. `seenSide`: the plane in front of which the camera sees what there is.
#include "frame.glsl"
layout(location = 0) in vec3 position;
uniform mat4 transform;
uniform vec4 seenSide;
out float before;  // [m]

void main() {
    vec4 world = transform * vec4(position, 1.0);
    before = dot(seenSide, world);
    gl_Position = viewProjection * world;
}
