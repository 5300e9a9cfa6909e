// The grips of a live figure for the viewer: where each lies on the picture, and what moving it does: it calls `move(i, value)`.
const figureGrips = (grips, move) => grips.map(({ name, value, spot, scale, step, low, high }, i) => {
  const isFree = scale.every(Boolean);
  const axis = scale[0] ? 0 : 1;
  return {
    name, says: `${name}: ${isFree ? value.join(', ') : value[axis]}`, x: spot[0], y: spot[1], isPainted: true, view: 'sheet',
    low: low[axis], high: high[axis], now: value[axis],
    place: (...place) => move(i, value.map((old, k) => (scale[k] ? old + (place[k] - spot[k]) / scale[k] : old))),
    // What moves one way only is moved by both pairs of arrows: up and right are one way.
    nudge: (right, down) => {
      const [sx, sy] = scale.map(Math.sign);
      const way = isFree ? [right * sx, down * sy] : [(right - down) * sx, (down - right) * sy];
      move(i, value.map((old, k) => old + way[k] * step));
    },
  };
});
