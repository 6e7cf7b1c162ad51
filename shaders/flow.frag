// Motion of surfaces.
#include "flow.glsl"
uniform float isKnown;  // else 0
in float before;
in vec4 next;
out vec4 colour;

void main() {
    if (before < 0.0) discard;
    colour = isKnown * motion(next);
}
