// The switch of languages stays at the heading that is read. The keyboard reaches the contents, and whatever scrolls.
'use strict';

const links = document.querySelector('.site-links');
document.querySelector('.right-buttons')?.append(links);
for (const link of links.querySelectorAll('[rel=alternate]')) {
  const page = links.dataset.page.replace(/\.md$/, '.html');
  link.href = link.getAttribute('href').replace(/index\.html$/, page);
  const address = link.href;
  link.addEventListener('click', () => {
    // The last heading above the upper third of the window.
    const read = [...document.querySelectorAll('main [data-other]')].filter((heading) => heading.getBoundingClientRect().top < innerHeight / 3).at(-1);
    link.href = read && read.tagName !== 'H1' ? `${address}#${read.dataset.other}` : address;
  });
}

// Pages of both languages lead back to the book that was read.
try { localStorage.setItem('rasterproof-language', document.documentElement.lang); } catch {}

// mdBook's script, which has run before, shows the contents at a click, but leaves the switch to a label.
document.getElementById('mdbook-sidebar-toggle').addEventListener('click', () => {
  document.getElementById('mdbook-sidebar-toggle-anchor').click();
});

// Escape closes the contents.
document.addEventListener('keydown', ({ key }) => {
  const contents = document.getElementById('mdbook-sidebar');
  if (key !== 'Escape' || !contents.contains(document.activeElement)) return;
  const button = document.getElementById('mdbook-sidebar-toggle');
  button.click();
  button.focus();
});

// What is wider than its place scrolls inside itself. The keyboard stops there, and nowhere else.
const SCROLLING = { 'pre > code': ['Code', '代码'], '.table-wrapper': ['Table', '表格'], '.katex-display': ['Formula', '公式'] };
const language = Number(document.documentElement.lang.startsWith('zh'));
const watcher = new ResizeObserver((entries) => {
  for (const { target } of entries) {
    const doesScroll = target.scrollWidth > target.clientWidth;
    const name = SCROLLING[Object.keys(SCROLLING).find((selector) => target.matches(selector))];
    const attributes = { tabindex: '0', role: 'group', 'aria-label': name[language] };
    for (const [attribute, value] of Object.entries(attributes)) {
      if (doesScroll) target.setAttribute(attribute, value);
      else target.removeAttribute(attribute);
    }
  }
});
for (const element of document.querySelectorAll(Object.keys(SCROLLING).join())) watcher.observe(element);
