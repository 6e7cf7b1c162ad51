// The least of both is kept: the lowest and the highest surface.
in float height;
out vec4 least;

void main() { least = vec4(max(height, 0.0), -height, 0.0, 0.0); }
