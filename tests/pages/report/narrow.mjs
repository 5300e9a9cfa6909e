import { VERDICT } from '../driver/report.mjs';

export default {
  says: 'No case makes the page wider than the window of a desktop or of a phone',
  page: VERDICT,
  async check(tab) {
    for (const width of [1280, 400]) {
      await tab.resize(width, 800);
      for (const place of ['#case-O1&mode=side', '#case-S1', '#case-L7&mode=blink&px=5,5']) {
        await tab.open(place);
        await tab.fitsTheWidth();
      }
    }
  },
};
