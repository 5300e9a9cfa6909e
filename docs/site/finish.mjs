// What mdBook does not do: formulas, code and the first view of live figures are rendered here instead of in the reader's
// browser, links to files of the repository lead to pages that show them, both books lead to each other heading by heading,
// lessons are found before what is to be looked up, and the Chinese book can be searched.
//
// node finish.mjs SITE STAGE TOOLS: the folder with both books, the Markdown they were made of, and node_modules.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import vm from 'node:vm';

const [site, stage, tools] = process.argv.slice(2);
const require = createRequire(path.join(tools, 'node_modules/'));
const katex = require('katex');
const hljs = require('highlight.js/lib/common');

const read = (file) => fs.readFileSync(file, 'utf8');
const write = (file, text) => {
  fs.mkdirSync(path.dirname(file), { recursive: true });
  fs.writeFileSync(file, text);
};
const escaped = (text) => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;').replace(/"/g, '&quot;');
const plain = (html) => html.replace(/&lt;/g, '<').replace(/&gt;/g, '>').replace(/&quot;/g, '"').replace(/&#39;|&#x27;/g, "'").replace(/&amp;/g, '&');
const isFolder = (file) => fs.statSync(file, { throwIfNoEntry: false })?.isDirectory();
const kept = execFileSync('git', ['ls-files', '-z'], { encoding: 'utf8', maxBuffer: 1 << 28 }).split('\0').filter(Boolean);
const isKept = new Set(kept);
const wrong = [];

/** Replaces what must be there exactly once. */
function once(text, old, right) {
  if (text.split(old).length !== 2) throw new Error(`not there exactly once: ${old}`);
  return text.replace(old, () => right);
}

/** Changes a file that is there. */
const edit = (file, change) => write(file, change(read(file)));

/** A page that mdBook does not make. */
const bare = (title, body, more = '') => `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>${escaped(title)}</title>
<link rel="icon" href="data:,">
${more}</head>
<body>
${body}</body>
</html>
`;

// Files of the repository that pages show or lead to: pictures as they are, texts as pages.
const shown = new Set();
const SHOWN_AS_IT_IS = /\.(png|svg|gif|gz)$/;

/** The place of a file of the repository in the site. */
function placeOf(file) {
  shown.add(file);
  if (isFolder(file)) {
    for (const inside of kept) if (inside.startsWith(`${file}/`)) shown.add(inside);
    return `files/${file}/index.html`;
  }
  return SHOWN_AS_IT_IS.test(file) ? `files/${file}` : `files/${file}.html`;
}

const HIGHLIGHTED = { rs: 'rust', py: 'python', js: 'javascript', java: 'java', c: 'c', h: 'c', cpp: 'cpp', go: 'go', json: 'json', toml: 'ini' };

function highlighted(text, language) {
  return hljs.getLanguage(language) ? hljs.highlight(text, { language }).value : escaped(text);
}

/** A page that shows a text of the repository, or lists a folder. */
function filePage(file) {
  const place = isFolder(file) ? `files/${file}/index.html` : `files/${file}.html`;
  const root = path.posix.relative(path.posix.dirname(place), '.');
  let body;
  if (isFolder(file)) {
    const inside = kept.filter((name) => name.startsWith(`${file}/`));
    const link = (name) => `<li><a href="${path.posix.relative(path.posix.dirname(place), placeOf(name))}">${escaped(name.slice(file.length + 1))}</a></li>`;
    body = `<ul>\n${inside.map(link).join('\n')}\n</ul>`;
  } else {
    const language = HIGHLIGHTED[path.extname(file).slice(1)] ?? (read(file).startsWith('#!/usr/bin/env bash') ? 'bash' : '');
    body = `<pre><code class="hljs" tabindex="0" role="group" aria-label="${escaped(file)}">${highlighted(read(file), language)}</code></pre>`;
  }
  const sheet = (pattern, scheme) => `<link rel="stylesheet" href="${root}/en/${path.basename(asset('en', pattern))}" media="(prefers-color-scheme: ${scheme})">`;
  const nav = `<nav><a href="${root}/en/index.html">rasterproof</a> · <a href="${root}/zh/index.html" lang="zh-CN">中文</a></nav>`;
  write(path.join(site, place), bare(`${file} - rasterproof`, `${nav}\n<main>\n<h1>${escaped(file)}</h1>\n${body}\n</main>\n`, `${sheet(/^highlight-.*\.css$/, 'light')}
${sheet(/^tomorrow-night-.*\.css$/, 'dark')}
<style>
html { background: canvas; color: canvastext; }
body { font-family: sans-serif; margin: 1em; overflow-wrap: anywhere; }
pre { overflow-x: auto; font-size: 0.9em; }
pre code { display: block; padding: 0.5em; }
</style>
`));
}

/** The one file of a book whose name matches. */
function asset(book, pattern) {
  const found = fs.readdirSync(path.join(site, book)).filter((name) => pattern.test(name));
  if (found.length !== 1) throw new Error(`${book}: ${found.length} files match ${pattern}`);
  return path.join(site, book, found[0]);
}

/** The width and height of a picture as attributes, so that nothing moves when it arrives. */
function sizeOf(file) {
  if (file.endsWith('.png')) {
    const bytes = fs.readFileSync(file);
    return ` width="${bytes.readUInt32BE(16)}" height="${bytes.readUInt32BE(20)}"`;
  }
  const svg = read(file).match(/<svg[^>]*>/)?.[0] ?? '';
  const box = svg.match(/viewBox="[-\d.]+ [-\d.]+ ([\d.]+) ([\d.]+)"/);
  return box ? ` width="${box[1]}" height="${box[2]}"` : '';
}

/** Where a link of a page leads in the site, both as paths from the root of the repository or the site. */
function target(book, page, link) {
  const [, name, fragment] = link.match(/^([^#]*)(#.*)?$/);
  let file = path.posix.normalize(path.posix.join(path.posix.dirname(page), decodeURI(name)));
  // mdBook has made .html of .md.
  if (!fs.existsSync(file)) file = file.replace(/\.html$/, '.md');
  const anchor = plain(fragment ?? '');
  if (/^docs\/(zh\/)?playground\.md$/.test(file) && anchor.includes('=')) {
    return `try/playground.html${escaped(`${anchor}&lang=${book}`)}`;
  }
  if (/^docs\/(zh\/)?report\.md$/.test(file) && anchor.startsWith('#plant=')) {
    const plant = anchor.slice('#plant='.length);
    return `try/${plant === 'none' ? 'verify' : plant}.html`;
  }
  const [, other, inside] = file.match(/^docs\/(zh\/)?(.*)$/) ?? [];
  const chapter = inside ? [other ? 'zh' : 'en', inside] : [book, file];
  if (file.endsWith('.md') && !file.endsWith('SUMMARY.md') && fs.existsSync(path.join(stage, ...chapter))) {
    return `${chapter.join('/').replace(/\.md$/, '.html')}${fragment ?? ''}`;
  }
  if (!isKept.has(file) && !isFolder(file)) {
    wrong.push(`${page}: ${link} leads to no file that git keeps`);
    return link;
  }
  return placeOf(file) + (fragment ?? '');
}

let formulas = 0;
function formula(page, tex, displayMode) {
  formulas += 1;
  try {
    return katex.renderToString(plain(tex).trim(), { displayMode, strict: 'error', throwOnError: true });
  } catch (error) {
    wrong.push(`${page}: ${error.message}`);
    return tex;
  }
}

// Live figures ask a question first. It stands in the page, so that it is seen before the engines are loaded.
const modulePath = 'target/rasterproof/playground.wasm';
const hasEngines = fs.existsSync(modulePath);
const { instantiate, ask } = vm.runInThisContext(`${read('crates/playground/page/engines.js')}; ({ instantiate, ask })`);
if (hasEngines) instantiate(new WebAssembly.Module(fs.readFileSync(modulePath)));

/** The beginning of a live figure behind its first answer, with its pictures on a light and on a dark page: it is painted with that, however slowly the page is read. */
function withFirstAnswer(page, book, start, name, open) {
  if (!hasEngines) return start;
  const [first, { svg }] = [false, true].map((isDark) => ask({ ask: 'figure', name, language: book, at: [], is_answered: Boolean(open), is_dark: isDark }));
  if (first.error) wrong.push(`${page}: the figure ${name}: ${first.error}`);
  first.svg = [first.svg, svg];
  return `<script type="application/json">${JSON.stringify(first).replace(/</g, '\\u003c')}</script>${start}`;
}

/** The names by which links reach the headings of a text, in their order. */
const headings = (text) => [...text.matchAll(/<h[1-6] id="([^"]*)"/g)].map(([, id]) => id);

/**
 * What is above a chapter. mdBook opens and closes the contents by a label, which a keyboard does not reach and which may
 * have none of the attributes that mdBook's script sets. It stays for readers without scripts, and all others get a button.
 * The bar and the search are landmarks, the help is a dialog, and the last two have names. The first stop of the keyboard
 * leads past all that to the text.
 */
function reachable(head) {
  const [label, attributes, icon] = head.match(/<label id="mdbook-sidebar-toggle"([^>]*)>([^]*?)<\/label>/);
  const others = attributes.replace(/ (for|aria-[a-z]+)="[^"]*"/g, '');
  const button = once(head, label, `<button type="button" id="mdbook-sidebar-toggle"${attributes.replace(/ for="[^"]*"/, '')}>${icon}</button>
<noscript><label for="mdbook-sidebar-toggle-anchor"${others}>${icon}</label></noscript>`);
  const [bar, search, field] = ['<div id="mdbook-menu-bar" ', '<div id="mdbook-search-wrapper" ', '<input type="search" '];
  const help = once(button, '<div id="mdbook-help-popup">', '<div id="mdbook-help-popup" role="dialog" aria-label="Keyboard shortcuts">');
  const named = once(once(once(help, bar, `${bar}role="banner" `), search, `${search}role="search" `), field, `${field}aria-label="Search this book ..." `);
  return once(named.replace(/<body[^>]*>/, '$&\n<a class="to-the-text" href="#text">Skip to the text</a>'), '<main>', '<main id="text" tabindex="-1">');
}

// What mdBook says around a text.
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
  'Auto': '自动',
  'Light': '浅色',
  'Rust': '铁锈',
  'Coal': '深色',
  'Navy': '深蓝',
  'Ayu': '墨绿',
};

/** The same in Chinese: names of things, and texts that stand alone. */
const inChinese = (html) => html.replace(/(?<=[">])[^<>"]+(?=["<])/g, (text) => ZH[text] ?? text);

/** The code that links of a page lead to, `own/a.py#L3-L9`, as one block with an empty line between two pieces. */
function linked(page, links) {
  const pieces = [];
  let language = '';
  for (const [, name, first, last] of links.matchAll(/href="([^"#]+)#L(\d+)-L(\d+)"/g)) {
    const file = path.posix.join(path.posix.dirname(page), decodeURI(name));
    language = HIGHLIGHTED[path.extname(file).slice(1)];
    pieces.push(read(file).split('\n').slice(first - 1, last).join('\n'));
  }
  return `<pre><code class="language-${language}">${escaped(pieces.join('\n\n'))}\n</code></pre>`;
}

/**
 * Code that a page prints in Rust, with links to the same code in other languages behind it, becomes tabs: a browser opens one
 * of the folded blocks that share a name.
 */
function inTabs(page, main) {
  let count = 0;
  const printed = /(<pre><code class="language-rust(?:(?!<\/pre>)[^])*<\/pre>)\s*<!--\/code-->\s*((?:<!-- code (?:(?!-->)[^])*-->\s*<p>(?:Python|C\+\+): (?:(?!<\/p>)[^])*<\/p>\s*<!--\/code-->\s*)+)/g;
  return main.replace(printed, (_, rust, others) => {
    count += 1;
    const tabs = [...others.matchAll(/<p>(Python|C\+\+): ([^]*?)<\/p>/g)].map(([, language, links]) =>
      `<details name="code-${count}"><summary>${language}</summary>\n${linked(page, links)}\n</details>\n`);
    return `<div class="tabs">\n<details name="code-${count}" open><summary>Rust</summary>\n${rust}\n</details>\n${tabs.join('')}</div>\n`;
  });
}

/** The text of a chapter, finished; `others` are the headings of the same chapter in the other language. */
function finished(book, page, place, main, others) {
  const away = (where) => path.posix.relative(path.posix.dirname(place), where);
  let pictures = 0;
  const hasFigure = main.includes('<rp-figure');
  // A break between two lines would be seen as a space, which Chinese does not have.
  const joined = inTabs(page, main).split(/(<pre[^]*?<\/pre>)/).map((part, at) =>
    at % 2 ? part : part.replace(/(?<=[\u3000-\u9fff\uff00-\uffef])\n(?=[\u3000-\u9fff\uff00-\uffef])/g, '')).join('');
  const own = headings(main);
  const hasCounterparts = own.length === others.length;
  return joined
    .replace(/<h([1-6]) id="([^"]*)"/g, (whole, level, id) =>
      hasCounterparts ? `${whole} data-other="${others[own.indexOf(id)]}"` : whole)
    .replace(/<rp-figure scene="([^"]*)"( open="")?>/g, (start, name, open) => withFirstAnswer(page, book, start, name, open))
    .replace(/<pre><code class="language-math">([^<]*)<\/code><\/pre>/g, (_, tex) => formula(page, tex, true))
    .replace(/\$<code>([^<]*)<\/code>\$/g, (_, tex) => formula(page, tex, false))
    .replace(/<code class="language-(\w+)([^"]*)">([^<]*)<\/code>/g, (whole, language, others, code) =>
      hljs.getLanguage(language) ? `<code class="language-${language}${others}">${highlighted(plain(code), language)}</code>` : whole)
    .replace(/(<a href=")([^"]+)"/g, (whole, start, link) =>
      /^(#|[a-z]+:)/.test(link) ? whole : `${start}${away(target(book, page, link))}"`)
    .replace(/(<a [^>]*>)?<img src="([^":]+)"/g, (whole, around, link) => {
      const file = path.posix.normalize(path.posix.join(path.posix.dirname(page), decodeURI(link)));
      if (!isKept.has(file)) {
        wrong.push(`${page}: the picture ${link} is not kept by git`);
        return whole;
      }
      pictures += 1;
      return `${around ?? ''}<img src="${away(placeOf(file))}"${sizeOf(file)}${pictures > 1 || hasFigure ? ' loading="lazy"' : ''}`;
    })
    // Code has its look from the beginning: mdBook's script would give it the class later, and all below would move.
    .replace(/<a class="header"[^]*?<\/a>|<code(?: class="([^"]*)")?>/g, (whole, others = '') => (
      whole.startsWith('<a') ? whole : `<code class="${`${others} hljs`.trim()}">`));
}

// The style of formulas, with the one kind of fonts that every browser of the last ten years loads.
const dist = path.join(tools, 'node_modules/katex/dist');
write(path.join(site, 'katex/katex.css'), read(path.join(dist, 'katex.min.css')).replace(/,url\([^)]*\.(woff|ttf)\) format\("[a-z]+"\)/g, ''));
for (const font of fs.readdirSync(path.join(dist, 'fonts')).filter((name) => name.endsWith('.woff2'))) {
  fs.mkdirSync(path.join(site, 'katex/fonts'), { recursive: true });
  fs.copyFileSync(path.join(dist, 'fonts', font), path.join(site, 'katex/fonts', font));
}

// What only the contents need comes behind the text, which is seen that much earlier: their script is as large as the style sheets.
function withoutContents(head) {
  const parts = [/ *<script src="[./]*toc-[^"]*"><\/script>\n/, / *<!-- Apply ARIA attributes[^]*?<\/script>\n/].map((pattern) => head.match(pattern)[0]);
  return [parts.reduce((rest, part) => once(rest, part, ''), head), parts.join('')];
}

const TEXT_IS_READ = "<script>document.documentElement.classList.add('is-read'); document.dispatchEvent(new Event('text-is-read'));</script>";

// What is above the text of each chapter, the text, and what is below, by the place of the chapter in the site.
const parts = {};
const chaptersOf = {};
for (const book of ['en', 'zh']) {
  chaptersOf[book] = fs.readdirSync(path.join(stage, book), { recursive: true }).filter((name) => name.endsWith('.md') && name !== 'SUMMARY.md');
  for (const chapter of chaptersOf[book]) {
    const place = `${book}/${chapter.replace(/\.md$/, '.html')}`;
    if (fs.existsSync(path.join(site, place))) parts[place] = read(path.join(site, place)).split(/(?<=<main>)|(?=<\/main>)/);
    else wrong.push(`${chapter} is missing in the SUMMARY.md of the book ${book}`);
  }
}
for (const book of ['en', 'zh']) {
  for (const chapter of chaptersOf[book]) {
    const place = `${book}/${chapter.replace(/\.md$/, '.html')}`;
    if (!parts[place]) continue;
    const docs = book === 'en' ? 'docs' : 'docs/zh';
    const page = fs.existsSync(path.join(docs, chapter)) ? `${docs}/${chapter}` : chapter;
    const before = formulas;
    const [head, main, foot] = parts[place];
    const [, otherMain] = parts[place.replace(/^../, book === 'en' ? 'zh' : 'en')] ?? ['', ''];
    const text = finished(book, page, place, main, headings(otherMain));
    const away = (where) => path.posix.relative(path.posix.dirname(place), where);
    // The style of formulas stands before the first one: what is above it is painted without.
    const styled = formulas > before ? text.replace('<span class="katex', `<link rel="stylesheet" fetchpriority="low" href="${away('katex/katex.css')}">$&`) : text;
    // Before the text is read, so that no figure is shown first as its still picture.
    const more = text.includes('<rp-figure') ? `<script src="${away('try/figure.js')}"></script>\n` : '';
    // What stands below the text, search and copying, leaves the line to what the first view needs.
    const [above, contents] = withoutContents(reachable(head));
    const below = once(foot, '</main>', `</main>\n${contents}${TEXT_IS_READ}`).replaceAll('<script src="', '<script fetchpriority="low" src="');
    const translated = book === 'zh' ? inChinese : (html) => html;
    write(path.join(site, place), translated(above.replace('</head>', `${more}</head>`)) + styled + translated(below));
  }
  // The headings of a page come into the contents when the text is there, before these are shown, and not after the last script.
  edit(asset(book, /^toc-.*\.js$/), (text) => text.replaceAll("addEventListener('DOMContentLoaded'", "addEventListener('text-is-read'"));
  // Two colours of code lack contrast in the dark: the first has 4.45 of 4.5, the second 2.9.
  edit(asset(book, /^tomorrow-night-.*\.css$/), (text) => once(text, '#cc6666', '#d77c7c'));
  edit(asset(book, /^ayu-highlight-.*\.css$/), (text) => once(text, '#5c6773', '#84909c'));
}
// The contents alone, for readers without scripts, are a page like others.
for (const [book, title] of [['en', 'Table of contents'], ['zh', '目录']]) {
  const [start, end] = ['<body class="sidebar-iframe-inner">', '</body>'];
  edit(path.join(site, book, 'toc.html'), (text) => {
    const titled = once(text, '</head>', `<title>${title} - rasterproof</title>\n</head>`);
    return once(once(titled, start, `${start}\n<main>\n<h1>${title}</h1>`), end, `</main>\n${end}`);
  });
}
for (const file of shown) {
  if (SHOWN_AS_IT_IS.test(file)) {
    fs.mkdirSync(path.join(site, 'files', path.dirname(file)), { recursive: true });
    fs.copyFileSync(file, path.join(site, 'files', file));
  } else filePage(file);
}

// What is found in a lesson comes before what is found in a page to look up, by the parts of the summary; the changelog comes last.
const WEIGHTS = [4, 7, 1.5, 1.2, 1, 0.5, 0.5, 0.1];
for (const book of ['en', 'zh']) {
  const [summary, ...inParts] = read(path.join(stage, book, 'SUMMARY.md')).split(/^# /m).slice(1);
  const weights = {};
  [summary, ...inParts].forEach((part, at) => {
    for (const [, page] of part.matchAll(/\]\(([^)]*)\.md\)/g)) weights[`${page}.html`] = WEIGHTS[at] ?? WEIGHTS.at(-1);
  });
  if (inParts.length + 1 !== WEIGHTS.length) wrong.push(`the SUMMARY.md of the book ${book} has ${inParts.length} parts; WEIGHTS needs one more number than that`);
  const search = 'const results = searchindex.search(searchterm, search_options);';
  edit(asset(book, /^searcher-.*\.js$/), (text) => once(text, search, `${search}
        const weights = ${JSON.stringify(weights)};
        for (const result of results) result.score *= weights[doc_urls[result.ref].split('#')[0]] ?? 1;
        const isLast = ({ ref }) => doc_urls[ref].startsWith('CHANGELOG.');
        results.sort((a, b) => isLast(a) - isLast(b) || b.score - a.score);`));
}

edit(asset('zh', /^book-.*\.js$/), (text) => text.replaceAll('Copy to clipboard', '复制'));

// mdBook splits texts at spaces, which Chinese does not have. Here a word of the Chinese index is two characters that stand
// side by side. The same function splits what a reader types, and is therefore in the script that the book loads.
const elasticlunrFile = asset('zh', /^elasticlunr-.*\.js$/);
edit(elasticlunrFile, (text) => `${text}
elasticlunr.tokenizer = (text) => (String(text ?? '').toLowerCase().match(/\\p{Script=Han}+|[^\\P{L}\\p{Script=Han}]+|\\p{N}+/gu) ?? []).flatMap((word) => {
  const signs = [...word];
  if (!/\\p{Script=Han}/u.test(word) || signs.length === 1) return [word];
  return signs.slice(1).map((sign, at) => signs[at] + sign);
});
`);
const indexFile = asset('zh', /^searchindex-.*\.js$/);
const world = vm.createContext({ window: { search: {} } });
vm.runInContext(read(elasticlunrFile), world);
vm.runInContext(read(indexFile), world);
vm.runInContext(`
  const { search } = window;
  const index = elasticlunr(function () {
    for (const field of search.index.fields) this.addField(field);
    this.setRef(search.index.ref);
    this.pipeline.reset();
    this.pipeline.add(elasticlunr.stopWordFilter, elasticlunr.stemmer);
  });
  for (const doc of Object.values(search.index.documentStore.docs)) index.addDoc(doc);
  search.index = index.toJSON();
`, world);
write(indexFile, `window.search = Object.assign(window.search, ${JSON.stringify(world.window.search)});\n`);
const instead = (text, head, body) => once(text, `function ${head} {`, `function ${head} {\n${body}\n`);
edit(asset('zh', /^searcher-.*\.js$/), (text) => instead(instead(text, 'makeTeaser(body, searchterms)', `
        const at = body.toLowerCase().indexOf(searchterms[0].toLowerCase());
        if (at < 0) return body.slice(0, 90);
        const end = at + searchterms[0].length;
        return body.slice(Math.max(0, at - 30), at) + '<em>' + body.slice(at, end) + '</em>' + body.slice(end, end + 60);
`), 'formatSearchMetric(count, searchterm)', "return '“' + searchterm + '”：' + count + ' 处';"));

// One compiled module for the whole site, in a script, since a page on disk may load nothing else: the pages in `try` load it
// at once, live figures when the first is seen.
for (const name of ['playground', 'your-gpu']) {
  const file = path.join(site, `try/${name}.html`);
  if (fs.existsSync(file)) {
    const page = read(file);
    const [whole] = page.match(/<script type="text\/plain" id="module">[^<]*<\/script>/);
    write(file, once(once(page, "script-src 'unsafe-inline'", "script-src 'self' file: 'unsafe-inline'"), whole, `<script type="text/plain" id="module"></script>
<script>function rasterproofEngines(text) { document.getElementById('module').textContent = text; }</script>
<script src="engines.js"></script>`));
  } else {
    write(file, bare(`rasterproof: ${name}`, `<header></header>
<main>
<h1>rasterproof: ${name}</h1>
<p>This site was built where the engines could not be compiled for the browser: <code>crates/playground/build</code> says why.</p>
</main>
`));
  }
}
// From what the program wrote, the reader gets back to the book.
for (const name of fs.readdirSync(path.join(site, 'try')).filter((name) => name.endsWith('.html'))) {
  edit(path.join(site, 'try', name), (text) => once(text, '<header>', '<header>\n<p><a href="../index.html">‹ docs · 文档</a></p>\n')
    .replaceAll('../../../docs/', '../en/').replace(/("path":"|href="\.\.\/en\/)([\w-]+)\.md/g, '$1$2.html'));
}

const books = (more = '') => `<a${more} href="en/index.html">rasterproof in English</a> · <a${more} href="zh/index.html" lang="zh-CN">rasterproof 中文</a>`;
write(path.join(site, 'index.html'), bare('rasterproof', `<main>\n<h1>rasterproof</h1>\n<p>${books()}</p>\n</main>\n`, `<script>
let language = null;
try { language = localStorage.getItem('rasterproof-language'); } catch {}
language ??= navigator.language;
location.replace((language.startsWith('zh') ? 'zh' : 'en') + '/index.html');
</script>
`));

// A server shows this page for an address that leads nowhere. It may stand below any folder, so its script looks for the
// folder of a book in the address, and offers the page whose name is most like the one that was asked for.
const pageNames = chaptersOf.en.map((chapter) => chapter.replace(/\.md$/, ''));
write(path.join(site, '404.html'), bare('No such page - rasterproof', `<main>
<h1>There is no page at this address</h1>
<p lang="zh-CN">这个地址没有网页。</p>
<p id="near" hidden>Perhaps this one: <a></a></p>
<p>${books(' class="to-book"')}</p>
</main>
<script>
const NAMES = ${JSON.stringify(pageNames)};
const [, root, book, asked] = location.pathname.match(/^(.*?[/])(?:(en|zh)[/])?([^/]*)$/) ?? [];
for (const link of document.querySelectorAll('.to-book')) link.href = root + link.getAttribute('href');
// Pairs of letters that two names share.
const pairs = (name) => new Set(Array.from(name, (_, i) => name.slice(i, i + 2)).filter((pair) => pair.length === 2));
const likeness = (a, b) => {
  const [left, right] = [pairs(a), pairs(b)];
  return [...left].filter((pair) => right.has(pair)).length / Math.max(1, left.size + right.size);
};
const name = decodeURIComponent(asked ?? '').toLowerCase().replace(/[.](html|md)$/, '');
const [best] = NAMES.map((page) => [likeness(page.toLowerCase(), name), page]).sort((a, b) => b[0] - a[0]);
if (best[0] > 0.25) {
  const near = document.getElementById('near');
  near.hidden = false;
  near.lastElementChild.textContent = best[1];
  near.lastElementChild.href = root + (book ?? 'en') + '/' + best[1] + '.html';
}
</script>
`, `<style>html { background: canvas; color: canvastext; } body { font-family: sans-serif; max-width: 40em; margin: 3em auto; padding: 0 1em; line-height: 1.5; }</style>
`));

if (wrong.length > 0) {
  console.error(wrong.join('\n'));
  process.exit(1);
}
