// Normals of surfaces, from what surface.frag has kept of them.
#include "octahedral.glsl"
uniform usampler2D shapes;
out vec4 colour;

void main() {
    uvec4 shape = texelFetch(shapes, ivec2(gl_FragCoord.xy), 0);
    if (shape.z == 0u) discard;
    colour = vec4(0.5 + 0.5 * fromOctahedral(shape.x), 1.0);
}
