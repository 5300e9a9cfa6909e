import assert from 'node:assert/strict';

export default {
  says: 'The first screen of the site has two sentences, a picture that is dragged, and three ways in; that of a phone has the first two',
  page: 'site en/index.html',
  async check(tab) {
    for (const [width, height, isWide] of [[1280, 900, true], [360, 740, false]]) {
      await tab.resize(width, height);
      await tab.go(tab.file);
      await tab.when('document.querySelector("rp-figure").exports !== undefined');
      const { sentences, ways, picture, list } = await tab.value(() => ({
        sentences: document.querySelector('#text > p').textContent.match(/\.(\s|$)/g).length,
        ways: document.querySelectorAll('#text > ul:first-of-type > li').length,
        picture: document.querySelector('rp-figure').shadowRoot.querySelector('.stage svg').getBoundingClientRect().bottom,
        list: document.querySelector('#text > ul').getBoundingClientRect().bottom,
      }));
      assert.deepEqual([sentences, ways], [2, 3]);
      assert.doesNotMatch(await tab.value('document.title'), /chapters/i);
      assert(picture <= height, `${width}: the picture ends at ${picture} px`);
      assert(!isWide || list <= height, `the ways in end at ${list} px`);
    }
  },
};
