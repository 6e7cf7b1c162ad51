// For each sample: which surface covers it (x), and the depth that this surface has in the pixel's middle (yzw).
uniform float mark;
out vec4 covering;

void main() {
    vec3 digits = fract(gl_FragCoord.z * vec3(1.0, 255.0, 65025.0));
    covering = vec4(mark, digits - digits.yzz * vec3(1.0 / 255.0, 1.0 / 255.0, 0.0));
}
