// The switch of languages stays at the heading that is read, and what mdBook itself says is in the language of the book. The keyboard reaches
// the contents, and whatever scrolls.
'use strict';

const ZH = {
  'Skip to the text': '跳到正文',
  'Toggle Table of Contents': '打开或收起目录',
  'Table of contents': '目录',
  'Change theme': '换主题',
  'Themes': '主题',
  'Search (`/`)': '搜索（`/`）',
  'Toggle Searchbar': '打开或收起搜索栏',
  'Search this book ...': '搜索本书……',
  'Page navigation': '翻页',
  'Previous chapter': '上一章',
  'Next chapter': '下一章',
  'Copy to clipboard': '复制',
  'Keyboard shortcuts': '快捷键',
  'Code': '代码',
  'Table': '表格',
  'Formula': '公式',
  'Auto': '自动',
  'Light': '浅色',
  'Rust': '铁锈',
  'Coal': '深色',
  'Navy': '深蓝',
  'Ayu': '墨绿',
};

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

const isChinese = document.documentElement.lang.startsWith('zh');

// What is wider than its place scrolls inside itself. The keyboard stops there, and nowhere else.
const SCROLLING = { 'pre > code': 'Code', '.table-wrapper': 'Table', '.katex-display': 'Formula' };
const watcher = new ResizeObserver((entries) => {
  for (const { target } of entries) {
    const doesScroll = target.scrollWidth > target.clientWidth;
    const name = SCROLLING[Object.keys(SCROLLING).find((selector) => target.matches(selector))];
    const attributes = { tabindex: '0', role: 'group', 'aria-label': isChinese ? ZH[name] : name };
    for (const [attribute, value] of Object.entries(attributes)) {
      if (doesScroll) target.setAttribute(attribute, value);
      else target.removeAttribute(attribute);
    }
  }
});
for (const element of document.querySelectorAll(Object.keys(SCROLLING).join())) watcher.observe(element);

if (isChinese) {
  for (const name of ['title', 'aria-label', 'placeholder']) {
    for (const element of document.querySelectorAll(`[${name}]`)) {
      const text = ZH[element.getAttribute(name)];
      if (text) element.setAttribute(name, text);
    }
  }
  for (const element of document.querySelectorAll('.theme, .mdbook-help-title, .to-the-text')) {
    element.textContent = ZH[element.textContent] ?? element.textContent;
  }
}
