// What of cloth, ropes, blocks and colliders can be seen: kept for light.frag, so that each pixel is lit once and small
// triangles cost little. Variants: PATTERN 0 … 4, WEAVE, TWO_SIDED, FIBRES.
#ifdef FIBRES
#include "frame.glsl"
#endif
#include "pattern.glsl"
uniform float weave;
uniform float thread;  // [m]
uniform int material;  // row of its table
uniform int mark;      // which surface, 1 … 255
in vec3 upright;
in vec2 along;  // [m] along the material
layout(location = 0) out vec4 tint;    // rgb: square root of the colour, finer where it is dark; a: openness, 0 … 1
layout(location = 1) out uvec4 shape;  // normal of the surface, of the threads, bits of 1 / distance, marks

// A unit vector as a place on an octahedron, 16 bits a coordinate.
uint octahedral(vec3 n) {
    n *= 1.0 / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    uvec2 steps = uvec2((n.z < 0.0 ? folded : n.xy) * 32767.0 + 32767.5);
    return steps.x | steps.y << 16;
}

#if defined(WEAVE) || defined(FIBRES)
in vec3 place;
#endif

#ifdef WEAVE
// Over and under: each cell of the weave is a pillow, stretched along the thread that lies on top. Tilts the normal
// and returns how open the place is, 0 … 1. Fades, along either thread, where threads become smaller than pixels.
float weaveRelief(vec2 uv, vec2 pixel, inout vec3 normal) {
    vec2 cell = uv / thread;
    vec2 middle = fract(cell) - 0.5;
    vec2 index = floor(cell);
    float warp = mod(index.x + index.y, 2.0);
    vec2 fine = pixel / thread;  // threads a pixel; gaps are finer than threads and fade first, into their mean
    vec2 tilt = weave * clamp(1.5 - 3.1 * fine, 0.0, 1.0) * middle * mix(vec2(0.8, 2.0), vec2(2.0, 0.8), warp);
    vec2 square = 4.0 * middle * middle;
    vec2 gap = mix(vec2(0.25), square * square, clamp(1.3 - 3.0 * fine, 0.0, 1.0));

    // Directions of the material on the surface, from how place and uv change over the screen.
    vec3 placeX = dFdx(place);
    vec3 placeY = dFdy(place);
    vec2 uvX = dFdx(uv);
    vec2 uvY = dFdy(uv);
    vec3 down = placeX * uvY.y - placeY * uvX.y;
    vec3 across = placeY * uvX.x - placeX * uvY.x;
    down *= inversesqrt(max(dot(down, down), 1e-20));
    across *= inversesqrt(max(dot(across, across), 1e-20));
    float turned = uvX.x * uvY.y - uvX.y * uvY.x < 0.0 ? -1.0 : 1.0;
    normal = normalize(normal + turned * (tilt.x * down + tilt.y * across));
    return 1.0 - 0.55 * weave * max(gap.x, gap.y);
}
#endif

#ifdef FIBRES
// The way of the warp over the picture, 128 steps of half a turn. On a triangle v stays along it; with the normal it turns
// from that of the triangle to that of the surface.
uint warpOver(vec2 uv, vec3 normal) {
    vec3 placeX = dFdx(place);
    vec3 placeY = dFdy(place);
    vec3 warp = placeX * dFdy(uv).y - placeY * dFdx(uv).y;
    warp *= inversesqrt(max(dot(warp, warp), 1e-20));
    vec3 flatNormal = cross(placeX, placeY);
    flatNormal *= inversesqrt(max(dot(flatNormal, flatNormal), 1e-30));
    flatNormal = dot(flatNormal, normal) < 0.0 ? -flatNormal : flatNormal;
    warp -= (flatNormal + normal) * (dot(normal, warp) / (1.0 + dot(flatNormal, normal)));
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
    vec3 colour = patternColour(along, pixel);
    uint smoothNormal = octahedral(normal);
    float open = 1.0;
#ifdef FIBRES
    uint warp = warpOver(along, normal);
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
