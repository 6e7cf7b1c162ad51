// How much light surfaces nearby leave of a place, 0 … 1, and its nearness [1 / m], for one pixel of 2 × 2: a mean over
// what rises above the surface within some reach on the screen (after McGuire and others 2011, the Alchemy obscurance).
#include "octahedral.glsl"
uniform sampler2D depths;
uniform usampler2D shapes;
uniform vec3 firstWay;  // as in light.frag
uniform vec3 rightWay;
uniform vec3 upWay;
uniform vec2 ends;       // [1 / m] nearness at depth 0 and 1
uniform float strength;  // 0: nothing takes light
out vec2 left;

const int taps = 12;
const float reach = 0.3;  // [m]

vec3 placeOf(ivec2 at, float depth) {
    vec2 middle = vec2(at) + 0.5;
    return (firstWay + middle.x * rightWay + middle.y * upWay) / mix(ends.x, ends.y, depth);
}

void main() {
    ivec2 here = 2 * ivec2(gl_FragCoord.xy), last = textureSize(depths, 0) - 1;
    float depth = texelFetch(depths, min(here, last), 0).r, near = mix(ends.x, ends.y, depth);
    float found = 0.0;
    int wanted = depth < 1.0 && strength > 0.0 ? taps : 0;
    vec3 place = placeOf(here, depth);
    vec3 normal = fromOctahedral(texelFetch(shapes, min(here, last), 0).x);
    float radius = clamp(reach * near * inversesqrt(dot(upWay, upWay)), 4.0, 90.0);  // [pixels]
    // The four pixels that light.frag takes the mean of look in four ways.
    float turn = float((here.x >> 1 & 1) + (here.y & 2)) * 0.25;
    for (int i = 0; i < wanted; ++i) {
        float part = (float(i) + 0.25 + 0.5 * turn) / float(taps);
        float angle = 6.2831853 * (1.618034 * float(i) + 0.25 * turn);
        ivec2 at = clamp(here + ivec2(radius * part * vec2(cos(angle), sin(angle))), ivec2(0), last);
        vec3 way = placeOf(at, texelFetch(depths, at, 0).r) - place;
        float square = dot(way, way);
        float rise = dot(way, normal) * inversesqrt(max(square, 1e-12)) - 0.08;
        found += max(rise, 0.0) * max(1.0 - square / (reach * reach), 0.0);
    }
    left = vec2(1.0 - strength * min(found / float(taps), 0.7), near);
}
