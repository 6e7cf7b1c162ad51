// How much of the light reaches a place, 0 … 1. `facing` is the surface's normal, on the side of the light.
// `casts`: whether the surface itself is in the shadow map.
//
// The penumbra is as wide as the distance to what throws the shadow makes it. Reading the map is dear, so the map
// of bounds (least and largest depth around) tells first where nothing can be in between. A branch saves nothing
// on a processor that runs pixels in groups, a loop that ends early does.
uniform sampler2DShadow shadowMap;
uniform sampler2D shadowBounds;

float sunlight(vec3 place, vec3 facing, bool casts) {
    const float blocks = 128.0;
    vec3 n = mat3(toLight) * facing;
    vec3 at = (toMap * vec4(place + facing * (casts ? mapSize.w : 0.0), 1.0)).xyz;
    vec2 bounds = textureLod(shadowBounds, at.xy, 0.0).rg;
    float depth = min(at.z, 1.0);

    // Depth along the surface's own plane, and how far it can rise within the neighbourhood.
    vec2 slope = n.xy / max(n.z, 0.15);
    float widest = max(mapSize.x, mapSize.y);
    float rise = casts ? length(slope) * 2.5 * widest / blocks : 0.0;
    float gap = (at.z - bounds.r) * mapSize.z;
    bool clear = depth - bounds.r <= 0.0005;
    bool dark = depth - rise / mapSize.z > bounds.g + 0.0005;
    bool near = gap < rise + 2.0 * mapSize.w;  // nothing but the surface itself

    float least = 1.2 * mapSize.w;
    float radius = near ? least : clamp(0.5 * lightWay.w * gap, least, 1.5 * min(mapSize.x, mapSize.y) / blocks);
    int pairs = clear || dark ? 0 : (near ? 2 : 8);

    float angle = 6.2831853 * pixelNoise();
    vec2 way = vec2(cos(angle), sin(angle));
    float reached = 0.0;
    float step = 1.0 / float(max(pairs, 1));
    float bias = 0.5 * mapSize.w;
    for (int i = 0; i < pairs; ++i) {
        vec2 off = way * (radius * sqrt((float(i) + 0.5) * step));
        vec2 uv = off / mapSize.xy;
        float rises = dot(slope, off) / mapSize.z;
        float ref = at.z - bias / mapSize.z;
        reached += textureLod(shadowMap, vec3(at.xy + uv, min(ref + rises, 1.0)), 0.0);
        reached += textureLod(shadowMap, vec3(at.xy - uv, min(ref - rises, 1.0)), 0.0);
        way = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688) * way;  // the golden angle
    }
    return pairs == 0 ? (dark && !clear ? 0.0 : 1.0) : 0.5 * step * reached;
}
