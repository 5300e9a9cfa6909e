new Promise(done => {
    const look = () => {
        drawFrame();
        explained = 0;
        explain(last.answer);
        const [x0, y0, x1, y1] = state.window;
        const panels = scene().panels(last.answer).filter(panel => panel.pixel).map(panel => {
            const pixels = [];
            for (let y = y0; y < y1; y += 1) for (let x = x0; x < x1; x += 1) {
                const pixel = panel.pixel((y - y0) * (x1 - x0) + x - x0, x, y);
                if (pixel) pixels.push([x, y, pixel.fill]);
            }
            return pixels;
        });
        done({
            trouble: $('trouble').textContent, panels, svg: (last.answer.panels ?? []).map(panel => panel.svg),
            weights: last.look?.triangles?.[0]?.edges?.map(edge => edge.weight) ?? [],
        });
    };
    clearTimeout(keeping);
    if (location.hash === to) look();
    else { addEventListener('hashchange', look, { once: true }); location.hash = to; }
})
