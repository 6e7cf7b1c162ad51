// What of cloth, ropes, blocks and colliders can be seen: kept for light.frag, so that each pixel is lit once and small
// triangles cost little. Variants: PATTERN 0 … 4, WEAVE 0 … 4, SLUB, FUZZ, TWO_SIDED, FIBRES.
#ifdef FIBRES
#include "frame.glsl"
#endif
#include "octahedral.glsl"
#include "pattern.glsl"
#include "weave.glsl"
uniform int material;  // row of its table
uniform int mark;      // which surface, 1 … 255
in vec3 upright;
in vec2 along;  // [m] along the material
layout(location = 0) out vec4 tint;    // rgb: square root of the colour, finer where it is dark; a: openness, 0 … 1
layout(location = 1) out uvec4 shape;  // normal of the surface, of the threads, bits of 1 / distance, marks

#ifdef FIBRES
// The way of the warp over the picture, 128 steps of half a turn.
uint warpOver(vec3 warp) {
    vec4 there = viewProjection * vec4(place, 1.0);
    vec4 way = viewProjection * vec4(warp, 0.0);
    mat4 rows = transpose(viewProjection);
    vec2 over = (way.xy * there.w - there.xy * way.w) / vec2(length(rows[0].xyz), length(rows[1].xyz));
    return uint(atan(over.y, over.x) * 40.743665 + 256.5) & 127u;
}
#endif

void main() {
    vec3 normal = normalize(upright);
    uint side = 0u;  // 1: the back
#ifdef TWO_SIDED
    if (!gl_FrontFacing) {
        normal = -normal;
        side = 1u;
    }
#endif
    vec2 pixel = fwidth(along);
    vec3 colour = threadColour(along, pixel, patternColour(along, pixel));
    uint smoothNormal = octahedral(normal);
    float open = 1.0;
#ifdef FIBRES
    uint warp = warpOver(warpOn(along, normal));
#endif
#ifdef WEAVE
    open = weaveRelief(along, pixel, normal);
    shape.y = octahedral(normal);
#else
    shape.y = smoothNormal;
#endif
    tint = vec4(sqrt(colour), open);
    shape.xzw = uvec3(smoothNormal, floatBitsToUint(gl_FragCoord.w), uint(material) | side << 16 | uint(mark) << 24);
#ifdef FIBRES
    shape.w |= warp << 17;
#endif
}
