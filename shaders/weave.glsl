// Threads: how they tilt the surface, with WEAVE, and which way they run, with FIBRES.
uniform float weave;
uniform float thread;  // [m]
in vec3 place;

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
// The way of the warp, unit. On a triangle v stays along it; with the normal it turns from that of the triangle to that
// of the surface.
vec3 warpOn(vec2 uv, vec3 normal) {
    vec3 placeX = dFdx(place);
    vec3 placeY = dFdy(place);
    vec3 warp = placeX * dFdy(uv).y - placeY * dFdx(uv).y;
    warp *= inversesqrt(max(dot(warp, warp), 1e-20));
    vec3 flatNormal = cross(placeX, placeY);
    flatNormal *= inversesqrt(max(dot(flatNormal, flatNormal), 1e-30));
    flatNormal = dot(flatNormal, normal) < 0.0 ? -flatNormal : flatNormal;
    return warp - (flatNormal + normal) * (dot(normal, warp) / (1.0 + dot(flatNormal, normal)));
}
#endif
