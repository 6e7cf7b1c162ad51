// Least and largest depth of one block of the shadow map.
uniform sampler2D shadowBounds;
out vec4 bounds;

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * BLOCK;
    float least = 1.0;
    float largest = 0.0;
    for (int y = 0; y < BLOCK; ++y) {
        for (int x = 0; x < BLOCK; ++x) {
            float depth = texelFetch(shadowBounds, first + ivec2(x, y), 0).r;
            least = min(least, depth);
            largest = max(largest, depth);
        }
    }
    bounds = vec4(least, largest, 0.0, 0.0);
}
