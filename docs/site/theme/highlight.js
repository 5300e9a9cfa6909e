// Code was coloured when the site was built; this is what mdBook's script calls.
window.hljs = { configure() {}, highlightBlock() {} };
