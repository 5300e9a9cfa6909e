import assert from 'node:assert/strict';

export default {
  says: 'A specimen is hunted until it is caught, then shrunk; off the lattice, too; and the engines stop on nothing that the page sends',
  page: 'playground #case=T2&lang=en',
  async check(tab) {
    await tab.settle();
    assert.equal(await tab.text('#command'), 'rasterproof inspect T2 --plant exclusive-edges');
    await tab.click('#search');
    await tab.when('document.getElementById("hunt").textContent.startsWith("caught by")');
    await tab.when('document.getElementById("hunt").textContent.includes("shrunk, ") && !hunt');
    await tab.settle();
    const isWrong = () => tab.value('last.answer.panels.some(p => p.name === "games101-strict" && p.missing > 0)');
    assert(await isWrong(), 'what is left still fails');
    assert.equal(await tab.value('state.triangles.length'), 1);
    // Off the lattice the pixel is explained as well.
    await tab.value('(document.getElementById("family").value = "f32-tie")');
    await tab.click('#search');
    await tab.when('!hunt && !state.snap');
    await tab.settle();
    assert(await isWrong(), 'off the lattice');
    assert.match(await tab.text('#look'), /decided exactly/);
    assert.match(await tab.value('ask({ ask: "named", name: "T99" }).error'), /T99/);
  },
};
