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
                     texelFetch(materials, ivec2(0, row), 0), texelFetch(materials, ivec2(1, row), 0), anisotropy);
    if (debug.x > 0.0) {
        float grey = dot(light, vec3(0.3, 0.6, 0.1));
        light = mix(light, vec3(0.4 * grey + 0.06), 0.85);
    }
    colour = vec4(filmic(light), float(shape.w >> 24) / 255.0);
}
