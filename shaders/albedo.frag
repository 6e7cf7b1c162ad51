// Colours of surfaces without light, from what surface.frag has kept of them.
#include "tone.glsl"
uniform sampler2D tints;
uniform usampler2D shapes;
uniform sampler2D materials;  // as in light.frag
out vec4 colour;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    uvec4 shape = texelFetch(shapes, here, 0);
    if (shape.z == 0u) discard;
    vec3 tint = texelFetch(tints, here, 0).rgb;
    int row = int(shape.w & 65535u);
    vec3 albedo = albedoOf((shape.w & 65536u) != 0u, tint * tint, texelFetch(materials, ivec2(0, row), 0).rgb,
                           texelFetch(materials, ivec2(1, row), 0).y);
    colour = vec4(encoded(albedo), 1.0);
}
