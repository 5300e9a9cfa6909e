    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double nearest = 1e300;
            int seen = -1;
            for (int t = 0; t < count; t++) {
                const rasterproof_point *p = triangles[t];
                double e[3], area = 0, z = 0;
                bool inside = true;
                for (int i = 0; i < 3; i++) {
                    const rasterproof_point a = p[i], b = p[(i + 1) % 3];
                    e[i] = (b.x - a.x) * (y + 0.5 - a.y) - (b.y - a.y) * (x + 0.5 - a.x);
                    area += e[i];
                    z += e[i] * p[(i + 2) % 3].z;
                }
                for (int i = 0; i < 3; i++) {
                    const rasterproof_point a = area > 0 ? p[i] : p[(i + 1) % 3], b = area > 0 ? p[(i + 1) % 3] : p[i];
                    const bool owns = b.y < a.y || (b.y == a.y && b.x > a.x);
                    inside = inside && (e[i] * area > 0 || (e[i] == 0 && owns));
                }
                if (area != 0 && inside && z / area < nearest) nearest = z / area, seen = t;
            }
            if (seen >= 0) set_pixel(x, y, seen);
        }
