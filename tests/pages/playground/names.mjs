import assert from 'node:assert/strict';

import { SCENES, show } from '../driver/playground.mjs';

// A number that is said where the scene is shown.
const SAID = { line: '10, 6', weights: 'A 2850816 0.3625', depth: '2 0.4875', culling: '2 -4718592' };

export default {
  says: 'Whatever takes the focus has a role, a name and a value, as a screen reader is told, and what changes is said',
  page: 'playground',
  async check(tab) {
    await tab.call('Accessibility.enable');
    const heard = new Set();
    for (const [scene, lang] of SCENES.flatMap((scene) => [[scene, 'en'], [scene, 'zh']])) {
      await show(tab, `#scene=${scene}&lang=${lang}`);
      for (const role of await tab.namesEveryControl(`${scene}, ${lang}`)) heard.add(role);
      // What is dragged, what each panel makes of it, why.
      const said = await tab.text('#announce');
      const panels = await tab.value('view.shown.map(p => p.canvas.getAttribute("aria-label"))');
      for (const part of [...panels, SAID[scene] ?? '']) assert(said.includes(part), `${scene}: ${part} in ${said}`);
    }
    for (const role of ['application', 'button', 'checkbox', 'combobox', 'link', 'slider', 'spinbutton']) {
      assert(heard.has(role), `${role} in ${[...heard]}`);
    }
  },
};
