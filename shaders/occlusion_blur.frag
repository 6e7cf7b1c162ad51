// Joins the directions that neighbouring texels looked into.
uniform sampler2D occlusion;
out vec4 hidden;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(occlusion, 0) - 1;
    float sum = 0.0;
    float weights = 0.0;
    for (int y = -2; y <= 2; ++y) {
        for (int x = -2; x <= 2; ++x) {
            float weight = (3.0 - abs(float(x))) * (3.0 - abs(float(y)));
            sum += weight * texelFetch(occlusion, clamp(here + ivec2(x, y), ivec2(0), last), 0).r;
            weights += weight;
        }
    }
    hidden = vec4(sum / weights);
}
