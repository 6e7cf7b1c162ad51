// Surfaces in sun and sky, from what surface.frag has kept of them.
#include "lit.glsl"
#include "octahedral.glsl"
uniform sampler2D tints;
uniform usampler2D shapes;
uniform sampler2D materials;  // three texels a row: colour of the back, roughness; sheen, dulled less greyed, translucency, woven; anisotropy
uniform vec3 firstWay;        // from the eye through the picture's lower left corner, 1 m ahead
uniform vec3 rightWay;        // from one pixel to the next
uniform vec3 upWay;
out vec4 colour;

// Which part of the light from all around surfaces nearby keep away, 0 … 1: how far what is seen at some places around
// rises above the surface (after McGuire and others 2011, "The Alchemy screen-space ambient obscurance algorithm").
float hiddenNearby(vec3 place, vec3 normal, float ahead) {
    const float reach = 0.15;       // [m]
    const float mostPixels = 48.0;  // `around` in engine/taut/render/targets.cpp
    const int taps = 12;
    float radius = min(reach / (ahead * length(upWay)), mostPixels);
    float noise = pixelNoise(), sum = 0.0;
    vec2 side = vec2(0.8, 0.6);
    ivec2 last = textureSize(shapes, 0) - 1;
    for (int i = 0; i < taps; ++i) {
        vec2 there = floor(gl_FragCoord.xy + side * (radius * (float(i) + noise) / float(taps)));
        uint nearness = texelFetch(shapes, clamp(ivec2(there), ivec2(0), last), 0).z;
        vec3 way = firstWay + (there.x + 0.5) * rightWay + (there.y + 0.5) * upWay;
        vec3 to = eye.xyz + way / max(uintBitsToFloat(nearness), 1e-6) - place;  // far away where there is nothing
        float square = dot(to, to);
        float rise = dot(to, normal) * inversesqrt(max(square, 1e-12)) - 0.12;
        sum += max(rise, 0.0) * max(1.0 - square / (reach * reach), 0.0);
        side = goldenTurn * side;
    }
    return min(3.0 / float(taps) * sum, 0.85);
}

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    uvec4 shape = texelFetch(shapes, here, 0);
    vec4 tint = texelFetch(tints, here, 0);
    int row = int(shape.w & 65535u);
    bool isBack = (shape.w & 65536u) != 0u;
    float ahead = 1.0 / uintBitsToFloat(shape.z);
    vec3 way = firstWay + gl_FragCoord.x * rightWay + gl_FragCoord.y * upWay;
    vec3 place = eye.xyz + ahead * way;
    vec3 toEye = -normalize(way);
    vec3 smoothNormal = fromOctahedral(shape.x);
    vec3 normal = fromOctahedral(shape.y);
    float steep = max(dot(smoothNormal, toEye), 0.05);
    float pixel = ahead * inversesqrt(steep) * length(upWay);

    float anisotropy = texelFetch(materials, ivec2(2, row), 0).x;
    vec3 fibres = vec3(0.0);
    if (anisotropy > 0.0) {
        float turn = float((shape.w >> 17) & 127u) / 40.743665;
        vec3 screenWay = cos(turn) * rightWay + sin(turn) * upWay;
        fibres = normalize(screenWay * dot(normal, toEye) - toEye * dot(normal, screenWay));
    }

    vec3 light = lit(place, toEye, smoothNormal, normal, fibres, pixel, isBack, vec4(tint.rgb * tint.rgb, tint.a),
                     texelFetch(materials, ivec2(0, row), 0), texelFetch(materials, ivec2(1, row), 0), anisotropy,
                     1.0 - hiddenNearby(place, smoothNormal, ahead));
    if (debug.x > 0.0) {
        float grey = dot(light, vec3(0.3, 0.6, 0.1));
        light = mix(light, vec3(0.4 * grey + 0.06), 0.85);
    }
    colour = vec4(filmic(light), float(shape.w >> 24) / 255.0);
}
