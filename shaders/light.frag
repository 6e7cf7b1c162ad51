// Surfaces in sun and sky, from what surface.frag has kept of them.
#include "lit.glsl"
#include "octahedral.glsl"
uniform sampler2D tints;
uniform usampler2D shapes;
uniform sampler2D materials;  // three texels a row: colour of the back, roughness; sheen, dulled less greyed, translucency, woven; anisotropy, fuzz
uniform vec3 firstWay;        // from the eye through the picture's lower left corner, 1 m ahead
uniform vec3 rightWay;        // from one pixel to the next
uniform vec3 upWay;
uniform sampler2D hidden;  // of nearby.frag
out vec4 colour;

// The share of light that surfaces nearby leave, from the four places around that are as near.
float openNearby(ivec2 here, float near) {
    ivec2 low = (here - 1) >> 1, last = textureSize(hidden, 0) - 1;
    vec2 sum = vec2(1e-4);
    for (int i = 0; i < 4; ++i) {
        vec2 there = texelFetch(hidden, clamp(low + ivec2(i & 1, i >> 1), ivec2(0), last), 0).rg;
        sum += vec2(there.r, 1.0) * max(1.0 - 25.0 * abs(there.g / near - 1.0), 1e-4);
    }
    return sum.x / sum.y;
}

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    uvec4 shape = texelFetch(shapes, here, 0);
    vec4 tint = texelFetch(tints, here, 0);
    int row = int(shape.w & 65535u);
    bool isBack = (shape.w & 65536u) != 0u;
    float near = uintBitsToFloat(shape.z), ahead = 1.0 / near;
    tint.a *= openNearby(here, near);
    vec3 way = firstWay + gl_FragCoord.x * rightWay + gl_FragCoord.y * upWay;
    vec3 place = eye.xyz + ahead * way;
    vec3 toEye = -normalize(way);
    vec3 smoothNormal = fromOctahedral(shape.x);
    vec3 normal = fromOctahedral(shape.y);
    float steep = max(dot(smoothNormal, toEye), 0.05);
    float pixel = ahead * inversesqrt(steep) * length(upWay);

    vec2 strands = texelFetch(materials, ivec2(2, row), 0).xy;
    vec3 fibres = vec3(0.0);
    if (strands.x > 0.0) {
        float turn = float((shape.w >> 17) & 127u) / 40.743665;
        vec3 screenWay = cos(turn) * rightWay + sin(turn) * upWay;
        fibres = normalize(screenWay * dot(normal, toEye) - toEye * dot(normal, screenWay));
    }

    vec3 light = lit(place, toEye, smoothNormal, normal, fibres, pixel, isBack, vec4(tint.rgb * tint.rgb, tint.a),
                     texelFetch(materials, ivec2(0, row), 0), texelFetch(materials, ivec2(1, row), 0), strands);
    if (debug.x > 0.0) {
        float grey = dot(light, vec3(0.3, 0.6, 0.1));
        light = mix(light, vec3(0.4 * grey + 0.06), 0.85);
    }
    colour = vec4(filmic(light), float(shape.w >> 24) / 255.0);
}
