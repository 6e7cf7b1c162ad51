// The picture that stands around a scene: see engine/taut/render/private/environment.h.
uniform sampler2D environment;

vec3 turnedBack(vec3 way) {
    return vec3(around.x * way.x - around.y * way.z, way.y, around.y * way.x + around.x * way.z);
}

// What shines from a direction, as the mean over a cone [rad].
vec3 lightFrom(vec3 way, float cone) {
    vec3 n = turnedBack(way);
    vec2 at = vec2(atan(n.x, -n.z) * 0.15915494 + 0.5, acos(clamp(n.y, -1.0, 1.0)) * 0.31830989);
    return around.z * textureLod(environment, at, log2(max(cone * around.w, 1.0))).rgb;
}

// What a white matt surface sends back.
vec3 lightOn(vec3 normal) {
    vec3 n = turnedBack(normal);
    vec3 light = ambient[0].rgb + n.y * ambient[1].rgb + n.z * ambient[2].rgb + n.x * ambient[3].rgb;
    light += n.x * n.y * ambient[4].rgb + n.y * n.z * ambient[5].rgb + (3.0 * n.y * n.y - 1.0) * ambient[6].rgb;
    light += n.x * n.z * ambient[7].rgb + (n.x * n.x - n.z * n.z) * ambient[8].rgb;
    return max(light, 0.0);
}
