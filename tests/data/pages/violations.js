axe.violations = async () => {
    for (const block of document.querySelectorAll('pre code')) {
        const seen = new Set();
        for (const word of block.querySelectorAll('span')) {
            const look = `${word.className} in ${word.parentElement.className}`;
            if (seen.has(look)) word.replaceWith(...word.childNodes);
            seen.add(look);
        }
        block.normalize();
    }
    const { violations } = await axe.run(document, { resultTypes: ['violations'], preload: false });
    return violations.flatMap(({ id, nodes }) => nodes.map(({ target, any, all, none }) =>
        `${id}: ${target.join(' ')}: ${[...any, ...all, ...none].map(({ message }) => message).join('; ')}`));
};
