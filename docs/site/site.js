// The switch of languages stays on the page, and what mdBook itself says is in the language of the book.
'use strict';

const ZH = {
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
}

// Pages of both languages lead back to the book that was read.
try { localStorage.setItem('rasterproof-language', document.documentElement.lang); } catch {}

if (document.documentElement.lang.startsWith('zh')) {
  for (const name of ['title', 'aria-label', 'placeholder']) {
    for (const element of document.querySelectorAll(`[${name}]`)) {
      const text = ZH[element.getAttribute(name)];
      if (text) element.setAttribute(name, text);
    }
  }
  for (const element of document.querySelectorAll('.theme, .mdbook-help-title')) {
    element.textContent = ZH[element.textContent] ?? element.textContent;
  }
}
