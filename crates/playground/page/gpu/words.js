// What the page says, in English and Chinese.

const zhCount = (n) => n.toLocaleString('en');
const ROUNDING_ZH = { 'half to even': '一半取偶数', 'half up': '一半取上', 'half down': '一半取下', down: '一律向下' };
const RULE_ZH = { 'top-right': '右上规则', 'bottom-left': '左下规则', 'bottom-right': '右下规则' };

const WORDS = {
  en: {
    title: 'your GPU', other: '中文',
    about: 'This page draws about 290,000 triangles with the graphics interfaces of this browser, reads every pixel back, and compares it with an exact computation. It says of each check whether the browser does what the specification of the interface promises.',
    private: 'Nothing is sent: all of it happens in this browser, which keeps what was judged until the end, in case the page is closed.',
    judge: 'Judge my GPU', again: 'Judge again', alone: 'Or one check alone:', stop: 'Stop', stopped: 'Stopped before all checks were made.',
    resumed: (at) => `The page was closed before: the first ${plural(at, 'batch', 'batches')} were judged then.`,
    starting: 'Starting …', progress: (api, check, at, of) => `${api}: ${check} (batch ${at} of ${of})`, shrinking: (api, check) => `${api}: ${check}: looking for the smallest case …`,
    asking: (api, at) => `${api}: looking for the cause (picture ${at}) …`,
    cause: ({ cause, asked }) => `By ${plural(asked, 'more triangle')}, ${cause}`,
    noWebgl2: 'This browser gives no WebGL 2 context.', noWebgpu: 'This browser has no WebGPU here.', noAdapter: 'The browser has WebGPU, but gave no adapter.', noDevice: (why) => `The adapter refused to make a device (${why}).`,
    advice: 'Nothing could be judged. Turn on hardware acceleration in the settings of this browser, or open this page in a current Chrome, Edge, Firefox or Safari.',
    contextLost: 'the WebGL context was lost', deviceLost: 'the WebGPU device was lost', unnamed: 'not named by the browser',
    lostOnce: (why, at) => `At batch ${at} ${WORDS.en[why]}. The interface was opened anew, and that batch and the rest were judged on it.`,
    lostAgain: (why, at) => `At batch ${at} ${WORDS.en[why]}, for the second time. The checks below end there.`,
    uneven: (n) => `${plural(n, 'byte')} that were read back are no whole number of hits: the browser adds noise against fingerprinting, or its blending rounds. Hits are counted to the nearest, which is right while that is less than half a hit.`,
    failed: (why) => `The interface failed: ${why}`,
    software: 'The renderer runs on the processor: this is a verdict on that program, and not on a graphics card.',
    renderer: 'Renderer', browser: 'Browser',
    bitsSaid: (bits) => `SUBPIXEL_BITS is ${bits}: cases lie on that lattice.`, bitsInferred: 'WebGPU does not say how exact positions are. The lattice below was inferred from pixels.',
    samplesSummed: 'Without OES_sample_variables WebGL 2 cannot read the four samples of a pixel one by one. Their number is read instead.', noFloats: 'Without EXT_color_buffer_float values cannot be read.',
    equal: 'as promised', allowed: 'free to differ, and does', outside: 'breaks the promise', 'not-offered': 'cannot be asked here',
    check: 'Check', verdict: 'Verdict', found: 'What was found', rule: 'The specification',
    inShort: 'In short', ownWords: 'In words of this page', open: 'It leaves open',
    allPromised: 'Everything is as promised.', someFree: (n) => `No promise is broken. In ${plural(n, 'check')} the GPU differs where it may.`, someBroken: (n, names) => `${names.join(', ')}: ${plural(n, 'check')} ${n === 1 ? 'breaks' : 'break'} a promise.`,
    totals: (n, samples, seconds) => `${plural(n, 'triangle')} and ${plural(samples, 'case')} of four samples in ${seconds} s.`,
    checks: { lattice: 'positions', coverage: 'coverage', reach: 'large triangles', tiling: 'shared edges', order: 'order of corners', facing: 'culling by winding', lines: 'lines', depth: 'depth test', values: 'values in perspective', 'near-plane': 'near plane', samples: 'four samples', twice: 'the same twice' },
    details: {
      lattice: (t, f) => (f.explained === t.subjects
        ? `All ${plural(t.subjects, 'triangle')} are drawn as if corners were rounded to 1/${2 ** f.bits} px, ${f.rounding}.`
        : `No lattice explains all: corners rounded to 1/${2 ** f.bits} px, ${f.rounding}, explain ${f.explained.toLocaleString('en')} of ${plural(t.subjects, 'triangle')}.`),
      coverage: (t, f) => `${plural(t.shapes, 'triangle')} in ${plural(t.subjects, 'case')}, ${plural(t.pixels, 'pixel')}: ${t.free + t.broken === 0 ? 'every one as by the top-left rule.' : `${plural(t.broken, 'case')} wrong, ${t.free.toLocaleString('en')} different at samples on edges${f.rule && t.free && !t.broken ? `, all explained by the ${f.rule} rule` : ''}.`}`,
      tiling: (t) => `${plural(t.shapes, 'triangle')} with corners anywhere tile ${plural(t.subjects, 'cell')}: ${t.free + t.broken === 0 ? 'every pixel is hit exactly once.' : `${plural(t.free + t.broken, 'cell')} with a pixel that is not hit exactly once.`}`,
      order: (t) => `${plural(t.shapes, 'triangle')} with their corners in six orders: ${t.free + t.broken === 0 ? 'the same pixels each time, as by the top-left rule.' : `${(t.free + t.broken).toLocaleString('en')} differ, ${t.broken.toLocaleString('en')} of them beyond samples on edges.`}`,
      facing: (t) => `${plural(t.shapes, 'triangle')} of both windings with back faces culled: ${t.broken} are drawn or left out wrongly${t.free ? `, ${t.free} differ at samples on edges` : ''}.`,
      lines: (t) => `${plural(t.subjects, 'line')}: ${t.explained[0]} as the diamond-exit rule draws them, ${t.explained[1]} as rectangles, ${t.explained[2]} as parallelograms; ${t.broken} beyond what is allowed.`,
      depth: (t) => `${plural(t.subjects, 'case')} of triangles before each other, ${plural(t.pixels, 'pixel')}: ${t.broken} keep a farther one or cover other pixels${t.free ? `; in ${t.free} a pixel was too close to decide, or lies on an edge` : ''}.`,
      values: (t) => `${plural(t.pixels, 'value')} of ${plural(t.subjects, 'triangle')}: the worst error is ${t.worst.toFixed(3)} of the derived bound; ${t.free} triangles go beyond it as far as positions are exact, ${t.broken} farther.`,
      'near-plane': (t) => `${plural(t.subjects, 'triangle')} before and behind the planes: ${t.broken + t.free === 0 ? 'all exactly cut.' : `${t.free} differ within what rounding new corners explains, ${t.broken} beyond it.`}`,
      samples: (t) => `${plural(t.subjects, 'triangle')}: ${t.broken + t.free === 0 ? 'every sample as at the standard positions.' : `${t.broken} wrong, ${t.free} different where they may.`}`,
      twice: (t) => (t.free + t.broken ? `${plural(t.free + t.broken, 'case')} of ${t.subjects.toLocaleString('en')} differ between two drawings: some browsers add noise against fingerprinting, and then nothing on this page says anything about the GPU.` : `${plural(t.pixels, 'pixel')} drawn twice: the same both times.`),
    },
    pixelSays: (x, y, ours, theirs) => `Pixel ${x}, ${y}: expected ${ours}, drawn ${theirs}.`,
    finding: 'The smallest case that was found', example: 'A case that differs', alike: 'A case, where nothing differs', ours: 'Expected', theirs: 'Drawn by this browser', drawnFirst: 'Drawn first', drawnAgain: 'Drawn again', sample: (n) => `sample ${n}`,
    legend: (check) => `${ { depth: 'A number says which triangle is kept; the byte that is read is three times as large', values: 'A 1 says that the pixel is drawn; its values stand below', twice: 'A number says how often the pixel is hit, on the left in the first drawing, on the right in the second' }[check] ?? 'A number says how often the pixel is hit'}. The first row that is read is uppermost: of WebGL that is the lowest of the window.`,
    address: 'Address that repeats it', copy: 'Copy', copied: 'Copied', report: 'Text for a bug report', corners: 'Corners (x, y in px)', cornersMore: 'Vertices (x·w, y·w, depth·w, w, two attributes)',
    latticeOne: (bits) => (bits ? `The finest lattice that explains this case is 1/${2 ** bits} px.` : 'No lattice that was tried explains this case.') + ' One case alone breaks no promise about positions.',
    show: 'Show', repeats: 'This is one case, from the address of this page.', badCase: 'The address holds no case that can be drawn:', fails: 'This case breaks the promise here.', passes: 'This case is as promised here.', differs: 'This case differs here, and is free to.',
  },
  zh: {
    title: '你的 GPU', other: 'English',
    about: '本页用这个浏览器的图形接口画大约二十九万个三角形，读回每一个像素，与精确计算的结果比较，并逐项说明浏览器是否做到了接口规范所承诺的。',
    private: '不发送任何东西：一切都在这个浏览器里进行。评判结束之前，浏览器会保存已有的结果，以防页面被关闭。',
    judge: '评判我的 GPU', again: '再评判一次', alone: '或者只做一项检查：', stop: '停', stopped: '在做完所有检查之前停了。',
    resumed: (at) => `这个页面中途关闭过：前 ${zhCount(at)} 批是那时评判的。`,
    starting: '正在启动……', progress: (api, check, at, of) => `${api}：${check}（第 ${at} 批，共 ${of} 批）`, shrinking: (api, check) => `${api}：${check}：正在寻找最小的用例……`,
    asking: (api, at) => `${api}：正在寻找原因（第 ${at} 张图）……`,
    cause: ({ cause, asked }) => `又问了 ${zhCount(asked)} 个三角形（结论为英文）：${cause}`,
    noWebgl2: '这个浏览器不提供 WebGL 2 上下文。', noWebgpu: '这个浏览器在这里没有 WebGPU。', noAdapter: '浏览器有 WebGPU，但没有给出适配器。', noDevice: (why) => `适配器拒绝创建设备（${why}）。`,
    advice: '什么都没能评判。请在浏览器设置里打开硬件加速，或者用新版的 Chrome、Edge、Firefox 或 Safari 打开本页。',
    contextLost: 'WebGL 上下文丢失了', deviceLost: 'WebGPU 设备丢失了', unnamed: '浏览器没有给出名字',
    lostOnce: (why, at) => `第 ${at} 批时${WORDS.zh[why]}。接口已重新打开，这一批和其余的批在它上面评判。`,
    lostAgain: (why, at) => `第 ${at} 批时${WORDS.zh[why]}，这是第二次。下面的检查到此为止。`,
    uneven: (n) => `读回的字节中有 ${zhCount(n)} 个不是命中次数的整数倍：浏览器为防止指纹识别加入了噪声，或者混合有舍入。命中次数取最近的整数，只要偏差小于半次命中就是正确的。`,
    failed: (why) => `接口出错：${why}`,
    software: '渲染器在处理器上运行：这是对那个程序的评判，不是对显卡的。',
    renderer: '渲染器', browser: '浏览器',
    bitsSaid: (bits) => `SUBPIXEL_BITS 为 ${bits}：用例都在这个网格上。`, bitsInferred: 'WebGPU 没有说明位置的精度。下面的网格是从像素推断的。',
    samplesSummed: '没有 OES_sample_variables，WebGL 2 不能逐个读出一个像素的四个采样点，只能读出它们的个数。', noFloats: '没有 EXT_color_buffer_float，不能读出数值。',
    equal: '符合承诺', allowed: '允许不同，也确实不同', outside: '违背承诺', 'not-offered': '这里无法检查',
    check: '检查', verdict: '结论', found: '发现', rule: '规范',
    inShort: '简言之', ownWords: '以下是本页的概括，不是原文', open: '它没有规定',
    allPromised: '全部符合承诺。', someFree: (n) => `没有违背承诺。有 ${n} 项在允许的范围内不同。`, someBroken: (n, names) => `${names.join('、')}：有 ${n} 项违背承诺。`,
    totals: (n, samples, seconds) => `${zhCount(n)} 个三角形，${zhCount(samples)} 个四采样用例，用时 ${seconds} 秒。`,
    checks: { lattice: '位置', coverage: '覆盖', reach: '大三角形', tiling: '公共边', order: '顶点的顺序', facing: '按绕向剔除', lines: '直线', depth: '深度测试', values: '透视中的数值', 'near-plane': '近平面', samples: '四个采样点', twice: '两次相同' },
    details: {
      lattice: (t, f) => (f.explained === t.subjects
        ? `全部 ${zhCount(t.subjects)} 个三角形都如同顶点舍入到 1/${2 ** f.bits} 像素（${ROUNDING_ZH[f.rounding]}）。`
        : `没有一种网格能解释全部：舍入到 1/${2 ** f.bits} 像素（${ROUNDING_ZH[f.rounding]}）解释了 ${zhCount(t.subjects)} 个中的 ${zhCount(f.explained)} 个。`),
      coverage: (t, f) => `${zhCount(t.subjects)} 个用例，${zhCount(t.shapes)} 个三角形，${zhCount(t.pixels)} 个像素：${t.free + t.broken === 0 ? '全部与左上规则一致。' : `${zhCount(t.broken)} 个用例错误，${zhCount(t.free)} 个在边上的采样点处不同${f.rule && t.free && !t.broken ? `，都可用${RULE_ZH[f.rule]}解释` : ''}。`}`,
      tiling: (t) => `${zhCount(t.shapes)} 个顶点在任意位置的三角形铺满 ${zhCount(t.subjects)} 个格子：${t.free + t.broken === 0 ? '每个像素恰好命中一次。' : `${zhCount(t.free + t.broken)} 个格子里有像素不是恰好命中一次。`}`,
      order: (t) => `${zhCount(t.shapes)} 个三角形，顶点按六种顺序：${t.free + t.broken === 0 ? '每次的像素都相同，与左上规则一致。' : `${zhCount(t.free + t.broken)} 个不同，其中 ${zhCount(t.broken)} 个不限于边上的采样点。`}`,
      facing: (t) => `${zhCount(t.shapes)} 个两种绕向的三角形，剔除背面：${t.broken} 个画错或漏画${t.free ? `，${t.free} 个在边上的采样点处不同` : ''}。`,
      lines: (t) => `${zhCount(t.subjects)} 条直线：${t.explained[0]} 条与菱形出口规则一致，${t.explained[1]} 条与矩形一致，${t.explained[2]} 条与平行四边形一致；${t.broken} 条超出允许的范围。`,
      depth: (t) => `${zhCount(t.subjects)} 组前后重叠的三角形，${zhCount(t.pixels)} 个像素：${t.broken} 组保留了较远的或覆盖了别的像素${t.free ? `；${t.free} 组里有像素太接近而无法判定，或在边上` : ''}。`,
      values: (t) => `${zhCount(t.subjects)} 个三角形的 ${zhCount(t.pixels)} 个数值：最大误差是推导出的上界的 ${t.worst.toFixed(3)} 倍；${t.free} 个三角形超出上界，但不超出位置的精度，${t.broken} 个超出更多。`,
      'near-plane': (t) => `${zhCount(t.subjects)} 个在平面前后的三角形：${t.broken + t.free === 0 ? '全部精确裁剪。' : `${t.free} 个的不同可用新顶点的舍入解释，${t.broken} 个不能。`}`,
      samples: (t) => `${zhCount(t.subjects)} 个三角形：${t.broken + t.free === 0 ? '每个采样点都如在标准位置。' : `${t.broken} 个错误，${t.free} 个在允许处不同。`}`,
      twice: (t) => (t.free + t.broken ? `${zhCount(t.subjects)} 个用例画两次，有 ${zhCount(t.free + t.broken)} 个不同：有些浏览器为防止指纹识别而加入噪声，那么本页的一切都不能说明 GPU。` : `${zhCount(t.pixels)} 个像素画了两次：两次相同。`),
    },
    pixelSays: (x, y, ours, theirs) => `像素 ${x}, ${y}：应当是 ${ours}，画出的是 ${theirs}。`,
    finding: '找到的最小用例', example: '一个不同的用例', alike: '一个用例，没有不同', ours: '应当是', theirs: '这个浏览器画的', drawnFirst: '第一次画的', drawnAgain: '第二次画的', sample: (n) => `采样点 ${n}`,
    legend: (check) => `${ { depth: '数字是保留下来的三角形的编号，读出的字节是它的三倍', values: '1 表示像素被画了；数值见下', twice: '数字是像素被命中的次数，左边是第一次画的，右边是第二次画的' }[check] ?? '数字是像素被命中的次数'}。最先读出的一行在最上面：在 WebGL 中它是窗口最下面的一行。`,
    address: '重现它的地址', copy: '复制', copied: '已复制', report: '错误报告的文字', corners: '顶点（x, y，像素）', cornersMore: '顶点（x·w, y·w, 深度·w, w, 两个属性）',
    latticeOne: (bits) => (bits ? `能解释这个用例的最细网格是 1/${2 ** bits} 像素。` : '试过的网格都不能解释这个用例。') + '单独一个用例不违背关于位置的承诺。',
    show: '显示', repeats: '这是地址中给出的一个用例。', badCase: '地址中没有可以画的用例：', fails: '这个用例在这里违背承诺。', passes: '这个用例在这里符合承诺。', differs: '这个用例在这里不同，这是允许的。',
  },
};
for (const { details } of Object.values(WORDS)) details.reach = details.coverage;

const word = (key) => WORDS[state.lang][key] ?? key;

/** A note in the language of the page: a key, and what its sentence needs. */
function said([key, ...more]) {
  const words = word(key);
  return typeof words === 'function' ? words(...more) : words;
}
