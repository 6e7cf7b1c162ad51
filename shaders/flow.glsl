// Motion over the picture as three numbers of 16 bits: right, down, and 1 where it is known.
uniform vec2 size;  // [px] of the picture

// `next`: clip coordinates of the same place in the next picture.
vec4 motion(vec4 next) {
    vec2 way = (0.5 + 0.5 * next.xy / next.w) * size - gl_FragCoord.xy;
    bool isKnown = next.w > 0.0 && max(abs(way.x), abs(way.y)) < 511.0;
    return vec4(isKnown ? vec3(32768.0 + 64.0 * vec2(way.x, -way.y), 1.0) / 65535.0 : vec3(0.0), 1.0);
}
