// A surface once more, for its outline. What lies on the other side of the ground is cut off.
#include "frame.glsl"
layout(location = 0) in vec3 position;
uniform mat4 transform;
uniform vec4 seenSide;  // plane with the seen side in front
out float gl_ClipDistance[1];

void main() {
    vec4 world = transform * vec4(position, 1.0);
    gl_ClipDistance[0] = dot(seenSide, world);
    gl_Position = viewProjection * world;
}
