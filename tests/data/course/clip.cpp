    for (int i = 0; i < 3; i++) {
        const rasterproof_clip_corner a = corners[i], b = corners[(i + 1) % 3];
        const double from = a.z + a.w, to = b.z + b.w, t = from / (from - to);
        if (from >= 0) add_corner(a.x, a.y, a.z, a.w);
        if ((from >= 0) != (to >= 0))
            add_corner(a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t, a.w + (b.w - a.w) * t);
    }
