import assert from 'node:assert/strict';

import { SITE } from '../driver/program.mjs';
import { brokenLinks, none } from '../driver/site.mjs';

export default {
  says: 'Every link and anchor of the site leads somewhere, and nothing comes from elsewhere',
  page: 'nothing',
  async check() {
    const { count, broken } = brokenLinks(SITE);
    console.log(`${count} links, ${broken.length} broken`);
    assert(count > 5_000, `${count} links`);
    none(broken);
  },
};
