# Of an OBJ file of a square sheet of square cells, point by point and row by row: strains of its edges along the
# threads in %, the mean of their sizes and the largest, and heights of the lowest and the middle point [m].
#   awk -v side=1.8 -f beside_shape.awk 0048.obj
BEGIN { n = 0 }
/^v / {
    x[n] = $2
    y[n] = $3
    z[n] = $4
    n++
}
function edge(p, q,    strain) {
    strain = sqrt((x[p] - x[q]) ^ 2 + (y[p] - y[q]) ^ 2 + (z[p] - z[q]) ^ 2) / (side / (across - 1)) - 1
    if (strain > largest) largest = strain
    sum += strain < 0 ? -strain : strain
    edges++
}
END {
    across = int(sqrt(n) + 0.5)
    if (n == 0 || across * across != n) exit 1
    lowest = y[0]
    for (p = 0; p < n; p++) {
        if (p % across < across - 1) edge(p, p + 1)
        if (p < n - across) edge(p, p + across)
        if (y[p] < lowest) lowest = y[p]
    }
    printf "%.2f %%, %.1f %% | %.2f m, %.2f m\n", 100 * sum / edges, 100 * largest, lowest, y[int(n / 2)]
}
