// A unit vector as a place on an octahedron, 16 bits a coordinate.
uint octahedral(vec3 n) {
    n *= 1.0 / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    uvec2 steps = uvec2((n.z < 0.0 ? folded : n.xy) * 32767.0 + 32767.5);
    return steps.x | steps.y << 16;
}

vec3 fromOctahedral(uint bits) {
    vec2 at = (vec2(bits & 65535u, bits >> 16) - 32767.0) / 32767.0;
    vec3 n = vec3(at, 1.0 - abs(at.x) - abs(at.y));
    float folded = max(-n.z, 0.0);
    n.xy += vec2(n.x < 0.0 ? folded : -folded, n.y < 0.0 ? folded : -folded);
    return normalize(n);
}
