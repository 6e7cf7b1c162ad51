// How much of a light reaches a place, 0 … 1. `facing` is the surface's normal, on the side of the light.
// `pixel`: the size of a pixel on the surface [m]. `casts`: whether the surface itself is in the shadow map. Then the
// place is lifted off it by as far as is looked around at least: a texel, or the better part of a pixel.
//
// The penumbra is as wide as the distance to what throws the shadow makes it (percentage-closer soft shadows,
// Fernando 2005). Reading the map is dear, so the map of bounds (least and largest depth around) tells first where
// nothing can be in between. A branch saves nothing on a processor that runs pixels in groups, a loop that ends
// early does.
//
// WIDE where a light is so large that its penumbra may be wider than those bounds reach: then there are second ones
// that reach further.
#ifdef WIDE
const int mostSearches = 12;
const int mostTaps = 32;
#else
const int mostSearches = 8;
const int mostTaps = 20;
#endif

// How much of the four texels around lies behind a depth.
#ifdef GL_ES  // three.js cannot bind samplers that compare
#define sampler2DShadow sampler2D
float litAt(sampler2D map, vec3 at) {
    vec2 texel = at.xy * vec2(textureSize(map, 0)) - 0.5;
    ivec2 low = ivec2(floor(texel)), last = textureSize(map, 0) - 1;
    vec4 lit;
    for (int i = 0; i < 4; ++i)
        lit[i] = step(at.z, texelFetch(map, clamp(low + ivec2(i & 1, i >> 1), ivec2(0), last), 0).r);
    lit.xy = mix(lit.xy, lit.zw, fract(texel.y));
    return mix(lit.x, lit.y, fract(texel.x));
}
#else
float litAt(sampler2DShadow map, vec3 at) { return textureLod(map, at, 0.0); }
#endif

const mat2 goldenTurn = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688);

// `toMap`, `toLight` and `mapSize` are those of the light, `size` its apparent size, `reach` how far the second bounds
// reach [blocks]; `compared` and `depths` are the same map.
float reaching(vec3 place, vec3 facing, float pixel, bool casts, mat4 toMap, mat3 toLight, vec4 mapSize, float size,
               float reach, sampler2DShadow compared, sampler2D depths, sampler2D boundsAround) {
    const float blocks = 128.0;
    float texel = mapSize.w;
    float grain = casts ? max(texel, 0.7 * pixel) : 0.0;
    vec3 n = toLight * facing;
    vec3 at = (toMap * vec4(place + facing * grain, 1.0)).xyz;
    vec4 around = textureLod(boundsAround, at.xy, 0.0);
    float depth = min(at.z, 1.0);

    // Depth along the surface's own plane, and how far it can rise within the neighbourhood.
    vec2 slope = n.xy / max(n.z, 0.15);
    float rise = casts ? length(slope) * 2.5 * max(mapSize.x, mapSize.y) / blocks : 0.0;
    float gap = (at.z - around.r) * mapSize.z;
    bool alone = gap < rise + 2.0 * texel;  // nothing but the surface itself
#ifdef WIDE
    rise *= (reach + 1.0) / 2.5;
    gap = (at.z - around.b) * mapSize.z;
    alone = alone && gap < rise + 2.0 * texel;
    vec2 bounds = around.ba;
#else
    vec2 bounds = around.rg;
#endif
    bool clear = depth - bounds.r <= 0.0005;
    bool dark = depth - rise / mapSize.z > bounds.g + 0.0005;
    bool known = clear || dark || alone;

    float angle = 6.2831853 * pixelNoise();
    vec2 way = alone ? vec2(0.8, 0.6) : vec2(cos(angle), sin(angle));  // few taps are better off without noise
    vec2 toUv = 1.0 / mapSize.xy;
    vec2 rising = slope / mapSize.z;
    float ref = at.z - 0.5 * grain / mapSize.z;
    float narrowest = 1.5 * min(mapSize.x, mapSize.y) / blocks;
    float least = min(max(1.2 * texel, 0.7 * pixel), narrowest);
#ifdef WIDE
    float widest = reach * min(mapSize.x, mapSize.y) / blocks;
#else
    float widest = narrowest;
#endif

    // How far away are the things in between, on average?
    float radius = clamp(0.5 * size * gap, least, widest);
    vec2 found = vec2(0.0);  // sum of distances, number
    // Where even the farthest throws no penumbra that is wider than the map or the picture shows, that is enough.
    bool narrow = radius <= max(2.0 * texel, pixel);
    int searches = known || narrow ? 0 : mostSearches;
    const float searchShare = 1.0 / float(mostSearches);
    for (int i = 0; i < searches; ++i) {
        vec2 off = way * (radius * sqrt((float(i) + 0.5) * searchShare));
        float met = textureLod(depths, at.xy + off * toUv, 0.0).r;
        float between = ref + dot(rising, off) - met;
#ifdef WIDE
        between = met < 1.0 ? between : 0.0;  // 1 is nothing; a narrow light makes little of it
#endif
        found += between > 0.0 ? vec2(between, 1.0) : vec2(0.0);
        way = goldenTurn * way;
    }
    float away = found.x / max(found.y, 1.0) * mapSize.z;
    radius = alone ? least : narrow ? radius : clamp(0.5 * size * away, least, widest);

    int taps = clear || dark ? 0 : (alone ? 3 : clamp(int(2.0 * radius / texel), 6, mostTaps));
    float share = 1.0 / float(max(taps, 1));
#ifdef WIDE
    float ring = 1.0 / (float(max(taps, 1)) - 0.5);  // the last tap lies on the rim: a wide penumbra ends there
#else
    float ring = share;
#endif
    float reached = 0.0;
    for (int i = 0; i < taps; ++i) {
        vec2 off = way * (radius * sqrt((float(i) + 0.5) * ring));
        reached += litAt(compared, vec3(at.xy + off * toUv, min(ref + dot(rising, off), 1.0)));
        way = goldenTurn * way;
    }
    return taps == 0 ? (dark && !clear ? 0.0 : 1.0) : share * reached;
}

uniform sampler2DShadow shadowMap;
uniform sampler2D shadowDepth;  // the same map, as depth
uniform sampler2D shadowBounds;

float sunlight(vec3 place, vec3 facing, float pixel, bool casts) {
    return reaching(place, facing, pixel, casts, toMap, mat3(toLight), mapSize, lightWay.w, lightColour.w, shadowMap,
                    shadowDepth, shadowBounds);
}
