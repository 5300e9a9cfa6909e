(svg => [...svg.querySelectorAll('.px')].flatMap(e =>
    [...e.getAttribute('d').matchAll(/M([\d.]+) ([\d.]+)h([\d.]+)v([\d.]+)/g)].flatMap(([, ...run]) => {
        const [x, y, width, side] = run.map(Number);
        return Array.from({ length: Math.round(width / side) }, (_, i) => [x + i * side, y, side,
            ...getComputedStyle(e).fill.match(/\d+/g).map(Number)]);
    })))
