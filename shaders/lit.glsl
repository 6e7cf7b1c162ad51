// What a surface sends back of sun and sky. LAMPS further lights shine on it besides.
#include "tone.glsl"
#include "shadow.glsl"
#ifdef ENVIRONMENT
#include "environment.glsl"
#else
vec3 lightOn(vec3 normal) { return hemisphere(normal); }
vec3 lightFrom(vec3 way, float cone) { return hemisphere(way); }
#endif
#if LAMPS > 0
#include "lamps.glsl"
#endif

// The gloss around a normal of what stands between light and eye, of exponent.x along the fibres and exponent.y across
// (Ashikhmin and Shirley 2000).
float glossOf(vec3 normal, vec3 fibres, vec3 halfWay, vec2 exponent) {
    float even = max(dot(normal, halfWay), 0.0);
    if (exponent.x == exponent.y) return pow(even, exponent.x) * (exponent.x + 8.0) * 0.125;
    float along = dot(fibres, halfWay), part = along * along / max(1.0 - even * even, 1e-5);
    vec2 sides = exponent + 8.0;
    return pow(even, mix(exponent.y, exponent.x, min(part, 1.0))) * sqrt(sides.x * sides.y) * 0.125;
}

#if LAMPS > 0
// What the lamps add: on the side that is seen, from the other side, and mirrored.
struct Lamplight {
    vec3 direct, behind, mirrored;
};

void addLamp(int lamp, vec3 place, vec3 normal, vec3 smoothNormal, vec3 toEye, vec3 fibres, float pixel, float woven,
             vec2 exponent, inout Lamplight sum) {
    vec3 way = lamps[lamp].way.xyz;
    float side = dot(smoothNormal, way);
    float reached = lamplight(lamp, place, side < 0.0 ? -smoothNormal : smoothNormal, pixel, true);
    float direct = max(dot(normal, way), 0.0) * reached * max(smoothstep(-0.02, 0.12, side), 1.0 - woven);
    vec3 colour = lamps[lamp].colour.rgb;
    sum.direct += colour * direct;
    sum.behind += colour * (max(-side, 0.0) * reached);
    float gloss = glossOf(normal, fibres, normalize(way + toEye), exponent);
    sum.mirrored += colour * (gloss * direct);
}
#endif

// `normal` is that of the threads, `smoothNormal` of the surface, both on the side that is seen; `pixel` the size of a
// pixel there [m], `fibres` a unit vector in the surface where there is anisotropy. `pattern`: colour of the front,
// openness 0 … 1; `back`: colour of the back, roughness; `kind`: sheen, dulled less greyed, translucency, woven;
// `strands`: anisotropy, fuzz.
vec3 lit(vec3 place, vec3 toEye, vec3 smoothNormal, vec3 normal, vec3 fibres, float pixel, bool isBack, vec4 pattern,
         vec4 back, vec4 kind, vec2 strands) {
    float open = pattern.a, roughness = back.a;
    float facingEye = clamp(dot(normal, toEye), 0.0, 1.0);
    // Between fibres that stand up it is dark: the less so the more they are seen from the side.
    vec3 albedo = albedoOf(isBack, pattern.rgb, back.rgb, kind.y) * (1.0 - 0.6 * strands.y * facingEye * facingEye);
    vec3 through = isBack ? pattern.rgb : back.rgb;

    float lightSide = dot(smoothNormal, lightWay.xyz);
    float sun = sunlight(place, lightSide < 0.0 ? -smoothNormal : smoothNormal, pixel, true);
    float facing = dot(normal, lightWay.xyz);
    float direct = max(facing, 0.0) * sun;
    direct *= max(smoothstep(-0.02, 0.12, lightSide), 1.0 - kind.w);  // threads on the far side stay dark

    float alpha = mix(0.04, 1.0, roughness * roughness);
    vec2 exponent = vec2(2.0 / (alpha * alpha));

    // Threads that lie side by side, as in satin, are round: they spread the gloss across them. What goes through them
    // takes their colour (Sadeghi and others 2013).
    vec3 glossColour = vec3(0.04);
    if (strands.x > 0.0) {
        float across = 1.0 - strands.x;
        exponent.y = max(exponent.y * across * across * across, 1.0);
        glossColour += 0.5 * strands.x * albedo;
    }

    vec3 diffuse = lightColour.rgb * direct + lightOn(normal) * open;
#if LAMPS > 0
    Lamplight fromLamps = Lamplight(vec3(0.0), vec3(0.0), vec3(0.0));
    addLamp(0, place, normal, smoothNormal, toEye, fibres, pixel, kind.w, exponent, fromLamps);
#if LAMPS > 1
    addLamp(1, place, normal, smoothNormal, toEye, fibres, pixel, kind.w, exponent, fromLamps);
#endif
    diffuse += fromLamps.direct;
#endif
    vec3 light = albedo * open * diffuse;
    vec3 shining = sqrt(albedo * through);  // of the light that has come through both sides
    light += kind.z * shining * lightColour.rgb * (max(-lightSide, 0.0) * sun);

    // Gloss of a dielectric, and the bright rim of fibres.
    vec3 halfWay = normalize(lightWay.xyz + toEye);
    float rim = 1.0 - facingEye;
    float rim2 = rim * rim;
    float gloss = glossOf(normal, fibres, halfWay, exponent);
    float fresnel = 0.04 + 0.96 * rim2 * rim2 * rim;
    light += lightColour.rgb * (glossColour * gloss * direct * open);
#if LAMPS > 0
    light += kind.z * shining * fromLamps.behind + glossColour * open * fromLamps.mirrored;
#endif
    vec3 mirrored = reflect(-toEye, normal);
    light += lightFrom(mirrored, 2.0 * roughness * roughness) * (fresnel * (1.0 - roughness) * 0.6 * open);
    light += kind.x * rim2 * mix(rim, 1.0, strands.y) * mix(albedo, vec3(0.5), 0.3) * (diffuse + 0.3 * skyLight.rgb);
    return light;
}
