// What the specifications say: their own words, with the document that holds them, and what they ask for in ours. Sections of WebGL 2
// are those of OpenGL ES 3.0, to which it refers. Words of WebGPU are those of its editor's draft of 2024.

const POLYGONS = 'Fragment centers that lie inside of this polygon are produced by rasterization. Special treatment is given to a fragment whose center lies on a polygon edge. In such a case we require that if two polygons lie on either side of a common edge (with identical endpoints) on which a fragment center lies, then exactly one of the polygons results in the production of the fragment during rasterization.';
const CENTRES = 'All the points with coordinates C, where fract(C) = vector2(0.5, 0.5) in the framebuffer space, enclosed into the polygon, are included. If a pixel center is on the edge of the polygon, whether or not it\'s included is not defined.';
const REFERENCE = 'OpenGL ES 3.0 Reference Pages, ';
const IN_41 = 'OpenGL 4.1, 3.6.1 Basic Polygon Rasterization';
const IN_GPU = 'WebGPU, 23.2.5.4 Polygon Rasterization';
/** Quotations, word for word, and where they stand. */
const QUOTES = {
  webgl2: {
    lattice: ['an estimate of the number of bits of subpixel resolution that are used to position rasterized geometry in window coordinates. The value must be at least 4.', `${REFERENCE}glGet, GL_SUBPIXEL_BITS`],
    coverage: [POLYGONS, IN_41],
    tiling: [POLYGONS, IN_41],
    order: [POLYGONS, IN_41],
    facing: ['By default, counterclockwise polygons are taken to be front-facing.', `${REFERENCE}glFrontFace`],
    lines: ['The coordinates of a fragment produced by the algorithm may not deviate by more than one unit in either x or y window coordinates from a corresponding fragment produced by the diamond-exit rule.', 'OpenGL ES 3.0.5, 3.5.1 Basic Line Segment Rasterization'],
    depth: ['Passes if the incoming depth value is less than the stored depth value.', `${REFERENCE}glDepthFunc, GL_LESS`],
    samples: ['Multisampling samples a pixel multiple times at various implementation-dependent subpixel locations to generate antialiasing effects.', `${REFERENCE}glSampleCoverage`],
    twice: ['the resulting GL and framebuffer state must be identical whenever the command is executed on that initial GL and framebuffer state', 'OpenGL 2.1, A.1 Repeatability'],
  },
  webgpu: {
    lattice: ['Note: this becomes a subject of precision for the rasterizer.', IN_GPU],
    coverage: [CENTRES, IN_GPU],
    tiling: [CENTRES, IN_GPU],
    order: [CENTRES, IN_GPU],
    facing: ['area > 0 is considered front-facing, otherwise back-facing', `${IN_GPU}, frontFace "ccw"`],
    lines: ['The exact algorithm used for line rasterization is not defined, and may differ between implementations.', 'WebGPU, 23.2.5.2 Line Rasterization'],
    depth: ['Return true if comparing value with attachmentValue using compareFunc succeeds, and false otherwise.', 'WebGPU, 23.2.6 Fragment Processing, compare fragment'],
    values: ['The value is linearly interpolated in clip space, producing perspective-correct values.', 'WebGPU, 23.2.4 Primitive Clipping, which 23.2.5 Rasterization refers to for attributes'],
    'near-plane': ['Primitives are clipped to the clip volume, which, for any clip position p inside a primitive, is defined by the following inequalities: […] 0 ≤ p.z ≤ p.w (depth clipping)', 'WebGPU, 23.2.4 Primitive Clipping'],
    samples: ['Implementations must use the standard sample pattern for the given multisample.count when performing rasterization.', 'WebGPU, 23.2.5 Rasterization'],
  },
};
for (const quotes of Object.values(QUOTES)) quotes.reach = quotes.coverage;

const ES = 'OpenGL ES 3.0, ';
const GPU = 'WebGPU, ';
const RULES = {
  webgl2: {
    lattice: { section: `${ES}6.2 State Tables, SUBPIXEL_BITS`, says: 'Window coordinates have at least 4 bits below the pixel.', open: 'How many more, since what a device says is an estimate, and how a position between two of the lattice is rounded.' },
    coverage: { section: `${ES}3.6.1 Basic Polygon Rasterization`, says: 'A pixel whose centre lies inside is covered; one whose centre lies on an edge that two triangles share, by exactly one of them.', open: 'Which of the two polygons, and samples on an edge of one alone.' },
    tiling: { section: `${ES}3.6.1 Basic Polygon Rasterization`, says: 'Along an edge that two triangles share every pixel is covered by exactly one of them.', open: 'Which of the two polygons. Where corners are rounded to does not matter: all triangles of a corner have the same one.' },
    order: { section: `${ES}3.6.1 Basic Polygon Rasterization`, says: 'Fragment centers that lie inside are produced, whatever corner comes first.', open: 'Samples on edges.' },
    facing: { section: `${ES}3.6.1 Basic Polygon Rasterization`, says: 'The sign of the area says which side faces; culled triangles make no fragment.', open: 'Samples on edges.' },
    lines: { section: `${ES}3.5.1 Basic Line Segment Rasterization`, says: 'The diamond-exit rule, or an algorithm whose fragments deviate from it by at most one in x or y, with one fragment more or fewer, and one in each column (row).', open: 'That deviation.' },
    depth: { section: `${ES}4.1.5 Depth Test; 3.6.1`, says: 'With LESS a fragment passes if its depth is smaller than the one that is kept; depths are weighed by barycentric coordinates.', open: 'How exact depths are: the bound is derived from roundings in f32 and steps of 2^-24.' },
    values: { section: `${ES}3.6.1 Basic Polygon Rasterization`, says: 'Attributes are weighed by barycentric coordinates over w, depths by them alone.', open: 'How exactly: the bound is derived from roundings in f32, and beyond it what a step of the lattice changes is free.' },
    'near-plane': { section: `${ES}2.17 Primitive Clipping`, says: 'What lies outside of -w ≤ z ≤ w is cut off; new corners lie on the plane.', open: 'How new corners are rounded.' },
    samples: { section: `${ES}3.3 Multisampling; 3.6.3 Polygon Multisample Rasterization`, says: 'A fragment covers the samples that lie inside.', open: 'Where the samples of a pixel lie, and samples on edges.' },
    twice: { section: `${ES}A.1 Repeatability`, says: 'The same commands on the same state make the same picture.', open: 'Nothing.' },
  },
  webgpu: {
    lattice: { section: `${GPU}23.2.5.4 Polygon Rasterization`, says: 'Nothing of the lattice on which positions lie.', open: 'The lattice.' },
    coverage: { section: `${GPU}23.2.5.4 Polygon Rasterization`, says: 'A pixel whose centre lies inside is covered.', open: 'Samples on edges.' },
    tiling: { section: `${GPU}23.2.5.4 Polygon Rasterization`, says: 'A pixel whose centre lies inside of one triangle is covered by it alone.', open: 'Samples on edges, shared ones too: unlike OpenGL, the text forbids neither a hole nor a second hit there.' },
    order: { section: `${GPU}23.2.5.4 Polygon Rasterization`, says: 'A pixel whose centre lies inside is covered, whatever corner comes first.', open: 'Samples on edges.' },
    facing: { section: `${GPU}23.2.5.4 Polygon Rasterization`, says: 'The sign of the area and frontFace say which side faces; cullMode says which is left out.', open: 'Samples on edges.' },
    lines: { section: `${GPU}23.2.5.2 Line Rasterization`, says: 'The algorithm of lines is not defined.', open: 'Which pixels a line covers: nothing here can break a promise.' },
    depth: { section: `${GPU}23.2.6 Fragment Processing`, says: 'With less a fragment passes if its depth is smaller than the one that is kept.', open: 'How exact depths are: the bound is derived from roundings in f32.' },
    values: { section: `${GPU}23.2.5 Rasterization`, says: 'Attributes are interpolated in perspective, depths linearly.', open: 'How exactly: the bound is derived from roundings in f32, and beyond it what a step of the lattice changes is free.' },
    'near-plane': { section: `${GPU}23.2.4 Primitive Clipping`, says: 'What lies outside of 0 ≤ z ≤ w is cut off.', open: 'How new corners are rounded.' },
    samples: { section: `${GPU}23.2.5 Rasterization, standard sample patterns`, says: 'Samples lie at (0.375, 0.125), (0.875, 0.375), (0.125, 0.625) and (0.625, 0.875) of a pixel.', open: 'Samples on edges. (23.2.5.4 still calls the locations implementation-defined; the table of 23.2.5 is taken to hold.)' },
    twice: { section: GPU.slice(0, -2), says: 'Nothing.', open: 'Whether the same commands make the same picture.' },
  },
};
for (const rules of Object.values(RULES)) rules.reach = rules.coverage;

/** The same in Chinese. */
const RULES_ZH = {
  webgl2: {
    lattice: { says: '窗口坐标在像素以下至少有 4 位。', open: '此外还有多少位（设备自报的只是估计值），以及两个格点之间的位置怎样舍入。' },
    coverage: { says: '中心在内部的像素被覆盖；中心在两个三角形公共边上的像素恰好被其中一个覆盖。', open: '由两个多边形中的哪一个生成，以及只属于一个多边形的边上的采样点。' },
    tiling: { says: '在两个三角形的公共边上，每个像素恰好被其中一个覆盖。', open: '由哪一个多边形生成。顶点舍入到哪里无关紧要：共用一个顶点的三角形都用同一个位置。' },
    order: { says: '不论从哪个顶点开始，都生成中心在内部的片元。', open: '边上的采样点。' },
    facing: { says: '面积的符号说明朝向；被剔除的三角形不生成片元。', open: '边上的采样点。' },
    lines: { says: '菱形出口规则；或别的算法，其片元在 x 或 y 上至多偏差一个，总数至多差一个，每列（行）一个。', open: '这一偏差。' },
    depth: { says: 'LESS 时，深度小于已保留的深度的片元通过；深度按重心坐标加权。', open: '深度的精度：上界由 f32 的舍入和 2^-24 的步长推导。' },
    values: { says: '属性按重心坐标除以 w 加权，深度只按重心坐标加权。', open: '精度：上界由 f32 的舍入推导；超出上界时，移动一格所引起的变化也是允许的。' },
    'near-plane': { says: '-w ≤ z ≤ w 之外的部分被裁掉；新顶点在平面上。', open: '新顶点怎样舍入。' },
    samples: { says: '片元覆盖在内部的采样点。', open: '像素的采样点在哪里，以及边上的采样点。' },
    twice: { says: '相同的状态下，相同的命令画出相同的图。', open: '无。' },
  },
  webgpu: {
    lattice: { says: '没有规定位置所在的网格。', open: '网格。' },
    coverage: { says: '中心在内部的像素被覆盖。', open: '边上的采样点。' },
    tiling: { says: '中心在一个三角形内部的像素只被它覆盖。', open: '边上的采样点，公共边也在内：与 OpenGL 不同，条文既不禁止空洞，也不禁止重复命中。' },
    order: { says: '不论从哪个顶点开始，中心在内部的像素都被覆盖。', open: '边上的采样点。' },
    facing: { says: '面积的符号和 frontFace 说明朝向；cullMode 说明略去哪一面。', open: '边上的采样点。' },
    lines: { says: '直线的算法没有定义。', open: '直线覆盖哪些像素：这里没有承诺可以违背。' },
    depth: { says: 'less 时，深度小于已保留的深度的片元通过。', open: '深度的精度：上界由 f32 的舍入推导。' },
    values: { says: '属性按透视插值，深度按线性插值。', open: '精度：上界由 f32 的舍入推导；超出上界时，移动一格所引起的变化也是允许的。' },
    'near-plane': { says: '0 ≤ z ≤ w 之外的部分被裁掉。', open: '新顶点怎样舍入。' },
    samples: { says: '采样点在像素的 (0.375, 0.125)、(0.875, 0.375)、(0.125, 0.625) 和 (0.625, 0.875)。', open: '边上的采样点。（23.2.5.4 仍称位置由实现定义；这里以 23.2.5 的表为准。）' },
    twice: { says: '无。', open: '相同的命令是否画出相同的图。' },
  },
};
for (const rules of Object.values(RULES_ZH)) rules.reach = rules.coverage;
/** The rule of a check in the language of the page, with its quotation if there is one. */
const ruleOf = (name, check, lang = state.lang) => ({ ...RULES[name][check], ...(lang === 'zh' ? RULES_ZH : RULES)[name][check], quote: QUOTES[name][check] });
/** The same as asked() for a report, in English. */
const inWords = ({ quote, says }) => (quote ? `“${quote[0]}” (${quote[1]}) ${WORDS.en.inShort}: ${says}` : `${WORDS.en.ownWords}: ${says}`);
