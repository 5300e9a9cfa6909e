// Whether the words of a drawing lie over one another.

/**
 * For the page: the pairs of texts that overlap in each drawing, an SVG given as text, at its own size. What surrounds a letter is more than
 * its ink, so boxes may touch by a quarter of a line. Where it is asked for, the second word is moved onto the first one before: that has to be found.
 */
export const overlapping = (drawings, isSpoilt = false) => drawings.map((drawing) => {
  const place = document.body.appendChild(document.createElement('div'));
  place.innerHTML = drawing.slice(drawing.indexOf('<svg'));
  const svg = place.querySelector('svg');
  for (const [side, value] of Object.entries({ width: svg.viewBox.baseVal?.width, height: svg.viewBox.baseVal?.height })) if (value) svg.setAttribute(side, value);
  const texts = [...place.querySelectorAll('text')].filter((text) => text.textContent.trim() && text.checkVisibility());
  if (isSpoilt && texts.length > 1) {
    const [to, from] = texts.map((text) => text.getBoundingClientRect());
    const before = texts[1].getAttribute('transform') ?? '';
    texts[1].setAttribute('transform', `translate(${to.left - from.left} ${to.top - from.top}) ${before}`);
  }
  const boxes = texts.map((text) => [text.textContent.trim(), text.getBoundingClientRect()]);
  const found = [];
  boxes.forEach(([a, p], i) => boxes.slice(i + 1).forEach(([b, q]) => {
    const wide = Math.min(p.right, q.right) - Math.max(p.left, q.left), high = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
    if (wide > 1 && high > 0.25 * Math.min(p.height, q.height)) found.push(`${a} / ${b}`);
  }));
  place.remove();
  return { count: boxes.length, found };
});
