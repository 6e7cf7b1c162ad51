// Which part of the sky the columns around a place of the ground hide, weighted by the cosine: a column between the
// elevations a and b, seen over the angle w, hides (sin² b - sin² a) w / 2π.
uniform sampler2D occlusion;  // x: lowest surface above the ground, y: minus the highest [m]
uniform vec2 texel;           // [m]
out vec4 hidden;

float sineSquared(float height, float away) {
    float square = height * height;
    return square / (square + away * away);
}

void main() {
    const int ways = 8;
    const int rings = 8;
    ivec2 here = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(occlusion, 0) - 1;
    float size = 0.5 * (texel.x + texel.y);
    // Four texels together look into four times as many directions; the blur afterwards joins them.
    float turn = float((here.x & 1) + 2 * (here.y & 1)) / 4.0;
    float sum = 0.0;
    for (int i = 0; i < ways; ++i) {
        float angle = 6.2831853 * (float(i) + turn) / float(ways);
        vec2 way = vec2(cos(angle), sin(angle));
        vec2 covered = vec2(1.0, 0.0);  // sin² of the elevations, from and to
        float radius = 0.5;
        for (int ring = 0; ring < rings; ++ring) {
            ivec2 at = here + ivec2(round(way * radius));
            vec2 column = texelFetch(occlusion, clamp(at, ivec2(0), last), 0).xy;
            float away = radius * size;
            if (column.x < 1000.0) {
                // Nearly above, a column hides all the sky that its lower end covers.
                float from = ring == 0 ? sineSquared(column.x, away) : sineSquared(column.x, away * 1.2);
                float to = ring == 0 ? 1.0 : sineSquared(-column.y, away);
                covered = vec2(min(covered.x, from), max(covered.y, to));
            }
            radius *= 1.6;
        }
        sum += max(covered.y - covered.x, 0.0);
    }
    hidden = vec4(sum / float(ways));
}
