// What checks of the site have in common.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { SITE } from './program.mjs';

/** Every file of a folder, as a path from there with `/`. */
export function names(root = SITE) {
  const all = fs.readdirSync(root, { recursive: true }).map((name) => name.replaceAll(path.sep, '/'));
  return all.filter((name) => fs.statSync(path.join(root, name)).isFile()).sort();
}

export const pages = (root) => names(root).filter((name) => name.endsWith('.html'));

/**
 * The pages that are opened. By day every tenth of those that show files of the repository, which one template makes, is among them;
 * by night, where `RASTERPROOF_ALL` is set, all are.
 */
export const opened = () =>
  pages().filter((page, i) => 'RASTERPROOF_ALL' in process.env || !page.startsWith('files/') || i % 10 === 0);

export const inSite = (name) => path.join(SITE, name);

/** The tags of a page, without what a script holds. */
export const tags = (page) => [...page.replace(/(<script[^>]*>)[^]*?<\/script>/g, '$1').matchAll(/<([^>]*)>/g)].map(([, tag]) => tag);

export const attribute = (tag, name) => tag.match(new RegExp(`\\s${name}="([^"]*)"`))?.[1];

/** Where a link of a page leads, as a path from the root of the site. */
function targetOf(page, name) {
  const parts = name === '' ? page.split('/') : page.split('/').slice(0, -1);
  for (const part of name.split('/').filter((part) => part !== '')) {
    if (part !== '..') parts.push(part);
    else if (parts.pop() === undefined) parts.push('outside');
  }
  return parts.join('/');
}

/** How many links a site has, which of them lead nowhere, and whatever a page would load from elsewhere. */
export function brokenLinks(root) {
  const all = new Set(names(root)), anchors = new Set(), links = [];
  for (const page of all) {
    // The table of contents is written by a script, beside the pages.
    const isContents = page.includes('/toc-') && page.endsWith('.js');
    if (!page.endsWith('.html') && !isContents) continue;
    for (const tag of tags(fs.readFileSync(path.join(root, page), 'utf8'))) {
      if (isContents && !tag.startsWith('a ')) continue;
      const id = attribute(tag, 'id');
      if (id !== undefined && !isContents) anchors.add(`${page}#${id}`);
      const values = (isContents ? ['href'] : ['href', 'src']).map((name) => attribute(tag, name));
      links.push(...values.filter((link) => link !== undefined).map((link) => ({ page, tag, link })));
    }
  }
  const broken = [];
  for (const { page, tag, link } of links.filter(({ link }) => !link.startsWith('data:'))) {
    if (link.includes(':') || link.startsWith('//')) {
      if (!tag.startsWith('a ')) broken.push(`${page} loads ${link}`);
      continue;
    }
    const [, name, anchor] = link.match(/^([^#]*)#?(.*)$/), target = targetOf(page, name);
    // What follows # in the address of a page that the program wrote is a state.
    const isAnchor = anchor !== '' && !target.startsWith('try/');
    if (!all.has(target) || (isAnchor && !anchors.has(`${target}#${anchor}`))) broken.push(`${page}: ${link}`);
  }
  return { count: links.length, broken };
}

/** Fails with all of them, a line each. */
export const none = (wrong) => assert(wrong.length === 0, `${wrong.length} are wrong:\n${wrong.join('\n')}`);
