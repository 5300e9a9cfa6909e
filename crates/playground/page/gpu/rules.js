// What the specifications say. Sections of WebGL 2 are those of OpenGL ES 3.0.3, to which it refers; sentences in quotation
// marks are theirs, all others are in short.

const POINTS = '“Special treatment is given to a fragment whose center lies on a polygon edge. In such a case we require that if two polygons lie on either side of a common edge (with identical endpoints) on which a fragment center lies, then exactly one of the polygons results in the production of the fragment during rasterization.”';
const ENCLOSED = '“All the points with coordinates C, where fract(C) = vector2(0.5, 0.5) in the framebuffer space, enclosed into the polygon, are included. If a pixel center is on the edge of the polygon, whether or not it’s included is not defined.”';
const ES = 'OpenGL ES 3.0.3, ';
const GPU = 'WebGPU, ';
const RULES = {
  webgl2: {
    lattice: { section: `${ES}2.12.1 Controlling the Viewport; 6.2, SUBPIXEL_BITS`, says: 'Window coordinates keep as many bits below the pixel as SUBPIXEL_BITS says, at least 4.', open: 'How a position between two of the lattice is rounded.' },
    coverage: { section: `${ES}3.6.1 Basic Polygon Rasterization`, says: `Fragment centers that lie inside are produced. ${POINTS}`, open: 'Which of the two polygons, and samples on an edge of one alone.' },
    tiling: { section: `${ES}3.6.1 Basic Polygon Rasterization`, says: POINTS, open: 'Which of the two polygons. Where corners are rounded to does not matter: all triangles of a corner have the same one.' },
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
    lattice: { section: `${GPU}23.2.5.4 Polygon Rasterization`, says: 'A note calls it “a subject of precision for the rasterizer”.', open: 'On which lattice positions lie.' },
    coverage: { section: `${GPU}23.2.5.4 Polygon Rasterization`, says: ENCLOSED, open: 'Samples on edges.' },
    tiling: { section: `${GPU}23.2.5.4 Polygon Rasterization`, says: ENCLOSED, open: 'Samples on edges, shared ones too: unlike OpenGL, the text forbids neither a hole nor a second hit there.' },
    order: { section: `${GPU}23.2.5.4 Polygon Rasterization`, says: ENCLOSED, open: 'Samples on edges.' },
    facing: { section: `${GPU}23.2.5.4 Polygon Rasterization`, says: 'The sign of the area and frontFace say which side faces; cullMode says which is left out.', open: 'Samples on edges.' },
    lines: { section: `${GPU}23.2.5.2 Line Rasterization`, says: 'The algorithm of lines is not defined.', open: 'Which pixels a line covers: nothing here can break a promise.' },
    depth: { section: `${GPU}23.2.7 Output Merging; depthCompare`, says: 'With less a fragment passes if its depth is smaller than the one that is kept.', open: 'How exact depths are: the bound is derived from roundings in f32.' },
    values: { section: `${GPU}23.2.5.3 Barycentric coordinates; WGSL interpolation`, says: 'Attributes are interpolated in perspective, depths linearly.', open: 'How exactly: the bound is derived from roundings in f32, and beyond it what a step of the lattice changes is free.' },
    'near-plane': { section: `${GPU}23.2.4 Primitive Clipping`, says: 'What lies outside of 0 ≤ z ≤ w is cut off.', open: 'How new corners are rounded.' },
    samples: { section: `${GPU}23.2.5.4 Polygon Rasterization, standard sample patterns`, says: 'Samples lie at (0.375, 0.125), (0.875, 0.375), (0.125, 0.625) and (0.625, 0.875) of a pixel.', open: 'Samples on edges.' },
    twice: { section: GPU.slice(0, -2), says: 'Nothing.', open: 'Whether the same commands make the same picture.' },
  },
};
for (const rules of Object.values(RULES)) rules.reach = rules.coverage;

/** The same in Chinese; sentences in quotation marks stay as they are. */
const RULES_ZH = {
  webgl2: {
    lattice: { says: '窗口坐标保留像素以下 SUBPIXEL_BITS 位，至少 4 位。', open: '两个格点之间的位置怎样舍入。' },
    coverage: { says: `生成中心在内部的片元。${POINTS}`, open: '由两个多边形中的哪一个生成，以及只属于一个多边形的边上的采样点。' },
    tiling: { says: POINTS, open: '由哪一个多边形生成。顶点舍入到哪里无关紧要：共用一个顶点的三角形都用同一个位置。' },
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
    lattice: { says: '一条注释称之为“a subject of precision for the rasterizer”。', open: '位置在怎样的网格上。' },
    coverage: { says: ENCLOSED, open: '边上的采样点。' },
    tiling: { says: ENCLOSED, open: '边上的采样点，公共边也在内：与 OpenGL 不同，条文既不禁止空洞，也不禁止重复命中。' },
    order: { says: ENCLOSED, open: '边上的采样点。' },
    facing: { says: '面积的符号和 frontFace 说明朝向；cullMode 说明略去哪一面。', open: '边上的采样点。' },
    lines: { says: '直线的算法没有定义。', open: '直线覆盖哪些像素：这里没有承诺可以违背。' },
    depth: { says: 'less 时，深度小于已保留的深度的片元通过。', open: '深度的精度：上界由 f32 的舍入推导。' },
    values: { says: '属性按透视插值，深度按线性插值。', open: '精度：上界由 f32 的舍入推导；超出上界时，移动一格所引起的变化也是允许的。' },
    'near-plane': { says: '0 ≤ z ≤ w 之外的部分被裁掉。', open: '新顶点怎样舍入。' },
    samples: { says: '采样点在像素的 (0.375, 0.125)、(0.875, 0.375)、(0.125, 0.625) 和 (0.625, 0.875)。', open: '边上的采样点。' },
    twice: { says: '无。', open: '相同的命令是否画出相同的图。' },
  },
};
for (const rules of Object.values(RULES_ZH)) rules.reach = rules.coverage;
const ruleOf = (name, check) => (state.lang === 'zh' ? RULES_ZH : RULES)[name][check];
